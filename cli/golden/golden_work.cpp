// Children for scenes and programs.
#include "cli/golden/golden_work.h"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <system_error>
#include <thread>

#include "base/child_process.h"
#include "base/error.h"
#include "cli/golden/golden_render.h"
#include "cli/run/progress.h"
#include "cli/study/study_jobs.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;

bool names_program(const GoldenTest& test) { return std::holds_alternative<MadePictures>(test.pictures); }

// What a test's child that came to no good died of.
std::string cause_of(const GoldenTest& test, int status, const fs::path& log) {
  const auto* made = std::get_if<MadePictures>(&test.pictures);
  if (made && status == 128 + SIGALRM)
    return fmt::format("its command took longer than {} s; give it a longer 'timeout'", made->timeout);
  if (made || status > 128)
    return fmt::format("{}: {}; its log is {}", described_end(status), last_words(log), log.string());
  return last_words(log);
}

/// Tests by their places in a list, from 0.
class TestKeeper : public JobKeeper {
 public:
  TestKeeper(const GoldenTests& tests, const std::vector<const GoldenTest*>& due, const GoldenFolder& folder,
             const GoldenWork& work)
      : tests_(tests), due_(due), folder_(folder), work_(work) {}

  Turn turn_of(int number) override {
    folder_.begin_test(test(number).name);
    return Turn::now;
  }

  JobCommand command_of(int number) override {
    std::vector<std::string> words = {"billow",
                                      "golden",
                                      tests_.file.string(),
                                      "-o",
                                      folder_.path().string(),
                                      "--jobs",
                                      std::to_string(work_.jobs),
                                      "--perform",
                                      test(number).name};
    words.insert(words.end(), {"--backend", text_of(work_.backend)});
    if (work_.may_run_programs) words.push_back("--allow-commands");
    if (work_.untrusted) words.push_back("--untrusted");
    return {words, folder_.log_of(test(number).name)};
  }

  bool goes_on(int) override { return true; }

  void ended(const JobEnd& end) override {
    const GoldenTest& test = this->test(end.number);
    if (end.status != 0) failures[test.name] = cause_of(test, end.status, folder_.log_of(test.name));
    say_ended({"tests", ++ended_, due_.size(), test.name, end.status == 0 ? "done" : "failed",
               fmt::format("in {:.1f} s", end.seconds)});
  }

  void waits(const std::vector<int>&) override {}

  std::map<std::string, std::string> failures;

 private:
  const GoldenTest& test(int number) const { return *due_[static_cast<std::size_t>(number)]; }

  const GoldenTests& tests_;
  const std::vector<const GoldenTest*>& due_;
  const GoldenFolder& folder_;
  const GoldenWork& work_;
  std::size_t ended_ = 0;
};

[[noreturn]] void become_command(const MadePictures& made, const GoldenTests& tests, const fs::path& output) {
  std::vector<std::string> words = made.command;
  const std::string mark(MadePictures::output_mark), folder = fs::absolute(output).string();
  for (std::string& word : words)
    for (std::size_t at = word.find(mark); at != word.npos; at = word.find(mark, at + folder.size()))
      word.replace(at, mark.size(), folder);
  const fs::path place = tests.file.parent_path();
  try {
    become_program(words, place.empty() ? "." : place.string(), static_cast<unsigned>(made.timeout));
  } catch (const std::system_error& error) {
    throw InputError(fmt::format("{}; is it installed?", error.what()));
  }
}

}  // namespace

std::map<std::string, std::string> make_pictures(const GoldenTests& tests, const std::vector<const GoldenTest*>& chosen,
                                                 const GoldenFolder& folder, const GoldenWork& work) {
  std::map<std::string, std::string> refused;
  std::vector<const GoldenTest*> due;
  for (const GoldenTest* test : chosen) {
    if (names_program(*test) && !work.may_run_programs)
      refused[test->name] = work.untrusted
                                ? "it is a command, and with --untrusted none is run"
                                : "it is a command, and none is run without --allow-commands; look at it first";
    else if (!std::holds_alternative<FoundPictures>(test->pictures))
      due.push_back(test);
  }
  constexpr std::chrono::seconds grace{2};
  TestKeeper keeper(tests, due, folder, work);
  std::vector<int> numbers;
  for (std::size_t k = 0; k < due.size(); ++k) numbers.push_back(static_cast<int>(k));
  run_jobs(numbers, work.jobs, grace, keeper);
  keeper.failures.merge(refused);
  return keeper.failures;
}

int make_own_pictures(const GoldenTests& tests, const std::string& name, const GoldenFolder& folder,
                      const GoldenWork& work) {
  const auto test = std::find_if(tests.tests.begin(), tests.tests.end(),
                                 [&](const GoldenTest& candidate) { return candidate.name == name; });
  if (test == tests.tests.end()) throw InputError(fmt::format("{}: there is no test '{}'", tests.file.string(), name));
  if (names_program(*test) && !work.may_run_programs) throw InputError("no command is run");
  if (const auto* made = std::get_if<MadePictures>(&test->pictures))
    become_command(*made, tests, folder.pictures_of(name));
  const auto* rendered = std::get_if<RenderedPictures>(&test->pictures);
  if (!rendered) return 0;  // they are there
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return render_pictures(*rendered, folder.film_of(name), folder.pictures_of(name), work.backend,
                         std::max(1, cores / work.jobs));
}

}  // namespace billow::cli
