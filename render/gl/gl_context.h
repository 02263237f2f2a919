// An offscreen OpenGL 3.3 core context of whichever backend.
#pragma once

#include <memory>
#include <string>

#include "render/gl/backend.h"
#include "render/gl/gl_functions.h"
#include "render/gl/native_context.h"

namespace billow::render {

/// What this GL can do, asked once.
struct GlLimits {
  int max_samples = 1;  // per pixel of a multisampled renderbuffer
  int max_size = 0;     // [pixel] of a renderbuffer, texture or viewport, either way
};

/// A current context as long as nobody else makes another one current; use it from one thread.
class GlContext {
 public:
  /// `threads` rasterise where software does (0: one per core); Mesa reads it once per process and backend, so the
  /// first context decides. The caller can set LP_NUM_THREADS in the environment instead, which wins. Throws
  /// ResourceError where the backend is missing or has no OpenGL 3.3 core, and says what to install.
  explicit GlContext(const Backend& backend, int threads = 0);

  void make_current();
  const Gl& gl() const { return gl_; }
  const GlLimits& limits() const { return limits_; }
  /// The one that was taken: never automatic.
  const Backend& backend() const { return backend_; }
  /// What draws, as GL calls it: "llvmpipe (LLVM 15.0.6, 256 bits)".
  std::string renderer() const;
  /// Whether that is a program, not a GPU.
  bool is_software() const;
  /// Vendor, renderer and version in one line.
  std::string description() const;
  /// The driver's own name, where it has one besides what GL says.
  std::string driver() const { return native_->driver(); }

 private:
  struct LetGo {  // before it is destroyed
    void operator()(NativeContext* context) const;
  };
  void open(const Backend& backend, int threads);

  std::unique_ptr<NativeContext, LetGo> native_;
  Backend backend_;
  Gl gl_;
  GlLimits limits_;
};

/// Throws std::runtime_error naming `doing` when GL has recorded an error since the last call.
void check_gl(const Gl& gl, const char* doing);

}  // namespace billow::render
