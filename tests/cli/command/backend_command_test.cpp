// Which OpenGL draws, from outside: the option, the variable, what is recorded, and what is said where it is missing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/mesh_files.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

namespace fs = std::filesystem;
using test::ToolResult;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string scene = R"(billow: 1
duration: 0.1
bodies:
  - {name: drape, cloth: {mesh: cloth.obj, mass: 0.05, stiffness: {max_eigenvalue: 1000}, pins: [{corner: top_left}]}}
solver: {method: fb_euler}
render: {size: [96, 64], fps: 25, samples: 4}
)";

class BackendCommand : public testing::Test {
 protected:
  BackendCommand() {
    folder_.write("cloth.obj", test::mesh_file("obj", test::quad_grid(6, 6)));
    folder_.write("scene.yaml", scene);
  }

  // With `environment`, VARIABLE=value, in addition to what there is.
  ToolResult run(std::vector<std::string> environment, const std::vector<std::string>& arguments) const {
    environment.insert(environment.begin(), {"-u", "BILLOW_BACKEND"});
    environment.push_back(BILLOW_TOOL);
    environment.insert(environment.end(), arguments.begin(), arguments.end());
    return test::run_program("env", environment, folder_.path());
  }

  ToolResult render(const std::vector<std::string>& environment, const std::vector<std::string>& more,
                    const std::string& output = "film") const {
    std::vector<std::string> arguments{"render", "scene.yaml", "-o", output};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(environment, arguments);
  }

  nlohmann::json record(const std::string& film) const {
    return nlohmann::json::parse(test::read_text(folder_.path() / film / "run.json"));
  }

  // A loader that finds these libraries first finds none: they are empty.
  std::string without(const std::vector<std::string>& libraries) const {
    fs::create_directory(folder_.path() / "empty");
    for (const std::string& library : libraries) folder_.write("empty/" + library, "");
    return "LD_LIBRARY_PATH=" + (folder_.path() / "empty").string();
  }

  test::TemporaryFolder folder_;
};

TEST_F(BackendCommand, BothDrawTheSameBytesAndSaySo) {
  ASSERT_EQ(render({}, {}, "automatic").status, 0);
  ASSERT_EQ(render({}, {"--backend", "egl"}, "option").status, 0);
  ASSERT_EQ(render({"BILLOW_BACKEND=egl"}, {}, "variable").status, 0);
  ASSERT_EQ(render({"BILLOW_BACKEND=egl"}, {"--backend", "osmesa"}, "both").status, 0);
  for (const std::string film : {"option", "variable", "both"})
    for (const std::string picture : {"textured/frame_0003.png", "velocity/frame_0002.png"})
      EXPECT_EQ(test::read_text(folder_.path() / film / picture),
                test::read_text(folder_.path() / "automatic" / picture));
  EXPECT_EQ(record("automatic")["backend"], "osmesa");
  EXPECT_EQ(record("option")["backend"], "egl");
  EXPECT_EQ(record("variable")["backend"], "egl");
  EXPECT_EQ(record("both")["backend"], "osmesa");
  EXPECT_EQ(record("option")["scene"]["hash"], record("automatic")["scene"]["hash"]);
  EXPECT_THAT(std::string(record("option")["gl"]), HasSubstr("llvmpipe"));
  EXPECT_THAT(test::read_text(folder_.path() / "option/index.html"), HasSubstr("egl: "));
}

TEST_F(BackendCommand, EitherWillDoWhereTheOtherIsMissing) {
  ASSERT_EQ(render({without({"libOSMesa.so.8"})}, {}, "egl").status, 0);
  EXPECT_EQ(record("egl")["backend"], "egl");
  fs::remove(folder_.path() / "empty/libOSMesa.so.8");
  ASSERT_EQ(render({without({"libEGL.so.1"})}, {}, "osmesa").status, 0);
  EXPECT_EQ(record("osmesa")["backend"], "osmesa");
}

TEST_F(BackendCommand, WithoutAnyItSaysWhatToInstallAndLeavesNothing) {
  const ToolResult result = render({without({"libOSMesa.so.8", "libEGL.so.1"})}, {});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.errors,
              AllOf(HasSubstr("install libosmesa6"), HasSubstr("install libegl1 libegl-mesa0 libgl1-mesa-dri"),
                    Not(HasSubstr("internal fault"))));
  EXPECT_FALSE(fs::exists(folder_.path() / "film/run.json"));
  EXPECT_EQ(run({without({"libOSMesa.so.8", "libEGL.so.1"})}, {"check", "scene.yaml"}).status, 0);
  EXPECT_EQ(run({without({"libOSMesa.so.8", "libEGL.so.1"})}, {"simulate", "scene.yaml", "-o", "states"}).status, 0);
}

TEST_F(BackendCommand, SimulatingAsksForNone) {
  EXPECT_EQ(run({"BILLOW_BACKEND=mesa"}, {"simulate", "scene.yaml", "-o", "states"}).status, 0);
}

TEST_F(BackendCommand, SoftwareIsLlvmpipeWhateverTheEnvironmentSays) {
  ASSERT_EQ(render({"GALLIUM_DRIVER=softpipe"}, {}, "soft").status, 0);
  EXPECT_THAT(std::string(record("soft")["gl"]), HasSubstr("llvmpipe"));
}

TEST_F(BackendCommand, WhatWasAskedForIsNotReplaced) {
  const ToolResult osmesa = render({without({"libOSMesa.so.8"})}, {"--backend", "osmesa"});
  EXPECT_EQ(osmesa.status, 1);
  EXPECT_THAT(osmesa.errors, HasSubstr("install libosmesa6"));
  const ToolResult device = render({}, {"--backend", "egl:63"});
  EXPECT_EQ(device.status, 1);
  EXPECT_THAT(device.errors, AllOf(HasSubstr("EGL has no device 63; devices are egl:0 (")));
  const ToolResult driver = render({"LIBGL_DRIVERS_PATH=/nowhere"}, {"--backend", "egl:0"});
  EXPECT_EQ(driver.status, 1);
  EXPECT_THAT(driver.errors, AllOf(HasSubstr("egl:0"), HasSubstr("libgl1-mesa-dri"), HasSubstr("EGL_LOG_LEVEL=debug")));
}

TEST_F(BackendCommand, RunsOfAStudyAreDrawnByItToo) {
  folder_.write("study.yaml",
                "billow_study: 1\nscene: scene.yaml\naxes: [{name: fps, key: render.fps, values: [20]}]\n"
                "pictures: [{name: all, kind: frames, times: [0]}]\n");
  const ToolResult missing = run({without({"libOSMesa.so.8"})}, {"study", "study.yaml", "--backend", "osmesa"});
  EXPECT_EQ(missing.status, 1);
  EXPECT_THAT(missing.errors, HasSubstr("install libosmesa6"));
  EXPECT_FALSE(fs::exists(folder_.path() / "out"));
  const ToolResult result = run({}, {"study", "study.yaml", "-o", "made", "--backend", "egl"});
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_EQ(record("made/runs/001-20/film")["backend"], "egl");
}

// As after a run by a GPU, or another Mesa.
TEST_F(BackendCommand, FramesOfSeveralRenderersAreWarnedOf) {
  ASSERT_EQ(render({}, {}).status, 0);
  EXPECT_THAT(render({}, {"--resume"}).errors, Not(HasSubstr("drawn by")));
  nlohmann::json changed = record("film");
  changed["gl"] = "Maker, Some GPU, OpenGL 4.6";
  folder_.write("film/run.json", changed.dump());
  fs::remove(folder_.path() / "film/textured/frame_0002.png");
  const ToolResult mixed = render({}, {"--resume"});
  EXPECT_EQ(mixed.status, 0);
  EXPECT_THAT(mixed.errors, HasSubstr("the frames that are kept were drawn by 'Maker, Some GPU, OpenGL 4.6'"));
}

TEST_F(BackendCommand, MisspeltNamesAreUsage) {
  const ToolResult option = render({}, {"--backend", "elg"});
  EXPECT_EQ(option.status, 2);
  EXPECT_THAT(option.errors, HasSubstr("there is no backend 'elg'; did you mean 'egl'?"));
  const ToolResult variable = render({"BILLOW_BACKEND=mesa"}, {});
  EXPECT_EQ(variable.status, 2);
  EXPECT_THAT(variable.errors, HasSubstr("BILLOW_BACKEND: there is no backend 'mesa'"));
  EXPECT_EQ(run({"BILLOW_BACKEND=mesa"}, {"check", "scene.yaml"}).status, 0);  // which draws nothing
}

TEST_F(BackendCommand, DoctorListsThemAll) {
  const ToolResult result = run({}, {"doctor"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.output, AllOf(HasSubstr("\nosmesa        software: "), HasSubstr("\negl           software: "),
                                   HasSubstr("\negl:0 "), HasSubstr("\ndraws         osmesa: auto takes software")));
  const ToolResult without_osmesa = run({without({"libOSMesa.so.8"})}, {"doctor"});
  EXPECT_EQ(without_osmesa.status, 0);
  EXPECT_THAT(without_osmesa.output,
              AllOf(HasSubstr("\nosmesa        missing: "), HasSubstr("draws         egl, because osmesa is missing")));
  EXPECT_EQ(run({without({"libOSMesa.so.8", "libEGL.so.1"})}, {"doctor"}).status, 1);
  const ToolResult misspelt = run({"BILLOW_BACKEND=osmsa"}, {"doctor"});
  EXPECT_EQ(misspelt.status, 2);
  EXPECT_THAT(misspelt.output, AllOf(HasSubstr("\negl:0 "), HasSubstr("\ndraws         MISSING: "),
                                     HasSubstr("did you mean 'osmesa'?")));
}

}  // namespace
}  // namespace billow
