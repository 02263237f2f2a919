// OpenGL objects that are deleted with their owner, and the few ways billow makes them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>

#include "render/gl/gl_context.h"
#include "render/image/image.h"

namespace billow::render {

/// Owns one GL name. Its context must be current when it is destroyed.
class GlObject {
 public:
  using Deleter = void (*)(const Gl& gl, GLuint name);

  GlObject() = default;
  GlObject(const Gl& gl, GLuint name, Deleter deleter) : gl_(&gl), name_(name), deleter_(deleter) {}
  GlObject(GlObject&& other) noexcept { swap(other); }
  GlObject& operator=(GlObject&& other) noexcept {
    swap(other);
    return *this;
  }
  ~GlObject() {
    if (name_) deleter_(*gl_, name_);
  }
  GLuint name() const { return name_; }

 private:
  void swap(GlObject& other) {
    std::swap(gl_, other.gl_);
    std::swap(name_, other.name_);
    std::swap(deleter_, other.deleter_);
  }
  const Gl* gl_ = nullptr;
  GLuint name_ = 0;
  Deleter deleter_ = nullptr;
};

GlObject make_buffer(const Gl& gl);
GlObject make_vertex_array(const Gl& gl);
GlObject make_texture(const Gl& gl);
GlObject make_renderbuffer(const Gl& gl);
GlObject make_framebuffer(const Gl& gl);

/// A mipmapped texture of an sRGB image: sampling it gives linear light. The image's top row is at v = 1. `wrap` is
/// GL_REPEAT or GL_CLAMP_TO_EDGE.
GlObject make_colour_texture(const Gl& gl, const Image& image, GLint wrap);

/// A texture without mipmaps, sampled with `filter`, clamped at its edges.
GlObject make_plain_texture(const Gl& gl, GLint internal_format, int width, int height, GLint filter);

/// Makes `texture` the one that the sampler of this unit reads.
void bind_texture(const Gl& gl, GLenum unit, GLuint texture);

/// A linked vertex and fragment shader. set() needs the program in use, and rounds to single precision.
class Program {
 public:
  /// Throws std::runtime_error with the compiler's log. `name` is for that text.
  Program(const Gl& gl, const std::string& name, const std::string& vertex, const std::string& fragment);

  void use() const { gl_->UseProgram(object_.name()); }
  void set(const char* uniform, int value) const { gl_->Uniform1i(location(uniform), value); }
  void set(const char* uniform, float value) const { gl_->Uniform1f(location(uniform), value); }
  void set(const char* uniform, const Eigen::Vector2f& value) const {
    gl_->Uniform2fv(location(uniform), 1, value.data());
  }
  void set(const char* uniform, const Eigen::Vector3f& value) const {
    gl_->Uniform3fv(location(uniform), 1, value.data());
  }
  void set(const char* uniform, const Eigen::Matrix4f& value) const {
    gl_->UniformMatrix4fv(location(uniform), 1, GL_FALSE, value.data());
  }
  void set(const char* uniform, const Eigen::Vector3d& value) const {
    set(uniform, Eigen::Vector3f(value.cast<float>()));
  }
  void set(const char* uniform, const Eigen::Matrix4d& value) const {
    set(uniform, Eigen::Matrix4f(value.cast<float>()));
  }

 private:
  GLint location(const char* uniform) const { return gl_->GetUniformLocation(object_.name(), uniform); }
  const Gl* gl_;
  GlObject object_;
};

}  // namespace billow::render
