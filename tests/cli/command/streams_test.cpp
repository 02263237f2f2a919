// Where the tool's answers and messages go when there is nowhere for them to go.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scene_files.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

using test::ToolResult;
using testing::HasSubstr;

class Streams : public testing::Test {
 protected:
  Streams() { folder_.scene(test::base_scene); }
  // A line of the shell's, with the tool as $0.
  ToolResult shell(const std::string& line) const {
    return test::run_program("bash", {"-c", line, BILLOW_TOOL}, folder_.path());
  }

  test::SceneFolder folder_;
};

TEST_F(Streams, ThatAreClosedAreNoFaultOfTheMesh) {
  for (const char* closed : {"<&-", "2>&-", "<&- 2>&-"})
    EXPECT_EQ(shell(std::string("\"$0\" check scene.yaml ") + closed).status, 0) << closed;
  for (const char* closed : {">&-", ">&- 2>&-", "<&- >&- 2>&-"}) {
    const std::string film = " -D duration=0.1 -D 'render.size=[32, 24]' -o film --overwrite ";
    EXPECT_EQ(shell("\"$0\" render scene.yaml" + film + closed).status, 0) << closed;
    EXPECT_EQ(shell(std::string("\"$0\" check scene.yaml ") + closed).status, 6) << closed;  // its answer is lost
  }
}

TEST_F(Streams, ThatAreFullLoseNoAnswerUnnoticed) {
  for (const char* command : {"--help", "--version", "render --help", "check scene.yaml", "stability scene.yaml"}) {
    const ToolResult result = shell("\"$0\" " + std::string(command) + " >/dev/full");
    EXPECT_EQ(result.status, 6) << command;
    EXPECT_THAT(result.errors, HasSubstr("the output could not be written")) << command;
  }
  const ToolResult films = shell(
      "for end in 0.1 0.5; do \"$0\" render scene.yaml --frames 1 -D \"render.background={top: [$end, 0, 0]}\" "
      "-o $end; done");
  ASSERT_EQ(films.status, 0) << films.errors;
  for (const char* style : {"", "--json"}) {
    const std::string pair = std::string("\"$0\" compare 0.1/textured 0.5/textured ") + style;
    EXPECT_EQ(shell(pair).status, 3);
    const ToolResult lost = shell(pair + " >/dev/full");
    EXPECT_EQ(lost.status, 6);
    EXPECT_THAT(lost.errors, HasSubstr("the output could not be written"));
  }
}

// A wrong command stays one, whatever becomes of the output.
TEST_F(Streams, ThatAreFullDoNotHideAnotherFault) {
  EXPECT_EQ(shell("\"$0\" check none.yaml >/dev/full").status, 4);
  EXPECT_EQ(shell("\"$0\" check >/dev/full").status, 2);
}

#ifndef BILLOW_SANITIZE  // whose look at memory takes a file
// As few files as a mesh can be read with, and one less; without those that are open for whoever runs the tests.
TEST_F(Streams, ThatMayNotBeOpenedAreNoFaultOfTheMesh) {
  const auto check_with = [&](int files) {
    return shell("exec 3>&- 4>&- 5>&- 6>&- 7>&- 8>&-; ulimit -n " + std::to_string(files) +
                 "; \"$0\" check scene.yaml");
  };
  EXPECT_EQ(check_with(5).status, 0);
  const ToolResult too_few = check_with(4);
  EXPECT_EQ(too_few.status, 1);
  EXPECT_EQ(too_few.errors, "cannot start the mesh importer: pipe: Too many open files\n");
}
#endif

}  // namespace
}  // namespace billow
