// A program of libFuzzer's for one of the readers (tests/fuzz/run), which BILLOW_FUZZ_READER names; its files lie in
// the folder BILLOW_FUZZ_FOLDER, which is empty at first.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "base/error.h"
#include "tests/fuzz/readers.h"

namespace {

const billow::test::FuzzReader* reader = nullptr;
std::filesystem::path folder;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  const char* const name = std::getenv("BILLOW_FUZZ_READER");
  const char* const files = std::getenv("BILLOW_FUZZ_FOLDER");
  reader = name ? billow::test::find_fuzz_reader(name) : nullptr;
  if (!reader || !files) {
    for (const auto& known : billow::test::fuzz_readers()) std::puts(known.name.data());
    std::exit(name ? 2 : 0);
  }
  folder = files;
  billow::test::furnish_fuzz_folder(folder);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  try {
    reader->read({reinterpret_cast<const char*>(bytes), size}, folder);
  } catch (const billow::InputError&) {
    // the input is refused, as it should be
  }
  return 0;
}
