// A row's buffers are what OpenEXR writes every row into.
#include "render/image/exr_rows.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <ImfTileDescription.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <deque>
#include <new>
#include <set>
#include <string_view>

#include "base/error.h"
#include "render/image/exr_header.h"

namespace billow::render {
namespace {

namespace fs = std::filesystem;

constexpr int most_pixels = 8192;  // either way: a hostile header must not claim all memory
constexpr std::size_t most_channels = 256;
constexpr std::uint64_t most_at_once = std::uint64_t{1} << 30;  // [byte] of the rows that are packed together

[[noreturn]] void refuse_exr(const fs::path& file, const std::string& reason) {
  throw InputError(fmt::format("{}: {}", file.string(), reason));
}

// Opening alone would wait for a pipe.
void check_readable(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) refuse_exr(file, fmt::format("cannot open the image: {}", std::strerror(ENOENT)));
  if (fs::is_directory(status)) refuse_exr(file, "is a folder, not an OpenEXR image");
  if (!fs::is_regular_file(status))
    refuse_exr(file, "is not a regular file, so it is not read as an image; save it as one");
  if (fs::file_size(file, error) == 0) refuse_exr(file, "the image is empty");
}

// How many pixels OpenEXR makes room for at a time.
std::uint64_t pixels_at_once(const Imf::Header& header, std::uint64_t width) {
  if (!header.hasTileDescription()) return width * (header.compression() == Imf::DWAB_COMPRESSION ? 256 : 32);
  const Imf::TileDescription& tiles = header.tileDescription();
  return std::max<std::uint64_t>(width, tiles.xSize) * tiles.ySize;
}

std::size_t count_of(const Imf::ChannelList& channels) {
  std::size_t count = 0;
  for (auto channel = channels.begin(); channel != channels.end(); ++channel) ++count;
  return count;
}

// Before anything is made of what a header claims.
void check_part(const fs::path& file, const Imf::Header& header) {
  if (header.hasType() && Imf::isDeepData(header.type()))
    refuse_exr(file,
               "the OpenEXR image is deep, with lists of samples in its pixels; flatten it, as with oiiotool "
               "--flatten");
  const Imath::Box2i& window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1,
                     height = std::int64_t{window.max.y} - window.min.y + 1;
  if (width < 1 || height < 1 || width > most_pixels || height > most_pixels)
    refuse_exr(file, fmt::format("the image has {} x {} pixels; at most {} x {} are read", width, height, most_pixels,
                                 most_pixels));
  const std::size_t channels = count_of(header.channels());
  if (channels > most_channels)
    refuse_exr(file, fmt::format("the OpenEXR image has {} channels; at most {} are read", channels, most_channels));
  if (pixels_at_once(header, static_cast<std::uint64_t>(width)) >
      most_at_once / sizeof(float) / std::max<std::size_t>(channels, 1))
    refuse_exr(file, "the OpenEXR image packs more than a GiB together; write it in smaller tiles");
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
    if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1)
      refuse_exr(file, fmt::format("the channel {} has not a value for every pixel, as luminance and chroma have; "
                                   "convert the image to RGB",
                                   channel.name()));
}

// The layers whose numbers are hashes of names: the values of attributes "cryptomatte/KEY/name".
std::set<std::string> cryptomattes(const Imf::Header& header) {
  std::set<std::string> layers;
  for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
    const std::string_view name = attribute.name();
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
    if (text && name.starts_with("cryptomatte/") && name.ends_with("/name")) layers.insert(text->value());
  }
  return layers;
}

// LAYER00.R, LAYER00.B, LAYER01.R and so on; .G and .A are shares of the pixel.
bool is_identity(std::string_view channel, const std::set<std::string>& layers) {
  for (const std::string& layer : layers) {
    if (!channel.starts_with(layer)) continue;
    const std::string_view rest = channel.substr(layer.size());
    if (rest.size() >= 4 && std::isdigit(static_cast<unsigned char>(rest[0])) &&
        std::isdigit(static_cast<unsigned char>(rest[1])) && rest[2] == '.' &&
        std::string_view("RrBb").find(rest[3]) != std::string_view::npos)
      return true;
  }
  return false;
}

}  // namespace

struct ExrRows::File {
  explicit File(const fs::path& file) : path(file), input(file.c_str(), 0, false) {
    for (int k = 0; k < input.parts(); ++k) {
      check_part(path, input.header(k));
      if (input.header(k).dataWindow() != input.header(0).dataWindow())
        refuse_exr(path, "the parts of the OpenEXR image lie at different places; save one of them alone");
      if (!input.partComplete(k)) refuse_exr(path, "the OpenEXR image is cut short");
    }
    const Imath::Box2i& window = input.header(0).dataWindow();
    shape = {window.max.x - window.min.x + 1,
             window.max.y - window.min.y + 1,
             window.min.x,
             window.min.y,
             Depth::floats,
             {}};
    for (int k = 0; k < input.parts(); ++k) add_part(k);
    if (shape.channels.empty()) refuse_exr(path, "the OpenEXR image has no channels");
    if (shape.channels.size() > most_channels)
      refuse_exr(path, fmt::format("the OpenEXR image has {} channels; at most {} are read", shape.channels.size(),
                                   most_channels));
  }

  void add_part(int number) {
    const Imf::Header& header = input.header(number);
    const std::set<std::string> layers = cryptomattes(header);
    Imf::FrameBuffer buffer;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
      const bool whole = channel.channel().type == Imf::UINT;
      // 0 from row to row: each is written over the one before.
      const std::ptrdiff_t before = std::ptrdiff_t{shape.left} * 4;
      char* const base = whole ? reinterpret_cast<char*>(wholes.emplace_back(shape.width).data())
                               : reinterpret_cast<char*>(floats.emplace_back(shape.width).data());
      buffer.insert(channel.name(), Imf::Slice(whole ? Imf::UINT : Imf::FLOAT, base - before, 4, 0));
      is_whole.push_back(whole);
      shape.channels.push_back({free_name(channel.name(), header), whole ? Meaning::number
                                                                   : is_identity(channel.name(), layers)
                                                                       ? Meaning::hash
                                                                       : Meaning::quantity});
    }
    parts.emplace_back(input, number).setFrameBuffer(buffer);
  }

  std::string free_name(const std::string& name, const Imf::Header& header) const {
    const bool taken = std::any_of(shape.channels.begin(), shape.channels.end(),
                                   [&](const RowChannel& channel) { return channel.name == name; });
    return taken && header.hasName() ? header.name() + "." + name : name;
  }

  void read(ValueRow& row) {
    for (Imf::InputPart& part : parts) part.readPixels(shape.top + next);
    ++next;
    std::size_t whole = 0, real = 0;
    for (std::size_t c = 0; c < is_whole.size(); ++c) {
      auto values = row.col(static_cast<Eigen::Index>(c));
      if (is_whole[c])
        std::copy(wholes[whole].begin(), wholes[whole].end(), values.begin()), ++whole;
      else
        std::copy(floats[real].begin(), floats[real].end(), values.begin()), ++real;
    }
  }

  fs::path path;
  Imf::MultiPartInputFile input;
  RowShape shape;
  std::vector<bool> is_whole;
  std::deque<std::vector<float>> floats;
  std::deque<std::vector<std::uint32_t>> wholes;
  std::deque<Imf::InputPart> parts;
  int next = 0;
};

// What OpenEXR says of a file names it again, and a fault of its own would be none of the file's.
ExrRows::ExrRows(const fs::path& file) {
  check_readable(file);
  if (const auto fault = exr_header_fault(file)) refuse_exr(file, *fault);
  try {
    file_ = std::make_unique<File>(file);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception&) {
    refuse_exr(file, "is damaged, or no OpenEXR image");
  }
}

ExrRows::~ExrRows() = default;

const RowShape& ExrRows::shape() const { return file_->shape; }

void ExrRows::read(ValueRow& row) {
  const int y = file_->next;
  try {
    file_->read(row);
  } catch (const std::exception&) {
    refuse_exr(file_->path, fmt::format("the OpenEXR image is damaged in its row {}", y));
  }
}

}  // namespace billow::render
