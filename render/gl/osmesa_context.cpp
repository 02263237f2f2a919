// OSMesa, whose own header left Debian with it: what billow uses of that is declared here.
#include <GL/glcorearb.h>

#include <array>
#include <cstdint>
#include <stdexcept>

#include "base/out_of_memory.h"
#include "render/gl/native_context.h"
#include "render/gl/shared_library.h"

namespace billow::render {
namespace {

constexpr int osmesa_format = 0x22, osmesa_depth_bits = 0x30, osmesa_profile = 0x33, osmesa_core_profile = 0x34,
              osmesa_major_version = 0x36, osmesa_minor_version = 0x37;

struct OsMesaLibrary {
  SharedLibrary file{"libOSMesa.so.8", "libosmesa6"};
  void* (*create)(const int* attributes, void* shared) = file.function<decltype(create)>("OSMesaCreateContextAttribs");
  void (*destroy)(void* context) = file.function<decltype(destroy)>("OSMesaDestroyContext");
  GLboolean (*make_current)(void* context, void* buffer, GLenum type, GLsizei width,
                            GLsizei height) = file.function<decltype(make_current)>("OSMesaMakeCurrent");
  NativeContext::Function (*function)(const char* name) = file.function<decltype(function)>("OSMesaGetProcAddress");
};

const OsMesaLibrary& osmesa() {
  static const OsMesaLibrary library;
  return library;
}

class OsMesaContext : public NativeContext {
 public:
  OsMesaContext() {
    const int attributes[] = {osmesa_format,
                              GL_RGBA,
                              osmesa_depth_bits,
                              0,
                              osmesa_profile,
                              osmesa_core_profile,
                              osmesa_major_version,
                              3,
                              osmesa_minor_version,
                              3,
                              0};
    context_ = library_.create(attributes, nullptr);
    if (!context_) throw ResourceError("OSMesa offers no OpenGL 3.3 core context");
  }
  ~OsMesaContext() override { library_.destroy(context_); }

  void make_current() override {
    if (!library_.make_current(context_, surface_.data(), GL_UNSIGNED_BYTE, 4, 4))
      throw std::runtime_error("the OSMesa context cannot be made current");
  }
  void release() override { library_.make_current(nullptr, nullptr, 0, 0, 0); }
  Function function(const char* name) const override { return library_.function(name); }

 private:
  const OsMesaLibrary& library_ = osmesa();
  void* context_ = nullptr;
  std::array<std::uint32_t, 16> surface_{};  // the context needs one; everything is drawn into framebuffer objects
};

}  // namespace

std::unique_ptr<NativeContext> make_osmesa_context() { return std::make_unique<OsMesaContext>(); }

}  // namespace billow::render
