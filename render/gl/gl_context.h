// An offscreen OpenGL 3.3 core context. gl_context.cpp is the only file that knows OSMesa.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "render/gl/gl_functions.h"

struct osmesa_context;

namespace billow::render {

/// What this GL can do, asked once.
struct GlLimits {
  int max_samples = 1;  // per pixel of a multisampled renderbuffer
  int max_size = 0;     // [pixel] of a renderbuffer or texture, either way
};

/// A current context as long as nobody else makes another one current; use it from one thread.
class GlContext {
 public:
  /// `threads` rasterise (0: one per core); Mesa reads it once per process, so the first context decides. The caller
  /// can set LP_NUM_THREADS in the environment instead, which wins. Changes the environment: call it before other
  /// threads read that. Throws std::runtime_error when there is no OpenGL 3.3 core.
  explicit GlContext(int threads = 0);
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  void make_current();
  const Gl& gl() const { return gl_; }
  const GlLimits& limits() const { return limits_; }
  /// Vendor, renderer and version in one line.
  std::string description() const;

 private:
  osmesa_context* context_ = nullptr;
  std::array<std::uint32_t, 16> surface_{};  // the context needs one; everything is drawn into framebuffer objects
  Gl gl_;
  GlLimits limits_;
};

/// Throws std::runtime_error naming `doing` when GL has recorded an error since the last call.
void check_gl(const Gl& gl, const char* doing);

}  // namespace billow::render
