// What tests of studies share: one that plots limits, and the tool that does it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/scene_files.h"
#include "tests/support/tool.h"

namespace billow::test {

inline const std::string plot_study = R"(billow_study: 1
scene: scene.yaml
set: {duration: 0.2}
axes:
  - {name: lambda, key: solver.filter.lambda, values: [0.5, 1]}
measure: {render: false}
pictures:
  - {name: limits, kind: plot, x: lambda, y: [paper_ratio, certified_ratio]}
)";

/// Does the study of a folder of its own.
class Studying : public testing::Test {
 protected:
  Studying() {
    folder_.scene(base_scene);
    folder_.write("study.yaml", plot_study);
  }
  ToolResult study(std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"study", "study.yaml", "-o", "made"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_tool(arguments, folder_.path());
  }
  std::filesystem::path made(const std::string& file) const { return folder_.path() / "made" / file; }
  nlohmann::json record() const { return nlohmann::json::parse(read_text(made("study.json"))); }

  SceneFolder folder_;
};

}  // namespace billow::test
