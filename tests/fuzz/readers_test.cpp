// What fuzzing starts from and what it has found (tests/corpus/fuzz), whole and cut short: no reader may fall over it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "base/error.h"
#include "tests/fuzz/readers.h"
#include "tests/support/mesh_files.h"

namespace billow::test {
namespace {

namespace fs = std::filesystem;

const fs::path kept_inputs = BILLOW_SOURCE_DIR "/tests/corpus/fuzz";

std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class FuzzCorpus : public testing::TestWithParam<FuzzReader> {
 protected:
  FuzzCorpus() { furnish_fuzz_folder(folder_.path()); }

  // An exception that is no InputError fails the test.
  bool is_accepted(std::string_view bytes) {
    try {
      GetParam().read(bytes, folder_.path());
      return true;
    } catch (const InputError& refused) {
      reason_ = refused.what();
      return false;
    }
  }

  TemporaryFolder folder_;
  std::string reason_;  // of the last refusal
};

TEST_P(FuzzCorpus, IsReadOrRefused) {
  for (const auto& input : fs::directory_iterator(kept_inputs / GetParam().name)) {
    SCOPED_TRACE(input.path());
    const std::string bytes = contents(input.path());
    const bool is_seed = input.path().has_extension();  // what libFuzzer leaves has none
    EXPECT_TRUE(is_accepted(bytes) || !is_seed) << "a seed that is refused leads nowhere: " << reason_;
    for (int part = 0; part < 8; ++part) is_accepted(std::string_view(bytes).substr(0, bytes.size() * part / 8));
  }
}

// Some start from files of the repository alone, which other tests read.
std::vector<FuzzReader> readers_with_inputs() {
  std::vector<FuzzReader> readers;
  for (const FuzzReader& reader : fuzz_readers())
    if (fs::exists(kept_inputs / reader.name)) readers.push_back(reader);
  return readers;
}

INSTANTIATE_TEST_SUITE_P(OfEveryReader, FuzzCorpus, testing::ValuesIn(readers_with_inputs()),
                         [](const auto& info) { return std::string(info.param.name); });

// Kept inputs of a reader that is renamed would be forgotten.
TEST(FuzzCorpusFolders, AreEachOfAReader) {
  for (const auto& folder : fs::directory_iterator(kept_inputs))
    EXPECT_TRUE(find_fuzz_reader(folder.path().filename().string())) << folder.path();
}

}  // namespace
}  // namespace billow::test
