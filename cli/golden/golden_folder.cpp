// Making and clearing.
#include "cli/golden/golden_folder.h"

#include <fmt/format.h>

#include <system_error>

#include "base/atomic_file.h"
#include "base/error.h"
#include "cli/run/output_folder.h"

namespace billow::cli {

namespace fs = std::filesystem;

namespace {

// Never through a link: what is one is removed itself.
void remove_all_of(const fs::path& folder) {
  std::error_code error;
  fs::remove_all(folder, error);
  if (error) throw OutputError(fmt::format("cannot remove what is in {}: {}", folder.string(), error.message()));
}

}  // namespace

// The record stands for a folder of tests, also where they are stopped.
void GoldenFolder::begin() const {
  std::error_code error;
  if (fs::exists(folder_, error) && !fs::is_directory(folder_, error))
    throw OutputError(fmt::format("{} is not a folder; choose another with -o", folder_.string()));
  const bool empty = fs::directory_iterator(folder_, error) == fs::directory_iterator();
  if (!empty && !fs::is_regular_file(fs::symlink_status(record(), error)))
    throw OutputError(
        fmt::format("{} already holds files that are not of tests; choose another folder with -o", folder_.string()));
  make_folder(folder_);
  remove_strays(folder_);
  if (empty) write_file_atomically(record(), "{}\n");
}

void GoldenFolder::remove_pictures() const { remove_all_of(all_pictures()); }

void GoldenFolder::begin_test(const std::string& test) const {
  make_folder_within(folder_, fs::path("actual") / test);
  make_folder_within(folder_, fs::path("runs") / test / "film");
  remove_all_of(pictures_of(test));
  make_folder(pictures_of(test));
}

fs::path pictures_of(const GoldenTest& test, const GoldenFolder& folder) {
  const auto* found = std::get_if<FoundPictures>(&test.pictures);
  return found ? found->folder : folder.pictures_of(test.name);
}

}  // namespace billow::cli
