// NumPy's archives: doubles go through them to the bit, and what is damaged is refused.
#include "base/npz.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/npy.h"
#include "tests/support/mesh_files.h"
#include "tests/support/scene_files.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

Npz sample() {
  Npz contents;
  contents.matrix["position"] = Eigen::VectorXd::LinSpaced(21, -1.0, 1.0 / 3.0).reshaped(7, 3);
  contents.matrix["position"](2, 1) = std::numeric_limits<double>::denorm_min();
  contents.matrix["nothing"] = Eigen::MatrixXd(0, 3);
  contents.number["time"] = 0.1 + 0.2;
  return contents;
}

class NpzFile : public testing::Test {
 protected:
  std::filesystem::path file() const { return folder_.path() / "state.npz"; }
  test::TemporaryFolder folder_;
};

TEST_F(NpzFile, GivesBackWhatWasWritten) {
  const Npz written = sample();
  write_npz(file(), written);
  const Npz read = read_npz(file());
  EXPECT_EQ(read.matrix_at("position"), written.matrix_at("position"));
  EXPECT_EQ(read.matrix_at("nothing").rows(), 0);
  EXPECT_EQ(read.matrix_at("nothing").cols(), 3);
  EXPECT_EQ(read.number_at("time"), 0.1 + 0.2);
  EXPECT_THROW(static_cast<void>(read.matrix_at("time")), InputError);
}

TEST_F(NpzFile, HasTheSameBytesForTheSameNumbers) {
  write_npz(file(), sample());
  const std::string first = test::read_text(file());
  write_npz(file(), read_npz(file()));
  EXPECT_EQ(test::read_text(file()), first);
}

TEST_F(NpzFile, IsRefusedWhenDamagedAnywhere) {
  write_npz(file(), sample());
  const std::string whole = test::read_text(file());
  for (std::size_t size = 0; size < whole.size(); size += 37) {
    folder_.write("state.npz", whole.substr(0, size));
    EXPECT_THROW(read_npz(file()), InputError) << size;
  }
  for (std::size_t at = 0; at < whole.size(); at += 5) {
    std::string other = whole;
    other[at] ^= 0x55;
    folder_.write("state.npz", other);
    try {
      const Npz read = read_npz(file());  // a byte that stands for nothing
      if (read.matrix.count("position")) {
        EXPECT_EQ(read.matrix_at("position"), sample().matrix_at("position")) << at;
      }
    } catch (const InputError&) {
    }
  }
  EXPECT_THROW(read_npz(folder_.path() / "none.npz"), InputError);
}

// The header of format 1.0 as numpy.lib.format describes it.
TEST(NpyHeader, IsAlignedAndSaysItsLength) {
  for (const std::vector<long>& shape : std::vector<std::vector<long>>{{}, {3}, {2, 3}, {123456, 7, 3}}) {
    const std::string header = npy_header("<f8", shape, false);
    EXPECT_EQ(header.size() % 64, 0U);
    EXPECT_EQ(header.back(), '\n');
    EXPECT_EQ(static_cast<unsigned char>(header[8]) + 256U * static_cast<unsigned char>(header[9]), header.size() - 10);
  }
  EXPECT_THAT(npy_header("<f4", {3}, true),
              testing::HasSubstr("{'descr': '<f4', 'fortran_order': True, 'shape': (3,), }"));
  EXPECT_THAT(npy_header("<f8", {}, false), testing::HasSubstr("'shape': (), }"));
}

}  // namespace
}  // namespace billow
