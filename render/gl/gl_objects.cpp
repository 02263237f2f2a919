// Making and deleting OpenGL objects.
#include "render/gl/gl_objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace billow::render {
namespace {

std::string compile_log(const Gl& gl, GLuint shader) {
  std::vector<char> log(4096, '\0');
  gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
  return log.data();
}

GlObject compile(const Gl& gl, GLenum stage, const std::string& name, const std::string& source) {
  GlObject shader(gl, gl.CreateShader(stage), [](const Gl& g, GLuint n) { g.DeleteShader(n); });
  const char* text = source.c_str();
  gl.ShaderSource(shader.name(), 1, &text, nullptr);
  gl.CompileShader(shader.name());
  GLint done = GL_FALSE;
  gl.GetShaderiv(shader.name(), GL_COMPILE_STATUS, &done);
  if (!done) throw std::runtime_error(fmt::format("shader {}: {}", name, compile_log(gl, shader.name())));
  return shader;
}

void set_wrap(const Gl& gl, GLint wrap) {
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap);
}

void set_filter(const Gl& gl, GLint minify, GLint magnify) {
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, minify);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, magnify);
}

// GL's first row is the bottom one.
std::vector<std::uint8_t> upside_down(const Image& image) {
  std::vector<std::uint8_t> pixels;
  pixels.reserve(image.pixels.size());
  for (int y = image.height - 1; y >= 0; --y)
    pixels.insert(pixels.end(), image.row(y), image.row(y) + std::size_t(image.width) * image.channels);
  return pixels;
}

}  // namespace

GlObject make_buffer(const Gl& gl) {
  GLuint name = 0;
  gl.GenBuffers(1, &name);
  return {gl, name, [](const Gl& g, GLuint n) { g.DeleteBuffers(1, &n); }};
}

GlObject make_vertex_array(const Gl& gl) {
  GLuint name = 0;
  gl.GenVertexArrays(1, &name);
  return {gl, name, [](const Gl& g, GLuint n) { g.DeleteVertexArrays(1, &n); }};
}

GlObject make_texture(const Gl& gl) {
  GLuint name = 0;
  gl.GenTextures(1, &name);
  return {gl, name, [](const Gl& g, GLuint n) { g.DeleteTextures(1, &n); }};
}

GlObject make_renderbuffer(const Gl& gl) {
  GLuint name = 0;
  gl.GenRenderbuffers(1, &name);
  return {gl, name, [](const Gl& g, GLuint n) { g.DeleteRenderbuffers(1, &n); }};
}

GlObject make_framebuffer(const Gl& gl) {
  GLuint name = 0;
  gl.GenFramebuffers(1, &name);
  return {gl, name, [](const Gl& g, GLuint n) { g.DeleteFramebuffers(1, &n); }};
}

GlObject make_colour_texture(const Gl& gl, const Image& image, GLint wrap) {
  GlObject texture = make_texture(gl);
  gl.BindTexture(GL_TEXTURE_2D, texture.name());
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, image.width, image.height, 0, image.channels == 4 ? GL_RGBA : GL_RGB,
                GL_UNSIGNED_BYTE, upside_down(image).data());
  gl.GenerateMipmap(GL_TEXTURE_2D);
  set_wrap(gl, wrap);
  set_filter(gl, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR);
  return texture;
}

GlObject make_plain_texture(const Gl& gl, GLint internal_format, int width, int height, GLint filter) {
  const bool depth = internal_format == GL_DEPTH_COMPONENT24 || internal_format == GL_DEPTH_COMPONENT32F;
  GlObject texture = make_texture(gl);
  gl.BindTexture(GL_TEXTURE_2D, texture.name());
  gl.TexImage2D(GL_TEXTURE_2D, 0, internal_format, width, height, 0, depth ? GL_DEPTH_COMPONENT : GL_RGBA,
                depth ? GL_FLOAT : GL_UNSIGNED_BYTE, nullptr);
  set_wrap(gl, GL_CLAMP_TO_EDGE);
  set_filter(gl, filter, filter);
  return texture;
}

// Unit 0 stays the active one: everything else binds there.
void bind_texture(const Gl& gl, GLenum unit, GLuint texture) {
  gl.ActiveTexture(GL_TEXTURE0 + unit);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.ActiveTexture(GL_TEXTURE0);
}

Program::Program(const Gl& gl, const std::string& name, const std::string& vertex, const std::string& fragment)
    : gl_(&gl), object_(gl, gl.CreateProgram(), [](const Gl& g, GLuint n) { g.DeleteProgram(n); }) {
  const GlObject vertex_shader = compile(gl, GL_VERTEX_SHADER, name + " (vertex)", vertex);
  const GlObject fragment_shader = compile(gl, GL_FRAGMENT_SHADER, name + " (fragment)", fragment);
  gl.AttachShader(object_.name(), vertex_shader.name());
  gl.AttachShader(object_.name(), fragment_shader.name());
  gl.LinkProgram(object_.name());
  GLint done = GL_FALSE;
  gl.GetProgramiv(object_.name(), GL_LINK_STATUS, &done);
  if (!done) throw std::runtime_error("shader program " + name + " does not link");
}

}  // namespace billow::render
