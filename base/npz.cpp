// Arrays of NumPy's, uncompressed in a ZIP archive.
#include "base/npz.h"

#include <fmt/format.h>
#include <zip.h>

#include <bit>
#include <cstring>
#include <memory>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/npy.h"

namespace billow {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::string_view extension = ".npy";

std::string array_of(const std::vector<long>& shape, const double* values, std::size_t count) {
  std::string bytes = npy_header("<f8", shape, true);
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(double));
  return bytes;
}

[[noreturn]] void fail_to_write(const std::filesystem::path& file, const char* why) {
  throw OutputError(fmt::format("cannot write {}: {}", file.string(), why));
}

using Archive = std::unique_ptr<zip_t, decltype(&zip_discard)>;

void add(zip_t* archive, const std::string& name, const std::string& bytes, const std::filesystem::path& file) {
  zip_source_t* source = zip_source_buffer(archive, bytes.data(), bytes.size(), 0);
  const zip_int64_t index =
      source ? zip_file_add(archive, (name + std::string(extension)).c_str(), source, ZIP_FL_ENC_UTF_8) : -1;
  if (index < 0) {
    zip_source_free(source);
    fail_to_write(file, zip_strerror(archive));
  }
  constexpr zip_uint16_t no_time = 0, no_date = 0x21;  // 1980-01-01: the bytes say nothing of when
  zip_set_file_compression(archive, static_cast<zip_uint64_t>(index), ZIP_CM_STORE, 0);
  zip_file_set_dostime(archive, static_cast<zip_uint64_t>(index), no_time, no_date, 0);
}

// What was written to `target`, an archive in memory.
std::string bytes_of(zip_source_t* target) {
  zip_stat_t stat;
  std::string bytes;
  if (zip_source_stat(target, &stat) != 0 || zip_source_open(target) != 0) return bytes;
  bytes.resize(stat.size);
  if (zip_source_read(target, bytes.data(), bytes.size()) != static_cast<zip_int64_t>(bytes.size())) bytes.clear();
  zip_source_close(target);
  return bytes;
}

std::string packed(const std::map<std::string, std::string>& arrays, const std::filesystem::path& file) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* target = zip_source_buffer_create(nullptr, 0, 0, &error);
  if (!target) fail_to_write(file, zip_error_strerror(&error));
  const std::unique_ptr<zip_source_t, decltype(&zip_source_free)> kept(target, zip_source_free);
  zip_source_keep(target);  // by us beside the archive
  Archive archive(zip_open_from_source(target, ZIP_CREATE | ZIP_TRUNCATE, &error), zip_discard);
  if (!archive) {
    zip_source_free(target);
    fail_to_write(file, zip_error_strerror(&error));
  }
  for (const auto& [name, bytes] : arrays) add(archive.get(), name, bytes, file);
  if (zip_close(archive.get()) != 0) fail_to_write(file, zip_strerror(archive.get()));
  static_cast<void>(archive.release());  // closed
  return bytes_of(target);
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw InputError(fmt::format("{}: {}", file.string(), why));
}

std::string contents_of(zip_t* archive, zip_uint64_t index, const std::filesystem::path& file) {
  constexpr zip_uint64_t most = 1ULL << 34;  // [byte] a damaged directory must not claim all memory
  zip_stat_t stat;
  if (zip_stat_index(archive, index, 0, &stat) != 0 || !(stat.valid & ZIP_STAT_SIZE) || stat.size > most)
    refuse(file, "is damaged: an array has no size");
  const std::unique_ptr<zip_file_t, decltype(&zip_fclose)> entry(zip_fopen_index(archive, index, 0), zip_fclose);
  std::string bytes(stat.size, '\0');
  const bool whole = entry && zip_fread(entry.get(), bytes.data(), bytes.size()) == static_cast<zip_int64_t>(stat.size);
  char beyond;
  if (!whole || zip_fread(entry.get(), &beyond, 1) != 0) refuse(file, "is damaged: an array is cut short");
  return bytes;
}

// The sizes in a header that is npy_header's for them and nothing else.
std::vector<long> shape_in(const std::string& bytes) {
  long rows = 0, columns = 0;
  const std::size_t at = bytes.find("'shape': (");
  if (at == std::string::npos || std::sscanf(bytes.c_str() + at, "'shape': (%ld, %ld)", &rows, &columns) != 2)
    return {};
  return {rows, columns};
}

void take(const std::string& name, const std::string& bytes, const std::filesystem::path& file, Npz& result) {
  const std::vector<long> shape = shape_in(bytes.substr(0, 256));
  const std::string header = npy_header("<f8", shape, true);
  const bool sound =
      shape.empty() || (shape[0] >= 0 && shape[1] >= 0 && shape[0] < (1L << 31) && shape[1] < (1L << 31));
  const std::size_t count = !sound ? 0 : shape.empty() ? 1 : static_cast<std::size_t>(shape[0] * shape[1]);
  if (!sound || !bytes.starts_with(header) || bytes.size() != header.size() + count * sizeof(double))
    refuse(file, fmt::format("the array '{}' is not as billow writes it", name));
  if (shape.empty()) {
    std::memcpy(&result.number[name], bytes.data() + header.size(), sizeof(double));
    return;
  }
  Eigen::MatrixXd& matrix = result.matrix[name];
  matrix.resize(shape[0], shape[1]);
  if (count > 0) std::memcpy(matrix.data(), bytes.data() + header.size(), count * sizeof(double));  // else no address
}

template <class Value>
const Value& at(const std::map<std::string, Value>& values, const std::string& name) {
  const auto found = values.find(name);
  if (found == values.end()) throw InputError(fmt::format("there is no array '{}'", name));
  return found->second;
}

}  // namespace

const Eigen::MatrixXd& Npz::matrix_at(const std::string& name) const { return at(matrix, name); }
double Npz::number_at(const std::string& name) const { return at(number, name); }

void write_npz(const std::filesystem::path& file, const Npz& contents) {
  std::map<std::string, std::string> arrays;
  for (const auto& [name, matrix] : contents.matrix)
    arrays[name] = array_of({matrix.rows(), matrix.cols()}, matrix.data(), static_cast<std::size_t>(matrix.size()));
  for (const auto& [name, number] : contents.number) arrays[name] = array_of({}, &number, 1);
  write_file_atomically(file, packed(arrays, file));
}

Npz read_npz(const std::filesystem::path& file) {
  int code = 0;
  const Archive archive(zip_open(file.c_str(), ZIP_RDONLY | ZIP_CHECKCONS, &code), zip_discard);
  if (!archive) {
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    refuse(file, fmt::format("cannot be read as NPZ: {}", zip_error_strerror(&error)));
  }
  Npz result;
  for (zip_int64_t k = 0; k < zip_get_num_entries(archive.get(), 0); ++k) {
    const char* stored = zip_get_name(archive.get(), static_cast<zip_uint64_t>(k), 0);
    const std::string name = stored ? stored : "";
    if (!name.ends_with(extension)) refuse(file, fmt::format("holds '{}', which is no array", name));
    take(name.substr(0, name.size() - extension.size()), contents_of(archive.get(), static_cast<zip_uint64_t>(k), file),
         file, result);
  }
  return result;
}

}  // namespace billow
