// The manual page and the completions, as a shell and man(1) take them.
#include <regex>
#include <set>
#include <sstream>

#include "tests/support/scene_files.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

using test::run_program;
using test::run_tool;
using test::ToolResult;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::UnorderedElementsAre;

using Lines = std::vector<std::string>;

Lines lines_of(const std::string& text) {
  Lines lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

class Generate : public testing::Test {
 protected:
  Generate() {
    for (const char* file : {"drape.yaml", "dragon.obj", "dress.YML", "drawing.png"}) folder_.write(file, "");
    std::filesystem::create_directory(folder_.path() / "drafts");
  }

  std::string generated(const std::string& kind) {
    const ToolResult result = run_tool({"generate", kind}, folder_.path());
    EXPECT_EQ(result.status, 0) << result.errors;
    return result.output;
  }

  // What a line of --help begins with, where `pattern` captures it.
  std::set<std::string> in_help(const Lines& arguments, const std::string& pattern) {
    std::set<std::string> found;
    const std::string help = run_tool(arguments, folder_.path()).output;
    const std::regex wanted(pattern);
    for (const std::string& line : lines_of(help))
      for (std::sregex_iterator match(line.begin(), line.end(), wanted), end; match != end; ++match)
        found.insert((*match)[1]);
    return found;
  }
  std::set<std::string> commands() { return in_help({"--help"}, "^  ([a-z]+) "); }
  std::set<std::string> options(const std::string& command) {
    std::set<std::string> names;
    for (const std::string& list : in_help({command, "--help"}, "^  (-[-a-zA-Z,]+)")) {
      std::istringstream stream(list);
      for (std::string name; std::getline(stream, name, ',');) names.insert(name);
    }
    return names;
  }

  // What bash offers for the last of the words, with the script sourced after `before`.
  Lines offered_by_bash(const Lines& words, const std::string& before = "") {
    folder_.write("billow.bash", generated("bash"));
    Lines arguments = {"--norc", "-c", before + R"(source ./billow.bash
      COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)); _billow; printf '%s\n' "${COMPREPLY[@]}" | sort)",
                       "bash", "billow"};
    arguments.insert(arguments.end(), words.begin(), words.end());
    const ToolResult result = run_program("bash", arguments, folder_.path());
    EXPECT_EQ(result.errors, "");
    Lines lines = lines_of(result.output);
    return lines == Lines{""} ? Lines() : lines;
  }

  Lines offered_by_fish(const std::string& line) {
    folder_.write("billow.fish", generated("fish"));
    const ToolResult result =
        run_program("env", {"HOME=.", "fish", "--no-config", "-c", "source billow.fish; complete -C '" + line + "'"},
                    folder_.path());
    EXPECT_EQ(result.errors, "");
    Lines lines;
    for (const std::string& offer : lines_of(result.output)) lines.push_back(offer.substr(0, offer.find('\t')));
    return lines;
  }

  test::SceneFolder folder_;
};

// From "    render)" to the end of the case.
std::string case_of(const std::string& script, const std::string& command) {
  const std::size_t begin = script.find("\n    " + command + ")\n");
  return begin == std::string::npos ? "" : script.substr(begin, script.find("\n      ;;\n", begin) - begin);
}

bool is_word_of(const std::string& text, const std::string& word) {
  return std::regex_search(text, std::regex("(^|[^-a-zA-Z])" + word + "($|[^-a-zA-Z])"));
}

TEST_F(Generate, HoldsEveryOptionOfEveryCommand) {
  const std::string man = std::regex_replace(generated("man"), std::regex(R"(\\-)"), "-");
  const std::string bash = generated("bash"), zsh = generated("zsh"), fish = generated("fish");
  ASSERT_THAT(commands(), testing::IsSupersetOf({"render", "study", "compare", "doctor"}));
  for (const std::string& command : commands()) {
    SCOPED_TRACE(command);
    const std::size_t section = man.find(".SS \\fBbillow\\fR \\fB" + command + "\\fR");
    ASSERT_NE(section, std::string::npos);
    const std::string of_program = man.substr(0, man.find(".SH COMMANDS"));
    const std::string of_command = man.substr(section, man.find(".S", section + 3) - section);
    ASSERT_THAT(options(command), testing::Contains("--help"));
    for (const std::string& option : options(command)) {
      SCOPED_TRACE(option);
      const bool is_long = option.starts_with("--");
      EXPECT_TRUE(is_word_of(of_program + of_command, "\\\\fB" + option + "\\\\fR"));
      EXPECT_TRUE(is_word_of(case_of(bash, command), option));
      EXPECT_TRUE(is_word_of(case_of(zsh, command), option));
      EXPECT_TRUE(std::regex_search(fish, std::regex("__fish_seen_subcommand_from " + command + "'[^'\n]*" +
                                                     (is_long ? " -l " : " -s ") + option.substr(is_long ? 2 : 1))));
    }
  }
}

TEST_F(Generate, ManualPageSaysWhatAnOptionNeeds) {
  const std::string man = std::regex_replace(generated("man"), std::regex(R"(\\f[BIR]|\\)"), "");
  EXPECT_THAT(man, testing::HasSubstr("Run that script. Needs --slurm.\n"));
  EXPECT_THAT(man, testing::HasSubstr("--version [--json]"));  // which alone says nothing
}

TEST_F(Generate, BashCompletesCommandsOptionsAndWords) {
  EXPECT_THAT(offered_by_bash({"si"}), ElementsAre("simulate"));
  EXPECT_THAT(offered_by_bash({"gen"}), IsEmpty());
  EXPECT_THAT(offered_by_bash({"--ver"}), ElementsAre("--version"));
  EXPECT_THAT(offered_by_bash({"render", "--over"}), ElementsAre("--overwrite"));
  EXPECT_THAT(offered_by_bash({"render", "--progress", ""}), ElementsAre("auto", "json", "none", "plain"));
  EXPECT_THAT(offered_by_bash({"render", "--progress", "=", "j"}), ElementsAre("json"));
  EXPECT_THAT(offered_by_bash({"render", "--cache", "pc2,m"}), ElementsAre("pc2,mdd"));
  EXPECT_THAT(offered_by_bash({"render", "--cache", "pc2,p"}), ElementsAre("pc2,ply"));
  EXPECT_THAT(offered_by_bash({"compare", "--metric", "s"}), ElementsAre("ssim="));
  EXPECT_THAT(offered_by_bash({"compare", "--metric", "ssim", "=", ""}), IsEmpty());
}

TEST_F(Generate, BashCompletesFilesByWhatIsAskedFor) {
  for (const char* package : {"", "source /usr/share/bash-completion/bash_completion 2>/dev/null\n"}) {
    SCOPED_TRACE(package);
    EXPECT_THAT(offered_by_bash({"check", "dr"}, package), ElementsAre("drafts", "drape.yaml", "dress.YML"));
    EXPECT_THAT(offered_by_bash({"mesh", "dr"}, package), ElementsAre("drafts", "dragon.obj"));
    EXPECT_THAT(offered_by_bash({"render", "drape.yaml", "-o", "dr"}, package), ElementsAre("drafts"));
    EXPECT_THAT(offered_by_bash({"render", "--threads", "2", "drape.y"}, package), ElementsAre("drape.yaml"));
    EXPECT_THAT(offered_by_bash({"render", "drape.yaml", "dr"}, package), IsEmpty());
    EXPECT_THAT(offered_by_bash({"compare", "drawing.png", "dra"}, package),
                UnorderedElementsAre("drafts", "dragon.obj", "drape.yaml", "drawing.png"));
  }
}

TEST_F(Generate, FishCompletesTheSame) {
  EXPECT_THAT(offered_by_fish("billow si"), ElementsAre("simulate"));
  EXPECT_THAT(offered_by_fish("billow render --over"), ElementsAre("--overwrite"));
  EXPECT_THAT(offered_by_fish("billow render --progress "), ElementsAre("auto", "json", "none", "plain"));
  EXPECT_THAT(offered_by_fish("billow compare --metric s"), ElementsAre("ssim="));
  EXPECT_THAT(offered_by_fish("billow check dr"), ElementsAre("drafts/", "drape.yaml", "dress.YML"));
  EXPECT_THAT(offered_by_fish("billow render drape.yaml -o dr"), ElementsAre("drafts/"));
  EXPECT_THAT(offered_by_fish("billow compare --mask drawi"), ElementsAre("drawing.png"));
}

TEST_F(Generate, IsReadWithoutComplaint) {
  for (const char* shell : {"bash", "zsh", "fish"}) {
    folder_.write("script", generated(shell));
    const ToolResult result = run_program(shell, {"-n", "script"}, folder_.path());
    EXPECT_EQ(result.status, 0) << shell;
    EXPECT_EQ(result.errors, "") << shell;
  }
  folder_.write("billow.1", generated("man"));
  const ToolResult page =
      run_program("env", {"MANWIDTH=100", "LC_ALL=C.UTF-8", "man", "--warnings", "-l", "./billow.1"}, folder_.path());
  EXPECT_EQ(page.status, 0);
  EXPECT_EQ(page.errors, "");
  EXPECT_THAT(page.output, HasSubstr("billow render SCENE"));
}

TEST_F(Generate, IsNoPartOfTheHelp) {
  EXPECT_THAT(run_tool({"--help"}, folder_.path()).output, Not(HasSubstr("generate")));
  const ToolResult wrong = run_tool({"generate", "bsh"}, folder_.path());
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.errors, HasSubstr("there is no 'bsh'; did you mean 'bash'?"));
}

}  // namespace
}  // namespace billow
