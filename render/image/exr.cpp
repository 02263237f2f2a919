// OpenEXR, through memory: its writer goes back to fill in a table, and only a finished file may appear.
#include "render/image/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/parallel.h"
#include "render/image/exr_header.h"

namespace billow::render {
namespace {

class MemoryStream : public Imf::OStream {
 public:
  MemoryStream() : Imf::OStream("memory") {}
  void write(const char bytes[], int size) override {
    const std::size_t end = place_ + static_cast<std::size_t>(size);
    if (end > bytes_.size()) bytes_.resize(end);
    std::copy_n(bytes, size, bytes_.begin() + static_cast<std::ptrdiff_t>(place_));
    place_ = end;
  }
  std::uint64_t tellp() override { return place_; }
  void seekp(std::uint64_t place) override { place_ = place; }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  std::size_t place_ = 0;
};

// ZIP takes 16 rows together; neither dates nor the machine's name go in.
Imf::Header header_of(const DataImage& image) {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const DataImage::Channel& channel : image.channels)
    header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
  for (const auto& [name, text] : image.notes) header.insert(name, Imf::StringAttribute(text));
  return header;
}

// OpenEXR reads through pointers that are not const.
Imf::FrameBuffer buffer_of(const DataImage& image) {
  Imf::FrameBuffer buffer;
  for (const DataImage::Channel& channel : image.channels) {
    char* values = reinterpret_cast<char*>(const_cast<float*>(channel.value.data()));
    buffer.insert(channel.name, Imf::Slice(Imf::FLOAT, values, sizeof(float), sizeof(float) * image.width));
  }
  return buffer;
}

// Rows that ZIP takes together.
constexpr int block_rows = 16;

// The blocks of rows as the file holds them.
std::vector<std::string> packed_blocks(Imf::InputFile& input, int height) {
  std::vector<std::string> blocks;
  for (int row = 0; row < height; row += block_rows) {
    const char* bytes = nullptr;
    int size = 0;
    input.rawPixelData(row + input.header().dataWindow().min.y, bytes, size);
    blocks.emplace_back(bytes, static_cast<std::size_t>(size));
  }
  return blocks;
}

// Whether a block unpacks to `size` bytes; zlib compares its checksum.
bool unpacks(const std::string& block, std::size_t size) {
  if (block.size() == size) return true;  // it did not get smaller, so it was not packed
  std::vector<unsigned char> unpacked(size);
  uLongf length = size;
  const auto* bytes = reinterpret_cast<const unsigned char*>(block.data());
  return uncompress(unpacked.data(), &length, bytes, block.size()) == Z_OK && length == size;
}

std::size_t pixel_bytes(const Imf::ChannelList& channels) {
  std::size_t bytes = 0;
  for (auto channel = channels.begin(); channel != channels.end(); ++channel) bytes += sizeof(float);
  return bytes;
}

// On all threads: unpacking takes a quarter of a second where there are many channels.
bool all_unpack(const std::vector<std::string>& blocks, int height, std::size_t row_bytes) {
  std::atomic<bool> whole = true;
  run_isolated(static_cast<int>(blocks.size()), [&](int k) {
    const int rows = std::min(block_rows, height - k * block_rows);
    if (!unpacks(blocks[k], static_cast<std::size_t>(rows) * row_bytes)) whole = false;
  });
  return whole;
}

std::optional<std::string> fault_of(Imf::InputFile& input, int width, int height) {
  const Imf::Header& header = input.header();
  const Imath::V2i size = header.dataWindow().size() + Imath::V2i(1, 1);
  if (size != Imath::V2i(width, height))
    return fmt::format("has {} x {} pixels instead of {} x {}", size.x, size.y, width, height);
  if (header.compression() != Imf::ZIP_COMPRESSION) return "is packed otherwise than billow packs it";
  if (!input.isComplete()) return "is cut short";
  const std::size_t row_bytes = static_cast<std::size_t>(width) * pixel_bytes(header.channels());
  if (!all_unpack(packed_blocks(input, height), height, row_bytes)) return "is damaged: a checksum is wrong";
  return std::nullopt;
}

}  // namespace

void write_exr(const std::filesystem::path& file, const DataImage& image) {
  MemoryStream stream;
  try {
    Imf::OutputFile output(stream, header_of(image), 0);
    output.setFrameBuffer(buffer_of(image));
    output.writePixels(image.height);
  } catch (const std::exception& error) {
    throw OutputError(fmt::format("cannot write {}: {}", file.string(), error.what()));
  }
  write_file_atomically(file, stream.bytes());
}

std::optional<std::string> exr_fault(const std::filesystem::path& file, int width, int height) {
  try {
    if (auto fault = exr_header_fault(file)) return fault;
    Imf::InputFile input(file.c_str(), 0);
    return fault_of(input, width, height);
  } catch (const std::exception&) {  // its text names the file again
    return "is damaged, or no OpenEXR image";
  }
}

}  // namespace billow::render
