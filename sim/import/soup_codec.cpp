// Polygons <-> bytes: counts, then each array as it lies in memory.
#include "sim/import/soup_codec.h"

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

template <typename T>
void put_list(std::string& bytes, const std::vector<T>& list) {
  put_count(bytes, list.size());
  put(bytes, list.data(), list.size());
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

  template <typename T>
  void take_list(std::vector<T>& list) {
    list.resize(take_count(sizeof(T)));
    take(list.data(), list.size());
  }

  void expect_end() const {
    if (!rest_.empty()) fail();
  }

  [[noreturn]] static void fail() { throw InputError("the importer sent a damaged mesh; export the file again"); }

 private:
  std::string_view rest_;
};

void put_text(std::string& bytes, const std::string& text) {
  put_count(bytes, text.size());
  put(bytes, text.data(), text.size());
}

std::string take_text(Reader& reader) {
  std::string text(reader.take_count(1), '\0');
  reader.take(text.data(), text.size());
  return text;
}

void take_groups(Reader& reader, PolygonSoup& soup) {
  const std::size_t groups = reader.take_count(2 * sizeof(std::uint64_t));
  for (std::size_t g = 0; g < groups; ++g) {
    std::string name = take_text(reader);
    std::vector<int> members;
    reader.take_list(members);
    soup.group.emplace(std::move(name), std::move(members));
  }
}

void put_weights(std::string& bytes, const PolygonSoup& soup) {
  put_count(bytes, soup.weight.size());
  for (const auto& [name, weight] : soup.weight) {
    put_text(bytes, name);
    put_rows(bytes, weight);
  }
}

void take_weights(Reader& reader, PolygonSoup& soup) {
  const std::size_t weights = reader.take_count(2 * sizeof(std::uint64_t));
  for (std::size_t w = 0; w < weights; ++w) {
    std::string name = take_text(reader);
    reader.take_rows(soup.weight[std::move(name)]);
  }
}

void put_materials(std::string& bytes, const PolygonSoup& soup) {
  put_count(bytes, soup.material.size());
  for (const Material& material : soup.material) {
    for (const std::string* text :
         {&material.name, &material.texture, &material.texture_bytes, &material.alpha_texture})
      put_text(bytes, *text);
    put(bytes, material.colour.data(), 4);
    put(bytes, &material.cutoff, 1);
    put_count(bytes, material.alpha ? 1 + static_cast<std::size_t>(*material.alpha) : 0);
  }
  put_list(bytes, soup.face_material);
}

void take_materials(Reader& reader, PolygonSoup& soup) {
  const std::size_t materials = reader.take_count(5 * sizeof(std::uint64_t));
  for (std::size_t m = 0; m < materials; ++m) {
    Material material;
    for (std::string* text : {&material.name, &material.texture, &material.texture_bytes, &material.alpha_texture})
      *text = take_text(reader);
    reader.take(material.colour.data(), 4);
    reader.take(&material.cutoff, 1);
    std::uint64_t alpha = 0;
    reader.take(&alpha, 1);
    if (alpha > 1 + static_cast<std::uint64_t>(AlphaMode::blend)) Reader::fail();
    if (alpha > 0) material.alpha = static_cast<AlphaMode>(alpha - 1);
    soup.material.push_back(std::move(material));
  }
  reader.take_list(soup.face_material);
}

void check_materials(const PolygonSoup& soup) {
  const auto valid = [&](int m) { return m >= -1 && m < static_cast<int>(soup.material.size()); };
  if (!std::all_of(soup.face_material.begin(), soup.face_material.end(), valid)) Reader::fail();
  if (!soup.face_material.empty() && soup.face_material.size() != soup.face.size()) Reader::fail();
}

void put_layout(std::string& bytes, const FileLayout& layout) {
  put_list(bytes, layout.vertex);
  put_rows(bytes, layout.loose);
  put_list(bytes, layout.face);
  put_rows(bytes, layout.uv);
  put_list(bytes, layout.uv_corner);
}

void take_layout(Reader& reader, FileLayout& layout) {
  reader.take_list(layout.vertex);
  reader.take_rows(layout.loose);
  reader.take_list(layout.face);
  reader.take_rows(layout.uv);
  reader.take_list(layout.uv_corner);
}

bool all_within(const std::vector<Face>& faces, Eigen::Index lowest, Eigen::Index end) {
  const auto within = [&](int index) { return index >= lowest && index < end; };
  return std::all_of(faces.begin(), faces.end(), [&](const Face& face) {
    return std::all_of(face.begin(), face.begin() + 3, within) && (face[3] == -1 || within(face[3]));
  });
}

void check_layout(const FileLayout& layout, Eigen::Index raw) {
  const auto valid = [&](int index) { return index >= -1 && index < raw; };
  if (!std::all_of(layout.vertex.begin(), layout.vertex.end(), valid)) Reader::fail();
  if (std::count(layout.vertex.begin(), layout.vertex.end(), -1) != layout.loose.rows()) Reader::fail();
  if (!all_within(layout.face, 0, layout.vertices())) Reader::fail();
  if (!layout.uv_corner.empty() && layout.uv_corner.size() != layout.face.size()) Reader::fail();
  if (!all_within(layout.uv_corner, -1, layout.uv.rows())) Reader::fail();
}

void check_indices(const PolygonSoup& soup) {
  const auto valid = [raw = soup.position.rows()](int index) { return index >= 0 && index < raw; };
  if (!all_within(soup.face, 0, soup.position.rows())) Reader::fail();
  check_layout(soup.layout, soup.position.rows());
  for (const auto& [name, members] : soup.group)
    if (!std::all_of(members.begin(), members.end(), valid)) Reader::fail();
}

void check_optional_rows(const PolygonSoup& soup) {
  const Eigen::Index raw = soup.position.rows();
  if (soup.uv.rows() != 0 && soup.uv.rows() != raw) Reader::fail();
  if (soup.colour.rows() != 0 && soup.colour.rows() != raw) Reader::fail();
  for (const auto& [name, weight] : soup.weight)
    if (weight.rows() != raw) Reader::fail();
}

}  // namespace

std::string encode_soup(const PolygonSoup& soup) {
  std::string bytes;
  put_rows(bytes, soup.position);
  put_rows(bytes, soup.uv);
  put_rows(bytes, soup.colour);
  put_list(bytes, soup.face);
  put_count(bytes, soup.group.size());
  for (const auto& [name, members] : soup.group) {
    put_text(bytes, name);
    put_list(bytes, members);
  }
  put_count(bytes, soup.linear_colour ? 1 : 0);
  put_weights(bytes, soup);
  put_materials(bytes, soup);
  put_count(bytes, soup.ignored.size());
  for (const std::string& what : soup.ignored) put_text(bytes, what);
  put_layout(bytes, soup.layout);
  return bytes;
}

PolygonSoup decode_soup(std::string_view bytes) {
  Reader reader(bytes);
  PolygonSoup soup;
  reader.take_rows(soup.position);
  reader.take_rows(soup.uv);
  reader.take_rows(soup.colour);
  reader.take_list(soup.face);
  take_groups(reader, soup);
  std::uint64_t linear = 0;
  reader.take(&linear, 1);
  soup.linear_colour = linear == 1;
  take_weights(reader, soup);
  take_materials(reader, soup);
  for (std::size_t left = reader.take_count(sizeof(std::uint64_t)); left > 0; --left)
    soup.ignored.push_back(take_text(reader));
  take_layout(reader, soup.layout);
  reader.expect_end();
  check_optional_rows(soup);
  check_indices(soup);
  check_materials(soup);
  return soup;
}

}  // namespace billow::sim
