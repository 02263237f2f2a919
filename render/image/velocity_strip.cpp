// Columns are gathered in tiles, the tiles spooled row by row, and the rows put together, block by block, at the end.
#include "render/image/velocity_strip.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/spool.h"
#include "render/image/colour_map.h"
#include "render/image/png.h"

namespace billow::render {
namespace {

constexpr std::size_t strip_pixel_bytes = 3;
constexpr int tile_columns = 16;  // one row of a tile is what a read of the spool finds side by side
constexpr std::size_t tile_row_bytes = tile_columns * strip_pixel_bytes;
constexpr std::size_t block_bytes = std::size_t{256} << 10;  // bounds the memory of putting rows together

}  // namespace

struct VelocityStrip::Impl {
  std::filesystem::path file;
  std::vector<int> order;
  double velocity_range;
  Spool spool;  // the full tiles
  int columns = 0;
  std::vector<std::uint8_t> tile = std::vector<std::uint8_t>(order.size() * tile_row_bytes);  // the one being filled
  std::vector<std::uint8_t> block = {};  // rows first_row ... of all columns: (block_rows * columns * 3)
  int first_row = 0, block_rows = 0;

  int rows() const { return static_cast<int>(order.size()); }
  std::size_t row_bytes() const { return std::size_t(columns) * strip_pixel_bytes; }
  void load_block(int row);
  void load_tile(int tile_number, std::vector<std::uint8_t>& tile_rows);
};

// Puts the next rows of all tiles side by side.
void VelocityStrip::Impl::load_block(int row) {
  first_row = row;
  block_rows = std::min(rows() - row, static_cast<int>(std::max<std::size_t>(1, block_bytes / row_bytes())));
  block.resize(std::size_t(block_rows) * row_bytes());
  std::vector<std::uint8_t> tile_rows(std::size_t(block_rows) * tile_row_bytes);
  for (int t = 0; t * tile_columns < columns; ++t) load_tile(t, tile_rows);
}

// The last tile is still in memory unless it is full.
void VelocityStrip::Impl::load_tile(int number, std::vector<std::uint8_t>& tile_rows) {
  const int first_column = number * tile_columns;
  const std::size_t bytes = std::size_t(std::min(tile_columns, columns - first_column)) * strip_pixel_bytes;
  if (bytes < tile_row_bytes)
    std::copy_n(&tile[first_row * tile_row_bytes], tile_rows.size(), tile_rows.data());
  else
    spool.read(tile_rows.data(), tile_rows.size(), (std::size_t(number) * rows() + first_row) * tile_row_bytes);
  for (int r = 0; r < block_rows; ++r)
    std::copy_n(&tile_rows[r * tile_row_bytes], bytes, &block[r * row_bytes() + first_column * strip_pixel_bytes]);
}

VelocityStrip::VelocityStrip(const std::filesystem::path& file, std::vector<int> order, double velocity_range)
    : impl_(new Impl{file, std::move(order), velocity_range, Spool(file)}) {}

VelocityStrip::~VelocityStrip() = default;

void VelocityStrip::add_column(const Eigen::MatrixX3d& velocity) {
  const int place = impl_->columns % tile_columns;
  auto* pixel = impl_->tile.data() + place * strip_pixel_bytes;
  for (const int particle : impl_->order) {
    const Rgb8 colour = velocity_rgb(velocity.row(particle).transpose(), impl_->velocity_range);
    std::copy(colour.begin(), colour.end(), pixel);
    pixel += tile_row_bytes;
  }
  if (place == tile_columns - 1) impl_->spool.append(impl_->tile.data(), impl_->tile.size());
  ++impl_->columns;
}

int VelocityStrip::columns() const { return impl_->columns; }

void VelocityStrip::finish() {
  Impl& strip = *impl_;
  strip.first_row = strip.block_rows = 0;
  write_png_rows(strip.file, strip.columns, strip.rows(), 3, [&strip](int y, std::uint8_t* row) {
    if (y >= strip.first_row + strip.block_rows) strip.load_block(y);
    std::copy_n(&strip.block[(y - strip.first_row) * strip.row_bytes()], strip.row_bytes(), row);
  });
}

}  // namespace billow::render
