// The multisampled framebuffer, its resolve and its read-back.
#include "render/frame_target.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "sim/error.h"

namespace billow::render {
namespace {

constexpr int kMaxMultisamples = 4;

GlObject make_storage(const Gl& gl, GLenum format, int samples, int width, int height) {
  GlObject buffer = make_renderbuffer(gl);
  gl.BindRenderbuffer(GL_RENDERBUFFER, buffer.name());
  gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0, format, width, height);
  return buffer;
}

GlObject make_target(const Gl& gl, const GlObject& colour, const GlObject* depth) {
  GlObject framebuffer = make_framebuffer(gl);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour.name());
  if (depth) gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth->name());
  if (const GLenum status = gl.CheckFramebufferStatus(GL_FRAMEBUFFER); status != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error(fmt::format("the framebuffer is incomplete (0x{:04x})", status));
  return framebuffer;
}

void require_size(const GlLimits& limits, int width, int height, int scale) {
  if (width < 1 || height < 1 || width * scale > limits.max_size || height * scale > limits.max_size)
    throw InputError(fmt::format("render.size {} x {} cannot be drawn: with these samples at most {} pixels each way",
                                 width, height, limits.max_size / scale));
}

}  // namespace

FrameTarget::FrameTarget(const Gl& gl, const GlLimits& limits, int width, int height, int samples)
    : gl_(&gl), width_(width), height_(height), scale_(samples > kMaxMultisamples ? 2 : 1) {
  require_size(limits, width, height, scale_);
  const int multisamples = std::min(samples / (scale_ * scale_), limits.max_samples);
  const int w = drawn_width(), h = drawn_height();
  sampled_colour_ = make_storage(gl, GL_SRGB8_ALPHA8, multisamples, w, h);
  sampled_depth_ = make_storage(gl, GL_DEPTH_COMPONENT24, multisamples, w, h);
  sampled_ = make_target(gl, sampled_colour_, &sampled_depth_);
  resolved_colour_ = make_storage(gl, GL_SRGB8_ALPHA8, 1, w, h);
  resolved_ = make_target(gl, resolved_colour_, nullptr);
  if (scale_ > 1) {
    reduced_colour_ = make_storage(gl, GL_SRGB8_ALPHA8, 1, width, height);
    reduced_ = make_target(gl, reduced_colour_, nullptr);
  }
  rgba_.resize(std::size_t(width) * height * 4);
}

void FrameTarget::bind() const {
  gl_->BindFramebuffer(GL_FRAMEBUFFER, sampled_.name());
  gl_->Viewport(0, 0, drawn_width(), drawn_height());
}

void FrameTarget::blit(const GlObject& from, const GlObject& to, int to_width, int to_height, GLenum filter) const {
  gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, from.name());
  gl_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, to.name());
  gl_->BlitFramebuffer(0, 0, drawn_width(), drawn_height(), 0, 0, to_width, to_height, GL_COLOR_BUFFER_BIT, filter);
}

Image FrameTarget::read() {
  blit(sampled_, resolved_, drawn_width(), drawn_height(), GL_NEAREST);
  // Half the size with bilinear filtering samples the middle of each 2 x 2 block: its mean.
  if (scale_ > 1) blit(resolved_, reduced_, width_, height_, GL_LINEAR);
  gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, scale_ > 1 ? reduced_.name() : resolved_.name());
  gl_->ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba_.data());
  Image image(width_, height_, 3);
  for (int y = 0; y < height_; ++y) {
    const std::uint8_t* from = rgba_.data() + std::size_t(height_ - 1 - y) * width_ * 4;  // GL counts rows upwards
    std::uint8_t* to = image.row(y);
    for (int x = 0; x < width_; ++x, from += 4, to += 3) std::copy_n(from, 3, to);
  }
  return image;
}

}  // namespace billow::render
