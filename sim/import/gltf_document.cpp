// Reading glTF's containers: JSON, GLB chunks, buffers, views, accessors.
#include "sim/import/gltf_document.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "sim/import/byte_reader.h"
#include "sim/import/mesh_text.h"

namespace billow::sim {

using nlohmann::json;

namespace {

constexpr std::uint32_t json_chunk = 0x4e4f534a, bin_chunk = 0x004e4942;

json parse(std::string text) {
  text = plain_text(std::move(text));
  while (!text.empty() && text.back() == '\0') text.pop_back();
  json root = json::parse(text, nullptr, false);
  if (!root.is_object())
    throw InputError("it is no glTF: its JSON cannot be read; it is truncated or broken, export it again");
  return root;
}

struct Component {
  std::size_t bytes;
  double largest;  // what a normalised value of 1 is
};

Component component_of(long long type) {
  switch (type) {
    case 5120:
      return {1, 127.0};
    case 5121:
      return {1, 255.0};
    case 5122:
      return {2, 32767.0};
    case 5123:
      return {2, 65535.0};
    case 5125:
      return {4, 4294967295.0};
    case 5126:
      return {4, 1.0};
  }
  throw InputError(fmt::format("an accessor has the component type {}, which glTF does not have", type));
}

double take(ByteReader& reader, long long type) {
  switch (type) {
    case 5120:
      return reader.take<std::int8_t>();
    case 5121:
      return reader.take<std::uint8_t>();
    case 5122:
      return reader.take<std::int16_t>();
    case 5123:
      return reader.take<std::uint16_t>();
    case 5125:
      return reader.take<std::uint32_t>();
    default:
      return reader.take<float>();
  }
}

int components_of(const std::string& type) {
  static const std::map<std::string, int> counts = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
                                                    {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
  const auto found = counts.find(type);
  if (found == counts.end())
    throw InputError(fmt::format("an accessor has the type '{}', which glTF does not have", type));
  return found->second;
}

// `count` rows of `components` numbers that begin `stride` bytes apart.
void read_rows(std::string_view bytes, std::size_t stride, long long type, bool normalised, Eigen::MatrixXd& rows) {
  const Component component = component_of(type);
  const std::size_t row_bytes = component.bytes * static_cast<std::size_t>(rows.cols());
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    const std::size_t begin = static_cast<std::size_t>(r) * stride;
    if (begin > bytes.size() || row_bytes > bytes.size() - begin)
      throw InputError(
          "an accessor reaches beyond the end of its buffer view; it is truncated or broken, export it again");
    ByteReader reader(bytes.substr(begin, row_bytes), std::endian::little);
    for (Eigen::Index c = 0; c < rows.cols(); ++c) {
      const double value = take(reader, type);
      rows(r, c) = normalised ? std::max(value / component.largest, -1.0) : value;
    }
  }
}

std::string_view part_of(std::string_view bytes, long long offset, long long length, const char* of) {
  if (offset < 0 || length < 0 || static_cast<std::size_t>(offset) > bytes.size() ||
      static_cast<std::size_t>(length) > bytes.size() - static_cast<std::size_t>(offset))
    throw InputError(
        fmt::format("a buffer view reaches beyond the end of {}; it is truncated or broken, export it again", of));
  return bytes.substr(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
}

}  // namespace

long long gltf_integer(const json& object, const char* key, long long otherwise) {
  const auto found = object.find(key);
  if (found == object.end()) return otherwise;
  if (found->is_number_integer()) return found->get<long long>();
  // 4.0 is a whole number of JSON too.
  if (found->is_number() && std::abs(found->get<double>()) < 1e15 &&
      found->get<double>() == std::floor(found->get<double>()))
    return static_cast<long long>(found->get<double>());
  throw InputError(fmt::format("its '{}' is not a whole number; it is broken, export it again", key));
}

double gltf_number(const json& object, const char* key, double otherwise) {
  const auto found = object.find(key);
  if (found == object.end()) return otherwise;
  if (!found->is_number())
    throw InputError(fmt::format("its '{}' is not a number; it is broken, export it again", key));
  return found->get<double>();
}

std::string gltf_text(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

const json& gltf_part(const json& object, const char* key) {
  static const json nothing;
  const auto found = object.find(key);
  if (found == object.end()) return nothing;
  if (!found->is_structured())
    throw InputError(fmt::format("its '{}' is neither list nor object; it is broken, export it again", key));
  return *found;
}

std::vector<double> gltf_numbers(const json& object, const char* key, std::size_t size) {
  const json& list = gltf_part(object, key);
  if (list.is_null()) return {};
  std::vector<double> numbers;
  for (const json& item : list)
    numbers.push_back(item.is_number() ? item.get<double>() : std::numeric_limits<double>::quiet_NaN());
  if (numbers.size() != size)
    throw InputError(
        fmt::format("its '{}' has {} numbers and not {}; it is broken, export it again", key, numbers.size(), size));
  return numbers;
}

std::string from_base64(std::string_view text) {
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    int value = -1;
    if (c >= 'A' && c <= 'Z') value = c - 'A';
    if (c >= 'a' && c <= 'z') value = c - 'a' + 26;
    if (c >= '0' && c <= '9') value = c - '0' + 52;
    if (c == '+' || c == '-') value = 62;
    if (c == '/' || c == '_') value = 63;
    if (c == '=' || is_blank(c)) continue;
    if (value < 0) throw InputError("data in a URI are not base64; it is broken, export it again");
    bits = bits << 6 | static_cast<unsigned>(value);
    if (++count % 4 != 1) bytes += static_cast<char>(bits >> (2 * (3 - (count - 1) % 4)) & 0xff);
  }
  return bytes;
}

std::string from_percent(std::string_view text) {
  std::string plain;
  const auto digit = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
  };
  for (std::size_t k = 0; k < text.size(); ++k) {
    const bool escape = text[k] == '%' && k + 2 < text.size() && digit(text[k + 1]) >= 0 && digit(text[k + 2]) >= 0;
    plain += escape ? static_cast<char>(16 * digit(text[k + 1]) + digit(text[k + 2])) : text[k];
    if (escape) k += 2;
  }
  return plain;
}

GltfDocument::GltfDocument(const std::filesystem::path& file, std::uintmax_t max_file_bytes)
    : folder_(file, max_file_bytes) {
  std::string bytes = read_bytes(file);
  if (bytes.starts_with("glTF"))
    load_binary(std::move(bytes));
  else
    root_ = parse(std::move(bytes));
  const std::string version = gltf_text(gltf_part(root_, "asset"), "version");
  // glTF 1.0 may name no version; its lists are objects.
  if (version.starts_with("1.") || (version.empty() && gltf_part(root_, "meshes").is_object())) throw OldGltf();
  if (!version.starts_with("2."))
    throw InputError(version.empty() ? "it is no glTF: it names no asset version"
                                     : fmt::format("it is of glTF {}, which is not read; export it as 2.0", version));
  load_buffers();
}

void GltfDocument::load_binary(std::string bytes) {
  ByteReader reader(bytes, std::endian::little);
  reader.take<std::uint32_t>();
  const auto version = reader.take<std::uint32_t>();
  if (version == 1) throw OldGltf();
  if (version != 2)
    throw InputError(fmt::format("it is a GLB of version {}, which is not read; export it as 2.0", version));
  const auto length = reader.take<std::uint32_t>();
  if (length > bytes.size())
    throw InputError(
        fmt::format("it should have {} bytes and has {}; it is truncated, export it again", length, bytes.size()));
  std::size_t at = 12;
  bool has_json = false;
  while (at + 8 <= length) {
    ByteReader head(std::string_view(bytes).substr(at), std::endian::little);
    const auto size = head.take<std::uint32_t>();
    const auto kind = head.take<std::uint32_t>();
    at += 8;
    if (size > bytes.size() - at) throw InputError("a chunk reaches beyond its end; it is truncated, export it again");
    if (kind == json_chunk && !has_json) root_ = parse(bytes.substr(at, size)), has_json = true;
    if (kind == bin_chunk && chunk_.empty()) chunk_ = bytes.substr(at, size);
    at += size;
  }
  if (!has_json) throw InputError("it has no JSON chunk; it is truncated or broken, export it again");
}

std::string GltfDocument::resource(const std::string& uri) const {
  if (!uri.starts_with("data:")) return folder_.read(from_percent(uri));
  const std::size_t comma = uri.find(',');
  if (comma == uri.npos) throw InputError("a data URI has no data; it is broken, export it again");
  const std::string_view data = std::string_view(uri).substr(comma + 1);
  return uri.substr(0, comma).ends_with(";base64") ? from_base64(data) : from_percent(data);
}

void GltfDocument::load_buffers() {
  for (const json& buffer : gltf_part(root_, "buffers")) {
    const std::string uri = gltf_text(buffer, "uri");
    buffer_.push_back(uri.empty() && buffer_.empty() ? chunk_ : uri.empty() ? std::string() : resource(uri));
    const long long length = gltf_integer(buffer, "byteLength", 0);
    if (!uri.empty() && static_cast<long long>(buffer_.back().size()) < length)
      throw InputError(fmt::format("its buffer {} should have {} bytes and has {}; it is truncated, export it again",
                                   buffer_.size() - 1, length, buffer_.back().size()));
  }
}

const json& GltfDocument::entry(const char* list, const json& index) const {
  const json& entries = gltf_part(root_, list);
  const long long k = index.is_number_integer() ? index.get<long long>() : -1;
  if (k < 0 || !entries.is_array() || k >= static_cast<long long>(entries.size()) ||
      !entries[static_cast<std::size_t>(k)].is_object())
    throw InputError(
        fmt::format("it refers to {} of '{}', which is not there; it is broken, export it again", index.dump(), list));
  return entries[static_cast<std::size_t>(k)];
}

std::string_view GltfDocument::view(const json& index) const {
  const json& view = entry("bufferViews", index);
  const long long buffer = gltf_integer(view, "buffer", 0);
  entry("buffers", buffer);
  return part_of(buffer_[static_cast<std::size_t>(buffer)], gltf_integer(view, "byteOffset", 0),
                 gltf_integer(view, "byteLength", 0), "its buffer");
}

void GltfDocument::fill(const json& accessor, int components, Eigen::MatrixXd& rows) const {
  const auto view_index = accessor.find("bufferView");
  if (view_index == accessor.end() || rows.rows() == 0) return;  // zeros
  const long long type = gltf_integer(accessor, "componentType", 0);
  const long long offset = gltf_integer(accessor, "byteOffset", 0);
  const std::string_view bytes = view(*view_index);
  const auto natural = static_cast<long long>(component_of(type).bytes) * components;
  const long long stride = gltf_integer(entry("bufferViews", *view_index), "byteStride", natural);
  if (stride < natural || stride > 65536) throw InputError("a buffer view has a stride that is too small or too large");
  read_rows(part_of(bytes, offset, static_cast<long long>(bytes.size()) - offset, "its buffer view"),
            static_cast<std::size_t>(stride), type, accessor.value("normalized", false), rows);
}

void GltfDocument::replace_sparse(const json& sparse, const json& accessor, Eigen::MatrixXd& rows) const {
  const long long count = gltf_integer(sparse, "count", 0);
  if (count < 0 || count > rows.rows()) throw InputError("a sparse accessor has more values than it has rows");
  const auto read = [&](const json& part, long long type, bool normalised, Eigen::Index columns) {
    Eigen::MatrixXd values(static_cast<Eigen::Index>(count), columns);
    const std::string_view bytes = view(part.value("bufferView", json()));
    const long long offset = gltf_integer(part, "byteOffset", 0);
    read_rows(part_of(bytes, offset, static_cast<long long>(bytes.size()) - offset, "its buffer view"),
              component_of(type).bytes * static_cast<std::size_t>(columns), type, normalised, values);
    return values;
  };
  const json& indices = gltf_part(sparse, "indices");
  const Eigen::MatrixXd index = read(indices, gltf_integer(indices, "componentType", 0), false, 1);
  const Eigen::MatrixXd value = read(gltf_part(sparse, "values"), gltf_integer(accessor, "componentType", 0),
                                     accessor.value("normalized", false), rows.cols());
  for (Eigen::Index k = 0; k < index.rows(); ++k) {
    if (!(index(k, 0) < static_cast<double>(rows.rows())))
      throw InputError("a sparse accessor names a row that it lacks");
    rows.row(static_cast<Eigen::Index>(index(k, 0))) = value.row(k);
  }
}

Eigen::MatrixXd GltfDocument::numbers(const json& accessor_index, long long max_count) const {
  const json& accessor = entry("accessors", accessor_index);
  const long long count = gltf_integer(accessor, "count", 0);
  const int components = components_of(gltf_text(accessor, "type"));
  if (count < 0) throw InputError("an accessor has fewer than 0 rows; it is broken, export it again");
  if (count > max_count)
    throw InputError(
        fmt::format("it has {} vertices or face corners in one accessor, and the limit is {}; use a coarser mesh",
                    count, max_count));
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(count), components);
  fill(accessor, components, rows);
  if (const json& sparse = gltf_part(accessor, "sparse"); !sparse.is_null()) replace_sparse(sparse, accessor, rows);
  return rows;
}

}  // namespace billow::sim
