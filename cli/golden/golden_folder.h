// Where tests leave what they made.
#pragma once

#include <filesystem>
#include <string>

#include "cli/golden/golden_tests.h"

namespace billow::cli {

/// DIR of `billow golden`: index.html and golden.json of what was compared; actual/NAME, the pictures of each test by
/// their baselines' names; runs/NAME, its log and all that it rendered.
class GoldenFolder {
 public:
  explicit GoldenFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  const std::filesystem::path& path() const { return folder_; }
  std::filesystem::path record() const { return folder_ / "golden.json"; }
  std::filesystem::path all_pictures() const { return folder_ / "actual"; }
  std::filesystem::path pictures_of(const std::string& test) const { return all_pictures() / test; }
  std::filesystem::path film_of(const std::string& test) const { return folder_ / "runs" / test / "film"; }
  std::filesystem::path log_of(const std::string& test) const { return folder_ / "runs" / test / "log.txt"; }

  /// Makes the folder, or checks that it is one of tests. Throws OutputError where it holds anything else.
  void begin() const;
  /// Removes the pictures of all tests, also of those that are no more. Throws OutputError.
  void remove_pictures() const;
  /// Makes the test's own folders; what pictures it has there are removed. Throws OutputError, also where one of them
  /// is a link.
  void begin_test(const std::string& test) const;

 private:
  std::filesystem::path folder_;
};

/// Where the pictures are that a test compares.
std::filesystem::path pictures_of(const GoldenTest& test, const GoldenFolder& folder);

}  // namespace billow::cli
