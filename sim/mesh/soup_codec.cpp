// Polygons <-> bytes: counts, then each array as it lies in memory.
#include "sim/mesh/soup_codec.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "base/error.h"

namespace billow::sim {
namespace {

template <typename T>
void put(std::string& bytes, const T* values, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

void put_count(std::string& bytes, std::size_t count) {
  const auto wide = static_cast<std::uint64_t>(count);
  put(bytes, &wide, 1);
}

template <typename Matrix>
void put_rows(std::string& bytes, const Matrix& matrix) {
  put_count(bytes, static_cast<std::size_t>(matrix.rows()));
  put(bytes, matrix.data(), static_cast<std::size_t>(matrix.size()));
}

// Takes values off the front of the bytes and never reads past their end.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}

  template <typename T>
  void take(T* values, std::size_t count) {
    if (count > rest_.size() / sizeof(T)) fail();
    if (count == 0) return;  // an empty array may have no address
    std::memcpy(static_cast<void*>(values), rest_.data(), count * sizeof(T));
    rest_.remove_prefix(count * sizeof(T));
  }

  // A count of things of at least `size` bytes each: no more of them than there are bytes left.
  std::size_t take_count(std::size_t size) {
    std::uint64_t count = 0;
    take(&count, 1);
    if (count > rest_.size() / size) fail();
    return static_cast<std::size_t>(count);
  }

  template <typename Matrix>
  void take_rows(Matrix& matrix) {
    matrix.resize(static_cast<Eigen::Index>(take_count(sizeof(typename Matrix::Scalar) * matrix.cols())),
                  matrix.cols());
    take(matrix.data(), static_cast<std::size_t>(matrix.size()));
  }

  void expect_end() const {
    if (!rest_.empty()) fail();
  }

  [[noreturn]] static void fail() { throw InputError("the importer sent a damaged mesh; the file is probably broken"); }

 private:
  std::string_view rest_;
};

void take_groups(Reader& reader, PolygonSoup& soup) {
  const std::size_t groups = reader.take_count(2 * sizeof(std::uint64_t));
  for (std::size_t g = 0; g < groups; ++g) {
    std::string name(reader.take_count(1), '\0');
    reader.take(name.data(), name.size());
    std::vector<int> members(reader.take_count(sizeof(int)));
    reader.take(members.data(), members.size());
    soup.group.emplace(std::move(name), std::move(members));
  }
}

void check_indices(const PolygonSoup& soup) {
  const auto valid = [raw = soup.position.rows()](int index) { return index >= 0 && index < raw; };
  for (const Face& face : soup.face)
    if (!std::all_of(face.begin(), face.begin() + 3, valid) || (face[3] != -1 && !valid(face[3]))) Reader::fail();
  for (const auto& [name, members] : soup.group)
    if (!std::all_of(members.begin(), members.end(), valid)) Reader::fail();
}

void check_optional_rows(const PolygonSoup& soup) {
  const Eigen::Index raw = soup.position.rows();
  if (soup.uv.rows() != 0 && soup.uv.rows() != raw) Reader::fail();
  if (soup.colour.rows() != 0 && soup.colour.rows() != raw) Reader::fail();
}

}  // namespace

std::string encode_soup(const PolygonSoup& soup) {
  std::string bytes;
  put_rows(bytes, soup.position);
  put_rows(bytes, soup.uv);
  put_rows(bytes, soup.colour);
  put_count(bytes, soup.face.size());
  put(bytes, soup.face.data(), soup.face.size());
  put_count(bytes, soup.group.size());
  for (const auto& [name, members] : soup.group) {
    put_count(bytes, name.size());
    put(bytes, name.data(), name.size());
    put_count(bytes, members.size());
    put(bytes, members.data(), members.size());
  }
  return bytes;
}

PolygonSoup decode_soup(std::string_view bytes) {
  Reader reader(bytes);
  PolygonSoup soup;
  reader.take_rows(soup.position);
  reader.take_rows(soup.uv);
  reader.take_rows(soup.colour);
  soup.face.resize(reader.take_count(sizeof(Face)));
  reader.take(soup.face.data(), soup.face.size());
  take_groups(reader, soup);
  reader.expect_end();
  check_optional_rows(soup);
  check_indices(soup);
  return soup;
}

}  // namespace billow::sim
