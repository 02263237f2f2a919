// OpenEXR, through memory: its writer goes back to fill in a table, and only a finished file may appear.
#include "render/image/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "base/atomic_file.h"
#include "base/error.h"

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

}  // namespace billow::render
