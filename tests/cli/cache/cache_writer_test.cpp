// Geometry caches as bytes, read back by what each format's description says and by nothing of the writers.
#include "cli/cache/cache_writer.h"

#include <cstring>
#include <sstream>

#include "tests/support/mesh_files.h"
#include "tests/support/tool.h"

namespace billow::cli {
namespace {

// Two triangles over a seam: vertices 0 and 4 are at the same place, vertex 3 is of no face.
CacheMesh seamed() {
  CacheMesh mesh{.name = "flag", .layout = {}, .rest = Eigen::MatrixX3f::Zero(6, 3)};
  mesh.layout.vertex = {0, 1, 2, -1, 0, 3};
  mesh.layout.loose = Eigen::MatrixX3d::Zero(1, 3);
  mesh.layout.face = {{0, 1, 2, -1}, {4, 2, 1, 5}};
  mesh.layout.uv = Eigen::MatrixX2f::Random(6, 2);
  mesh.layout.uv_corner = {{0, 1, 2, -1}, {4, 2, 1, 5}};
  return mesh;
}

CacheFrame frame_of(long number) {
  const Eigen::MatrixX3f values = Eigen::MatrixX3f::Random(6, 3);
  return {number, 0.04 * static_cast<double>(number - 1), values, -2.0f * values, values.col(0), values.col(1)};
}

// The number at `offset`; its bytes reversed where they are the other way round.
template <class T>
T number_at(std::string bytes, std::size_t offset, bool big) {
  bytes = bytes.substr(offset, sizeof(T));
  if (big) bytes.assign(bytes.rbegin(), bytes.rend());
  T value;
  std::memcpy(&value, bytes.data(), sizeof(T));
  return value;
}

void expect_positions(const std::string& bytes, std::size_t offset, std::size_t stride, bool big,
                      const Eigen::MatrixX3f& position) {
  for (Eigen::Index v = 0; v < position.rows(); ++v)
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(number_at<float>(bytes, offset + stride * v + 4 * k, big), position(v, k)) << v << ' ' << k;
}

class CacheFiles : public testing::Test {
 protected:
  std::string written(CacheFormat format, const std::string& file) {
    std::filesystem::create_directories(folder_.path() / "flag");
    const auto writer = make_cache_writer(format, folder_.path(), mesh_);
    for (const CacheFrame& frame : frames_) writer->add(frame);
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "flag.pc2"));
    writer->finish();
    return test::read_text(folder_.path() / file);
  }

  test::TemporaryFolder folder_;
  CacheMesh mesh_ = seamed();
  const std::vector<CacheFrame> frames_{frame_of(3), frame_of(4)};
};

TEST_F(CacheFiles, Pc2) {
  const std::string bytes = written(CacheFormat::pc2, "flag.pc2");
  ASSERT_EQ(bytes.size(), 32u + 2 * 6 * 12);
  EXPECT_EQ(bytes.substr(0, 12), std::string("POINTCACHE2\0", 12));
  EXPECT_EQ(number_at<int>(bytes, 12, false), 1);
  EXPECT_EQ(number_at<int>(bytes, 16, false), 6);
  EXPECT_EQ(number_at<float>(bytes, 20, false), 3.0f);
  EXPECT_EQ(number_at<float>(bytes, 24, false), 1.0f);
  EXPECT_EQ(number_at<int>(bytes, 28, false), 2);
  for (int f = 0; f < 2; ++f) expect_positions(bytes, 32 + 72 * f, 12, false, frames_[f].position);
}

// Frames at even distances are that far apart for who plays them; others follow one another.
TEST_F(CacheFiles, Pc2SaysHowFarApartItsFramesAre) {
  const auto step_of = [&](const std::vector<long>& numbers) {
    const auto writer = make_cache_writer(CacheFormat::pc2, folder_.path(), mesh_);
    for (const long number : numbers) writer->add(frame_of(number));
    writer->finish();
    return number_at<float>(test::read_text(folder_.path() / "flag.pc2"), 24, false);
  };
  EXPECT_EQ(step_of({3}), 1.0f);
  EXPECT_EQ(step_of({1, 6, 11, 16}), 5.0f);
  EXPECT_EQ(step_of({1, 6, 7}), 1.0f);
  EXPECT_EQ(step_of({1, 6, 7, 16}), 1.0f);
}

TEST_F(CacheFiles, Mdd) {
  const std::string bytes = written(CacheFormat::mdd, "flag.mdd");
  ASSERT_EQ(bytes.size(), 8u + 2 * 4 + 2 * 6 * 12);
  EXPECT_EQ(number_at<int>(bytes, 0, true), 2);
  EXPECT_EQ(number_at<int>(bytes, 4, true), 6);
  for (int f = 0; f < 2; ++f) {
    EXPECT_EQ(number_at<float>(bytes, 8 + 4 * f, true), static_cast<float>(frames_[f].time));
    expect_positions(bytes, 16 + 72 * f, 12, true, frames_[f].position);
  }
}

TEST_F(CacheFiles, Obj) {
  std::istringstream text(written(CacheFormat::obj, "flag/frame_0003.obj"));
  std::vector<std::string> faces;
  int vertices = 0, textures = 0;
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    std::string kind;
    Eigen::Vector3f value;
    words >> kind >> value[0] >> value[1] >> value[2];
    if (kind == "v") {
      EXPECT_EQ(value.transpose(), frames_[0].position.row(vertices++));
    }
    if (kind == "vt") {
      EXPECT_EQ(value.head<2>().transpose(), mesh_.layout.uv.row(textures++));
    }
    if (kind == "f") faces.push_back(line);
  }
  EXPECT_EQ(vertices, 6);
  EXPECT_EQ(textures, 6);
  EXPECT_THAT(faces, testing::ElementsAre("f 1/1 2/2 3/3", "f 5/5 3/3 2/2 6/6"));
}

TEST_F(CacheFiles, Ply) {
  const std::string bytes = written(CacheFormat::ply, "flag/frame_0004.ply");
  const std::size_t body = bytes.find("end_header\n") + 11;
  EXPECT_NE(bytes.find("element vertex 6\nproperty float x\n"), bytes.npos);
  EXPECT_NE(bytes.find("property float vx\nproperty float vy\nproperty float vz\nproperty float s\n"), bytes.npos);
  ASSERT_EQ(bytes.size(), body + 6 * 32 + 13 + 17);
  expect_positions(bytes, body, 32, false, frames_[1].position);
  expect_positions(bytes, body + 12, 32, false, frames_[1].velocity);
  EXPECT_EQ(number_at<float>(bytes, body + 5 * 32 + 28, false), mesh_.layout.uv(5, 1));
  EXPECT_EQ(bytes[body + 192], 3);
  EXPECT_EQ(bytes[body + 192 + 13], 4);
  EXPECT_EQ(number_at<int>(bytes, body + 192 + 14, false), 4);
}

// Where a vertex has two texture coordinates no number of it can be right.
TEST_F(CacheFiles, PlyLeavesOutWhatIsNotOneAVertex) {
  mesh_.layout.uv_corner[1] = {4, 3, 1, 5};
  EXPECT_EQ(written(CacheFormat::ply, "flag/frame_0003.ply").find("property float s"), std::string::npos);
}

// Offsets count from the byte after the underscore; every array is led by its size.
TEST_F(CacheFiles, Vtp) {
  const std::string bytes = written(CacheFormat::vtp, "flag/frame_0003.vtp");
  const std::size_t body = bytes.find("<AppendedData encoding=\"raw\">\n_") + 31;
  const auto array = [&](const std::string& name) {
    const std::size_t element = bytes.find("Name=\"" + name + "\"");
    return body + std::stoul(bytes.substr(bytes.find("offset=\"", element) + 8));
  };
  EXPECT_EQ(number_at<std::uint64_t>(bytes, array("Points"), false), 72u);
  expect_positions(bytes, array("Points") + 8, 12, false, frames_[0].position);
  expect_positions(bytes, array("velocity") + 8, 12, false, frames_[0].velocity);
  EXPECT_EQ(number_at<float>(bytes, array("strain") + 8 + 4 * 5, false), frames_[0].strain(5));
  EXPECT_EQ(number_at<float>(bytes, array("contact") + 8 + 4 * 5, false), frames_[0].contact(5));
  EXPECT_EQ(number_at<int>(bytes, array("offsets") + 12, false), 7);
  const std::string collection = test::read_text(folder_.path() / "flag.pvd");
  EXPECT_NE(collection.find("timestep=\"0.12\" part=\"0\" file=\"flag/frame_0004.vtp\""), collection.npos)
      << collection;
}

}  // namespace
}  // namespace billow::cli
