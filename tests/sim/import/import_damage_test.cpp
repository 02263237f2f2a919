// Damaged and hostile files: each must give a mesh or a reason, soon, and leave the tool alive.
#include <gtest/gtest.h>

#include <chrono>
#include <random>

#include "base/error.h"
#include "sim/import/mesh_import.h"
#include "tests/support/mesh_files.h"

namespace billow::sim {
namespace {

// Forking a sanitized program is ten times slower.
#ifdef BILLOW_SANITIZE
constexpr int rounds = 30;
#else
constexpr int rounds = 200;
#endif

// An importer may use a second of processor time on a small file; the machine may be busy with other things.
constexpr std::chrono::seconds longest_import(10);

class Damage : public testing::TestWithParam<const char*> {
 protected:
  // A mesh or an InputError; anything else fails the test or ends it. Returns whether a mesh came.
  bool survives(const std::string& bytes) {
    const auto file = folder_.write(std::string("damaged.") + GetParam(), bytes);
    const auto start = std::chrono::steady_clock::now();
    bool read = false;
    try {
      const Mesh mesh = import_mesh(file);
      EXPECT_TRUE(mesh.position.allFinite());
      for (const Face& face : mesh.face)
        for (int c = 0; c < corner_count(face); ++c) EXPECT_LT(static_cast<unsigned>(face[c]), mesh.vertices() + 0u);
      read = true;
    } catch (const InputError&) {
    }
    slowest_ = std::max(slowest_, std::chrono::steady_clock::now() - start);
    return read;
  }

  const std::string whole_ = test::mesh_file(GetParam(), test::triangulated(test::quad_grid(4, 3)));
  std::chrono::steady_clock::duration slowest_{};

 private:
  test::TemporaryFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(Import, Damage, testing::Values("obj", "off", "ply", "stl", "gltf", "glb"),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(Damage, OfAnyByte) {
  std::mt19937_64 random(2007);
  for (int round = 0; round < rounds; ++round) {
    std::string bytes = whole_;
    for (std::uint64_t k = random() % 5 + 1; k > 0; --k) bytes[random() % bytes.size()] = static_cast<char>(random());
    survives(bytes);
  }
  EXPECT_LT(slowest_, longest_import);
}

TEST_P(Damage, OfDigits) {
  std::mt19937_64 random(7);
  for (int round = 0; round < rounds / 2; ++round) {
    std::string bytes = whole_;
    for (int k = 0; k < 200; ++k)
      if (char& c = bytes[random() % bytes.size()]; c >= '0' && c <= '9') {
        c = static_cast<char>('0' + random() % 10);
        break;
      }
    survives(bytes);
  }
  EXPECT_LT(slowest_, longest_import);
}

TEST_P(Damage, ByTruncation) {
  for (int k = 1; k < 40; ++k) survives(whole_.substr(0, whole_.size() * static_cast<std::size_t>(k) / 40));
  EXPECT_LT(slowest_, longest_import);
}

TEST_P(Damage, BeyondRecognition) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 20; ++round) {
    std::string bytes(1 + random() % 2000, '\0');
    for (char& c : bytes) c = static_cast<char>(random());
    EXPECT_FALSE(survives(bytes));
  }
  EXPECT_LT(slowest_, longest_import);
}

// A file of one format under another's name must not be sniffed into the other's importer. glTF and GLB are one.
TEST_P(Damage, ByTheWrongName) {
  for (const std::string_view other : {"obj", "off", "ply", "stl", "gltf", "glb"})
    if (other != GetParam() && !(other.starts_with("gl") && std::string_view(GetParam()).starts_with("gl"))) {
      SCOPED_TRACE(other);
      EXPECT_FALSE(survives(test::mesh_file(other, test::triangulated(test::quad_grid(3, 3)))));
    }
}

}  // namespace
}  // namespace billow::sim
