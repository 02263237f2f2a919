// Golden images: what a picture looked like when someone last looked at it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "render/image/image.h"

namespace billow::test {

/// Compares `image` with `folder`/NAME.png by render::within_tolerance. A missing or failing baseline leaves
/// NAME.actual.png and, where there is something to compare, NAME.difference.png in the test output folder, and says
/// so. With BILLOW_UPDATE_GOLDEN=1 in the environment the image becomes the baseline instead.
testing::AssertionResult matches_golden(const render::Image& image, const std::string& name,
                                        const std::filesystem::path& folder);

/// The folder of the baselines that ship.
std::filesystem::path golden_folder();

}  // namespace billow::test

/// A golden test in one line: EXPECT_GOLDEN(renderer.draw(...), "drape_textured");
#define EXPECT_GOLDEN(image, name) \
  EXPECT_TRUE(::billow::test::matches_golden(image, name, ::billow::test::golden_folder()))
