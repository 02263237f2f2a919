// Columns are spooled as they come and turned into rows, block by block, at the end.
#include "render/velocity_strip.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "render/colour_map.h"
#include "render/png.h"
#include "sim/error.h"

namespace billow::render {
namespace {

constexpr std::size_t kPixelBytes = 3;
constexpr std::size_t kBlockBytes = std::size_t{64} << 20;  // bounds the memory of the transposition

[[noreturn]] void fail(const std::filesystem::path& file) {
  throw OutputError(fmt::format("cannot write {}: {}", file.string(), std::strerror(errno)));
}

// A file without a name: it vanishes with the process, however that ends.
int open_spool(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  int descriptor = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (descriptor >= 0 || (errno != EOPNOTSUPP && errno != EISDIR)) return descriptor;
  std::string name = (folder / ".velocity_strip.XXXXXX").string();  // for file systems without O_TMPFILE
  descriptor = mkstemp(name.data());
  if (descriptor >= 0) unlink(name.c_str());
  return descriptor;
}

bool write_all(int descriptor, const std::uint8_t* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t written = write(descriptor, bytes, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

bool read_all(int descriptor, std::uint8_t* bytes, std::size_t size, std::size_t offset) {
  while (size > 0) {
    const ssize_t got = pread(descriptor, bytes, size, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    bytes += got;
    offset += static_cast<std::size_t>(got);
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

}  // namespace

struct VelocityStrip::Impl {
  std::filesystem::path file;
  std::vector<int> order;
  double velocity_range;
  int spool;
  int columns = 0;
  std::vector<std::uint8_t> column;  // the one being added: (rows * 3)
  std::vector<std::uint8_t> block;   // rows first_row ... of all columns: (block_rows * columns * 3)
  int first_row = 0, block_rows = 0;

  int rows() const { return static_cast<int>(order.size()); }
  void load_block(int row);
};

// Transposes the next rows of the spool (columns x rows) into `block`.
void VelocityStrip::Impl::load_block(int row) {
  const std::size_t row_bytes = std::size_t(columns) * kPixelBytes;
  first_row = row;
  block_rows = std::min(rows() - row, static_cast<int>(std::max<std::size_t>(1, kBlockBytes / row_bytes)));
  block.resize(std::size_t(block_rows) * row_bytes);
  column.resize(std::size_t(block_rows) * kPixelBytes);
  for (int c = 0; c < columns; ++c) {
    const std::size_t offset = (std::size_t(c) * rows() + row) * kPixelBytes;
    if (!read_all(spool, column.data(), column.size(), offset)) fail(file);
    for (int r = 0; r < block_rows; ++r)
      std::copy_n(&column[r * kPixelBytes], kPixelBytes, &block[r * row_bytes + c * kPixelBytes]);
  }
}

VelocityStrip::VelocityStrip(const std::filesystem::path& file, std::vector<int> order, double velocity_range)
    : impl_(new Impl{file, std::move(order), velocity_range, open_spool(file), 0, {}, {}}) {
  if (impl_->spool < 0) fail(file);
}

VelocityStrip::~VelocityStrip() { close(impl_->spool); }

void VelocityStrip::add_column(const Eigen::MatrixX3d& velocity) {
  impl_->column.resize(impl_->order.size() * kPixelBytes);
  auto* pixel = impl_->column.data();
  for (const int particle : impl_->order) {
    const Rgb8 colour = velocity_rgb(velocity.row(particle).transpose(), impl_->velocity_range);
    pixel = std::copy(colour.begin(), colour.end(), pixel);
  }
  if (!write_all(impl_->spool, impl_->column.data(), impl_->column.size())) fail(impl_->file);
  ++impl_->columns;
}

int VelocityStrip::columns() const { return impl_->columns; }

void VelocityStrip::finish() {
  Impl& strip = *impl_;
  strip.first_row = strip.block_rows = 0;
  write_png_rows(strip.file, strip.columns, strip.rows(), 3, [&strip](int y, std::uint8_t* row) {
    if (y >= strip.first_row + strip.block_rows) strip.load_block(y);
    const std::size_t row_bytes = std::size_t(strip.columns) * kPixelBytes;
    std::copy_n(&strip.block[(y - strip.first_row) * row_bytes], row_bytes, row);
  });
}

}  // namespace billow::render
