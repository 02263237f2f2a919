// billow golden: tests' pictures, made and compared with their baselines.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <thread>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/file_trust.h"
#include "base/folder_lock.h"
#include "base/suggest.h"
#include "cli/command/application.h"
#include "cli/command/commands.h"
#include "cli/command/compare_report.h"
#include "cli/golden/golden_work.h"
#include "cli/run/interrupt.h"
#include "cli/text/command_text.h"
#include "cli/text/json_text.h"
#include "cli/text/terminal.h"
#include "render/gl/gl_context.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Of a pattern of pictures, that of their test.
std::string head_of(const std::string& pattern) { return pattern.substr(0, pattern.find('/')); }

bool matches(const std::string& pattern, const std::string& name) {
  return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

/// What --only or --update, whose patterns these are, leaves of the tests. Without patterns: everything.
class Chosen {
 public:
  Chosen(const GoldenTests& tests, std::string_view option, const std::vector<std::string>& patterns)
      : option_(option), patterns_(patterns) {
    for (const GoldenTest& test : tests.tests)
      if (patterns.empty() || std::any_of(patterns.begin(), patterns.end(), [&](const std::string& pattern) {
            return matches(head_of(pattern), test.name);
          }))
        list.push_back(&test);
    for (const std::string& pattern : patterns) check(pattern, tests);
  }

  /// Leaves those that are asked for, and the row of a test that has no pictures.
  void choose(const GoldenTest& test, std::vector<ComparedPair>& pairs) {
    std::erase_if(pairs, [&](const ComparedPair& pair) { return !patterns_.empty() && !is_chosen(test, pair); });
  }

  /// Once all have been chosen from. Throws InputError where a pattern asks for pictures that no test has: all the same
  /// would be said of nothing.
  void check_used() const {
    for (const std::string& pattern : patterns_)
      if (!used_.contains(pattern))
        throw InputError(fmt::format(
            "{}: no test has a picture '{}'; leave out what is behind the / to see which it has", option_, pattern));
  }

  std::vector<const GoldenTest*> list;

 private:
  void check(const std::string& pattern, const GoldenTests& tests) const {
    const std::string name = head_of(pattern);
    if (std::any_of(list.begin(), list.end(), [&](const GoldenTest* test) { return matches(name, test->name); }))
      return;
    std::vector<std::string_view> known;
    for (const GoldenTest& test : tests.tests) known.push_back(test.name);
    throw InputError(fmt::format("{}: there is no test '{}'{}", option_, name, suggestion(name, known, "tests are")));
  }

  bool is_chosen(const GoldenTest& test, const ComparedPair& pair) {
    bool chosen = false;
    for (const std::string& pattern : patterns_)
      if (matches(pattern, test.name) || matches(pattern, test.name + "/" + pair.name) ||
          (pair.name.empty() && matches(head_of(pattern), test.name)))
        used_.insert(pattern), chosen = true;
    return chosen;
  }

  std::string_view option_;
  const std::vector<std::string>& patterns_;
  std::set<std::string> used_;
};

/// A test whose pictures have been compared.
struct JudgedTest {
  const GoldenTest* test = nullptr;
  CompareOptions options;           // its two folders and its tolerance
  std::vector<ComparedPair> pairs;  // named within the test
};

// Links in folders lead anywhere.
void require_trusted_below(const fs::path& folder) {
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    require_trusted(entry->path());
}

// What a picture without a baseline, and a baseline without a picture, need.
void say_what_lacks(ComparedPair& pair) {
  std::error_code error;
  const bool has_baseline = fs::exists(pair.a, error), has_picture = fs::exists(pair.b, error);
  if (pair.verdict != Verdict::different || has_baseline == has_picture) return;
  pair.why = has_picture ? fmt::format("new: it has no baseline yet; look at {}", pair.b.string())
                         : fmt::format("there is no such picture; if that is right, remove {}", pair.a.string());
}

// A mask may lie among the pictures, and is none.
void leave_out_mask(const CompareOptions& options, std::vector<ComparedPair>& pairs) {
  const fs::path mask = options.tolerance.mask.lexically_normal();
  std::erase_if(pairs, [&](const ComparedPair& pair) {
    return pair.a.lexically_normal() == mask || pair.b.lexically_normal() == mask;
  });
  if (pairs.empty()) throw InputError("there is no picture but the mask");
}

std::vector<ComparedPair> pairs_of(const CompareOptions& options) {
  for (const fs::path& folder : {options.a, options.b}) require_trusted_below(folder);
  std::vector<ComparedPair> pairs = compared_folders(options);
  leave_out_mask(options, pairs);
  for (ComparedPair& pair : pairs) say_what_lacks(pair);
  return pairs;
}

JudgedTest judged_test(const GoldenTests& tests, const GoldenTest& test, const GoldenFolder& folder,
                       const std::map<std::string, std::string>& failures) {
  JudgedTest judged;
  judged.test = &test;
  judged.options.a = tests.baselines / test.name;
  judged.options.b = pictures_of(test, folder);
  judged.options.tolerance = test.tolerance;
  try {
    if (const auto failure = failures.find(test.name); failure != failures.end())
      throw InputError("no pictures: " + failure->second);
    std::error_code error;
    if (!fs::is_directory(judged.options.b, error))
      throw InputError(fmt::format("there is no folder {}; run what makes its pictures first",
                                   judged.options.b.lexically_normal().string()));
    if (fs::is_empty(judged.options.b, error))
      throw InputError(fmt::format("{} is empty: {}", judged.options.b.lexically_normal().string(),
                                   std::holds_alternative<MadePictures>(test.pictures)
                                       ? fmt::format("the command wrote no picture to {}; its log is {}",
                                                     MadePictures::output_mark, folder.log_of(test.name).string())
                                       : "run what makes its pictures first"));
    judged.pairs = pairs_of(judged.options);
  } catch (const InputError& fault) {
    judged.pairs = {{"", judged.options.a, judged.options.b, Verdict::unreadable, fault.what(), {}, {}}};
  }
  return judged;
}

// Of all tests, by the names of their tests.
std::vector<ComparedPair> all_pairs(const std::vector<JudgedTest>& judged) {
  std::vector<ComparedPair> all;
  for (const JudgedTest& test : judged)
    for (ComparedPair pair : test.pairs) {
      pair.name = pair.name.empty() ? test.test->name : test.test->name + "/" + pair.name;
      all.push_back(std::move(pair));
    }
  return all;
}

bool is_same(const ComparedPair& pair) { return pair.verdict == Verdict::same; }

Json record_of(const GoldenTests& tests, const std::vector<ComparedPair>& pairs,
               const std::vector<std::string>& accepted) {
  Json record = {{"tests", tests.file.string()}, {"baselines", tests.baselines.string()}};
  record.update(comparison_json(pairs, accepted));
  return record;
}

// What to do about those that differ.
void say_what_next(const std::vector<JudgedTest>& judged, const GoldenOptions& options, const GoldenFolder& folder) {
  std::size_t lacking = 0, all = 0;
  std::vector<std::string> names;
  for (const JudgedTest& test : judged) {
    all += test.pairs.size();
    lacking +=
        test.pairs.size() - static_cast<std::size_t>(std::count_if(test.pairs.begin(), test.pairs.end(), is_same));
    if (std::any_of(test.pairs.begin(), test.pairs.end(), can_be_accepted)) names.push_back(test.test->name);
  }
  if (lacking == 0) return;
  say_line("{} of {} need a look: {}", lacking, all, (folder.path() / "index.html").string());
  std::vector<std::string> words = {"billow", "golden", options.tests.string()};
  if (!options.output.empty()) words.insert(words.end(), {"-o", options.output.string()});
  if (options.may_run_programs) words.push_back("--allow-commands");
  if (options.untrusted) words.push_back("--untrusted");
  if (options.backend.kind != render::BackendKind::automatic)
    words.insert(words.end(), {"--backend", text_of(options.backend)});
  words.push_back("--update");
  words.insert(words.end(), names.begin(), names.end());
  if (!names.empty()) say_line("if they are right: {}", command_line(words));
}

std::vector<std::string> accept_pictures(std::vector<JudgedTest>& judged) {
  std::vector<std::string> accepted;
  for (JudgedTest& test : judged) {
    test.options.accept = true;
    for (const std::string& name : accept(test.pairs, test.options)) accepted.push_back(test.test->name + "/" + name);
  }
  return accepted;
}

// What was found is printed and written before anything is accepted: it is what somebody looks at.
int report_on(std::vector<JudgedTest>& judged, const GoldenTests& tests, const GoldenOptions& options,
              const GoldenFolder& folder) {
  const std::vector<ComparedPair> pairs = all_pairs(judged);
  CompareOptions folders;
  folders.a = tests.baselines;
  folders.b = folder.all_pictures();
  folders.tolerance = tests.tolerance;
  if (!options.json) print_table(pairs, folders);
  if (!options.junit.empty()) write_junit(options.junit, pairs, "billow golden " + tests.file.string());
  write_compare_report(folder.path(), pairs, folders);
  const std::vector<std::string> accepted =
      options.update.empty() ? std::vector<std::string>() : accept_pictures(judged);
  const Json record = record_of(tests, options.update.empty() ? pairs : all_pairs(judged), accepted);
  write_file_atomically(folder.record(), json_text(record, 2) + "\n");
  if (options.json)
    print_json(json_text(record, 2));
  else
    for (const std::string& name : accepted) print_line("accepted {}", name);
  say_what_next(judged, options, folder);
  return record["same"] ? exit_done : exit_images_differ;
}

bool renders(const GoldenTest* test) { return std::holds_alternative<RenderedPictures>(test->pictures); }

int list_tests(const Chosen& chosen) {
  for (const GoldenTest* test : chosen.list) print_line("{}", test->name);
  return exit_done;
}

// Nothing has been compared by then.
int stop(const GoldenTests& tests, const GoldenFolder& folder) {
  const Json record = {{"same", false}, {"tests", tests.file.string()}, {"interrupted", true}};
  write_file_atomically(folder.record(), json_text(record, 2) + "\n");
  say_line("stopped before pictures were compared; the same command begins again");
  return 128 + interrupted_by();
}

GoldenWork work_of(const GoldenOptions& options) {
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return {options.jobs > 0 ? options.jobs : cores, options.may_run_programs, options.backend, options.untrusted};
}

}  // namespace

int golden_command(const GoldenOptions& options) {
  const GoldenTests tests = read_golden_tests(options.tests);
  const GoldenFolder folder(options.output.empty() ? fs::path("out") / tests.file.stem() : options.output);
  if (!options.perform.empty()) return make_own_pictures(tests, options.perform, folder, work_of(options));
  const bool updates = !options.update.empty();
  Chosen chosen(tests, updates ? "--update" : "--only", updates ? options.update : options.only);
  if (options.list) return list_tests(chosen);
  if (updates) check_may_accept("--update");
  // What cannot draw is no difference of every test's.
  if (std::any_of(chosen.list.begin(), chosen.list.end(), renders)) render::GlContext(options.backend);
  catch_interrupts();
  folder.begin();
  const FolderLock lock(folder.path());
  if (chosen.list.size() == tests.tests.size()) folder.remove_pictures();
  const auto failures = make_pictures(tests, chosen.list, folder, work_of(options));
  if (interrupted_by() != 0) return stop(tests, folder);
  std::vector<JudgedTest> judged;
  for (const GoldenTest* test : chosen.list) {
    judged.push_back(judged_test(tests, *test, folder, failures));
    chosen.choose(*test, judged.back().pairs);
  }
  chosen.check_used();
  return report_on(judged, tests, options, folder);
}

}  // namespace billow::cli
