// Choosing a backend, the environment that its drivers read, and the entry points.
#include "render/gl/gl_context.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <vector>

#include "base/out_of_memory.h"
#include "base/temporary_environment.h"

namespace billow::render {
namespace {

// The one that is current on this thread. Drivers of two backends share Mesa's notion of it, so the one lets go before
// the other takes hold.
thread_local NativeContext* current_context = nullptr;

void let_go_of_current() {
  if (current_context) current_context->release();
  current_context = nullptr;
}

bool names_software(std::string_view renderer) {
  return renderer.starts_with("llvmpipe") || renderer.starts_with("softpipe");
}

// llvmpipe uses at most 16.
std::string rasteriser_threads(int threads) {
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return std::to_string(std::clamp(threads > 0 ? threads : cores, 1, 16));
}

// What drivers read when they make a context. Mesa dereferences a null driver when GALLIUM_DRIVER names one it was not
// built with, and lets that and two others lead from software to a GPU; its softpipe rounds otherwise than llvmpipe.
std::vector<TemporaryEnvironment::Change> driver_environment(const Backend& backend, int threads) {
  std::vector<TemporaryEnvironment::Change> changes;
  if (!std::getenv("LP_NUM_THREADS")) changes.emplace_back("LP_NUM_THREADS", rasteriser_threads(threads));
  if (!std::getenv("EGL_LOG_LEVEL")) changes.emplace_back("EGL_LOG_LEVEL", "fatal");  // what fails is said by us
  if (backend.device) return changes;
  const char* driver = std::getenv("GALLIUM_DRIVER");
  if (driver && std::string_view(driver) != "llvmpipe") changes.emplace_back("GALLIUM_DRIVER", std::nullopt);
  changes.emplace_back("MESA_LOADER_DRIVER_OVERRIDE", std::nullopt);
  changes.emplace_back("LIBGL_ALWAYS_SOFTWARE", "true");
  return changes;
}

Gl load_functions(const NativeContext& context) {
  Gl gl;
#define BILLOW_GL_LOAD(type, name)                                \
  gl.name = reinterpret_cast<type>(context.function("gl" #name)); \
  if (!gl.name) throw ResourceError("this OpenGL offers no gl" #name);
  BILLOW_GL_FUNCTIONS(BILLOW_GL_LOAD)
#undef BILLOW_GL_LOAD
  return gl;
}

GlLimits query_limits(const Gl& gl) {
  GlLimits limits;
  GLint renderbuffer = 0, texture = 0, viewport[2] = {};
  gl.GetIntegerv(GL_MAX_SAMPLES, &limits.max_samples);
  gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &renderbuffer);
  gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
  gl.GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
  limits.max_size = std::min({renderbuffer, texture, viewport[0], viewport[1]});
  return limits;
}

const char* gl_text(const Gl& gl, GLenum what) {
  const auto* value = reinterpret_cast<const char*>(gl.GetString(what));
  return value ? value : "unknown";
}

}  // namespace

GlContext::GlContext(const Backend& backend, int threads) {
  if (backend.kind != BackendKind::automatic) {
    open(backend, threads);
    return;
  }
  try {
    open({BackendKind::osmesa, {}}, threads);
  } catch (const ResourceError& without_osmesa) {
    try {
      open({BackendKind::egl, {}}, threads);
    } catch (const ResourceError& without_egl) {
      throw ResourceError(
          fmt::format("nothing here can draw: {}; or else: {}", without_osmesa.what(), without_egl.what()));
    }
  }
}

void GlContext::open(const Backend& backend, int threads) {
  const TemporaryEnvironment environment(driver_environment(backend, threads));
  let_go_of_current();
  native_.reset(backend.kind == BackendKind::osmesa ? make_osmesa_context().release()
                                                    : make_egl_context(backend.device).release());
  backend_ = backend;
  make_current();
  gl_ = load_functions(*native_);
  limits_ = query_limits(gl_);
  if (!backend.device && !is_software())
    throw ResourceError(
        fmt::format("{} would draw with {}, which is no software whose bytes repeat; 'billow doctor' "
                    "lists devices that can be asked for by number",
                    text_of(backend), renderer()));
}

void GlContext::LetGo::operator()(NativeContext* context) const {
  if (current_context == context) let_go_of_current();
  delete context;
}

void GlContext::make_current() {
  if (current_context == native_.get()) return;
  let_go_of_current();
  native_->make_current();
  current_context = native_.get();
}

std::string GlContext::renderer() const { return gl_text(gl_, GL_RENDERER); }

bool GlContext::is_software() const { return names_software(renderer()); }

std::string GlContext::description() const {
  return fmt::format("{}, {}, OpenGL {}", gl_text(gl_, GL_VENDOR), renderer(), gl_text(gl_, GL_VERSION));
}

void check_gl(const Gl& gl, const char* doing) {
  if (const GLenum error = gl.GetError(); error != GL_NO_ERROR)
    throw std::runtime_error(fmt::format("OpenGL error 0x{:04x} while {}", error, doing));
}

}  // namespace billow::render
