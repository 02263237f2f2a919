// Each kind of picture to its own writer.
#include "render/image/picture.h"

#include "render/image/exr.h"
#include "render/image/png.h"
#include "render/image/png_fault.h"

namespace billow::render {
namespace {

struct Writer {
  const std::filesystem::path& file;
  void operator()(const Image& image) const { write_png(file, image); }
  void operator()(const Image16& image) const { write_png(file, image); }
  void operator()(const DataImage& image) const { write_exr(file, image); }
};

}  // namespace

void write_picture(const std::filesystem::path& file, const Picture& picture) { std::visit(Writer{file}, picture); }

std::optional<std::string> picture_fault(const std::filesystem::path& file, int width, int height) {
  return file.extension() == ".exr" ? exr_fault(file, width, height) : png_fault(file, width, height);
}

}  // namespace billow::render
