// What a backend gives: an OpenGL 3.3 core context without a window.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace billow::render {

/// One context of a backend. It is not current any more when it is destroyed.
class NativeContext {
 public:
  using Function = void (*)();

  virtual ~NativeContext() = default;
  /// On the thread that calls. Throws std::runtime_error.
  virtual void make_current() = 0;
  virtual void release() = 0;
  /// An entry point of GL, null where there is none; the context is current.
  virtual Function function(const char* name) const = 0;
  /// The driver's own name, where it has one besides what GL says.
  virtual std::string driver() const { return ""; }
};

/// Throws ResourceError where libOSMesa is missing, or has no such context.
std::unique_ptr<NativeContext> make_osmesa_context();

/// Of the device of that number; without one, of EGL's software. Throws ResourceError where EGL or the device is
/// missing, listing those that are there, or makes no such context.
std::unique_ptr<NativeContext> make_egl_context(std::optional<int> device);

/// How many devices EGL lists. Throws ResourceError where EGL is missing.
int egl_devices();

}  // namespace billow::render
