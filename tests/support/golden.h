// Golden images: what a picture looked like when someone last looked at it. What scenes look like is in
// tests/golden/goldens.yaml; this is for pictures that no scene makes.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "render/image/image.h"

namespace billow::test {

/// Compares `image` with `folder`/NAME.png as `billow compare` does, with NAME.tolerance.yaml and the other versions
/// NAME.1.png beside it. The picture is left as golden/NAME.png in the test output folder; a missing or failing
/// baseline leaves a page of the two beside it, and says so. With BILLOW_UPDATE_GOLDEN=1 in the environment, and no CI,
/// what differs or is new becomes the baseline instead.
testing::AssertionResult matches_golden(const render::Image& image, const std::string& name,
                                        const std::filesystem::path& folder);

/// The folder of the baselines that ship.
std::filesystem::path golden_folder();

}  // namespace billow::test

/// A golden test in one line: EXPECT_GOLDEN(renderer.draw(...), "drape_textured");
#define EXPECT_GOLDEN(image, name) \
  EXPECT_TRUE(::billow::test::matches_golden(image, name, ::billow::test::golden_folder()))
