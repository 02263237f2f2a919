// OSMesa: the context, its environment and its entry points.
#include "render/gl/gl_context.h"

#include <GL/osmesa.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <string_view>
#include <thread>

namespace billow::render {
namespace {

// Mesa dereferences a null driver when GALLIUM_DRIVER names one it was not built with.
void sanitise_driver() {
  const char* driver = std::getenv("GALLIUM_DRIVER");
  if (driver && std::string_view(driver) != "llvmpipe" && std::string_view(driver) != "softpipe")
    unsetenv("GALLIUM_DRIVER");
}

// llvmpipe reads its thread count when the process makes its first context, and uses at most 16.
void choose_threads(int threads) {
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const int count = std::clamp(threads > 0 ? threads : cores, 1, 16);
  setenv("LP_NUM_THREADS", std::to_string(count).c_str(), /*overwrite=*/0);
}

osmesa_context* create_context() {
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_DEPTH_BITS,
                            0,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            3,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            3,
                            0};
  osmesa_context* context = OSMesaCreateContextAttribs(attributes, nullptr);
  if (!context) throw std::runtime_error("OSMesa offers no OpenGL 3.3 core context");
  return context;
}

Gl load_functions() {
  Gl gl;
#define BILLOW_GL_LOAD(type, name)                                    \
  gl.name = reinterpret_cast<type>(OSMesaGetProcAddress("gl" #name)); \
  if (!gl.name) throw std::runtime_error("OSMesa offers no gl" #name);
  BILLOW_GL_FUNCTIONS(BILLOW_GL_LOAD)
#undef BILLOW_GL_LOAD
  return gl;
}

GlLimits query_limits(const Gl& gl) {
  GlLimits limits;
  GLint renderbuffer = 0, texture = 0;
  gl.GetIntegerv(GL_MAX_SAMPLES, &limits.max_samples);
  gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &renderbuffer);
  gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
  limits.max_size = std::min(renderbuffer, texture);
  return limits;
}

const char* text(const Gl& gl, GLenum what) {
  const auto* value = reinterpret_cast<const char*>(gl.GetString(what));
  return value ? value : "unknown";
}

}  // namespace

GlContext::GlContext(int threads) {
  sanitise_driver();
  choose_threads(threads);
  context_ = create_context();
  try {
    make_current();
    gl_ = load_functions();
    limits_ = query_limits(gl_);
  } catch (...) {
    OSMesaDestroyContext(context_);
    throw;
  }
}

GlContext::~GlContext() { OSMesaDestroyContext(context_); }

void GlContext::make_current() {
  if (!OSMesaMakeCurrent(context_, surface_.data(), GL_UNSIGNED_BYTE, 4, 4))
    throw std::runtime_error("the OSMesa context cannot be made current");
}

std::string GlContext::description() const {
  return fmt::format("{}, {}, OpenGL {}", text(gl_, GL_VENDOR), text(gl_, GL_RENDERER), text(gl_, GL_VERSION));
}

void check_gl(const Gl& gl, const char* doing) {
  if (const GLenum error = gl.GetError(); error != GL_NO_ERROR)
    throw std::runtime_error(fmt::format("OpenGL error 0x{:04x} while {}", error, doing));
}

}  // namespace billow::render
