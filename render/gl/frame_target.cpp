// The framebuffers of a frame, their resolve and their read-back.
#include "render/gl/frame_target.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/error.h"
#include "base/srgb.h"

namespace billow::render {
namespace {

constexpr int max_multisamples = 4;

GlObject make_storage(const Gl& gl, GLenum format, int samples, int width, int height) {
  GlObject buffer = make_renderbuffer(gl);
  gl.BindRenderbuffer(GL_RENDERBUFFER, buffer.name());
  gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0, format, width, height);
  return buffer;
}

GlObject make_picture(const Gl& gl, int width, int height) {
  return make_plain_texture(gl, GL_SRGB8_ALPHA8, width, height, GL_NEAREST);
}

void require_complete(const Gl& gl) {
  if (const GLenum status = gl.CheckFramebufferStatus(GL_FRAMEBUFFER); status != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error(fmt::format("the framebuffer is incomplete (0x{:04x})", status));
}

GlObject make_target(const Gl& gl, const GlObject& texture) {
  GlObject framebuffer = make_framebuffer(gl);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.name(), 0);
  require_complete(gl);
  return framebuffer;
}

GlObject make_sampled_target(const Gl& gl, const GlObject& colour, const GlObject& depth) {
  GlObject framebuffer = make_framebuffer(gl);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour.name());
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth.name());
  require_complete(gl);
  return framebuffer;
}

void require_size(const GlLimits& limits, int width, int height, int scale) {
  if (width < 1 || height < 1 || width > limits.max_size / scale || height > limits.max_size / scale)
    throw InputError(fmt::format("render.size {} x {} cannot be drawn: with these samples at most {} pixels each way",
                                 width, height, limits.max_size / scale));
}

void put_rgb(const std::uint8_t* rgba, int width, std::uint8_t* to) {
  for (int x = 0; x < width; ++x)
    for (int c = 0; c < 3; ++c) to[3 * x + c] = rgba[4 * x + c];
}

// Samples that nothing covers are black: what GL averaged is the colour times its alpha, in linear light.
void put_straight_rgba(const std::uint8_t* rgba, int width, std::uint8_t* to) {
  for (int x = 0; x < width; ++x, rgba += 4, to += 4) {
    to[3] = rgba[3];
    if (rgba[3] == 255) std::copy_n(rgba, 3, to);
    if (rgba[3] == 0 || rgba[3] == 255) continue;
    for (int c = 0; c < 3; ++c) {
      const double linear = std::min(1.0, srgb_to_linear(rgba[c] / 255.0) * 255.0 / rgba[3]);
      to[c] = static_cast<std::uint8_t>(std::lround(255.0 * linear_to_srgb(linear)));
    }
  }
}

// Tiles of whole pixels of the picture: with a scale of 2 they are even, as all of them but the last ones are.
std::vector<PixelBox> tiles_of(int width, int height, const TileLimits& most) {
  const int columns = (width + most.side - 1) / most.side;
  const int rows_at_once = most.pixels / ((width + columns - 1) / columns) / 2 * 2;
  return split_evenly(width, height, most.side, std::clamp(rows_at_once, 2, most.side));
}

}  // namespace

FrameTarget::FrameTarget(const Gl& gl, const GlLimits& limits, int width, int height, int samples,
                         const TileLimits& tiles)
    : gl_(&gl), width_(width), height_(height), scale_(samples > max_multisamples ? 2 : 1) {
  require_size(limits, width, height, scale_);
  tiles_ = tiles_of(drawn_width(), drawn_height(), tiles);
  tile_ = tiles_.front();  // none is larger
  const int multisamples = std::min(samples / (scale_ * scale_), limits.max_samples);
  const int w = tile_.width(), h = tile_.height();
  plain_colour_ = make_picture(gl, w, h);
  plain_ = make_target(gl, plain_colour_);
  backdrop_colour_ = make_picture(gl, w, h);
  backdrop_ = make_target(gl, backdrop_colour_);
  reduced_colour_ = make_picture(gl, w / scale_, h / scale_);
  reduced_ = make_target(gl, reduced_colour_);
  sampled_colour_ = make_storage(gl, GL_SRGB8_ALPHA8, multisamples, w, h);
  sampled_depth_ = make_storage(gl, GL_DEPTH_COMPONENT24, multisamples, w, h);
  sampled_ = make_sampled_target(gl, sampled_colour_, sampled_depth_);
  rgba_.resize(std::size_t(w / scale_) * static_cast<std::size_t>(h / scale_) * 4);
}

// The whole picture, moved so that the tile is what the framebuffer holds of it.
void FrameTarget::set_viewport() const { gl_->Viewport(-tile_.left, -tile_.bottom, drawn_width(), drawn_height()); }

void FrameTarget::bind_plain() const {
  gl_->BindFramebuffer(GL_FRAMEBUFFER, plain_.name());
  set_viewport();
  gl_->Disable(GL_SCISSOR_TEST);
  gl_->Disable(GL_DEPTH_TEST);
}

void FrameTarget::copy(const GlObject& from, const GlObject& to) const {
  gl_->Disable(GL_SCISSOR_TEST);
  gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, from.name());
  gl_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, to.name());
  const int w = tile_.width(), h = tile_.height();
  gl_->BlitFramebuffer(0, 0, w, h, 0, 0, w, h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void FrameTarget::bind_sampled(const PixelBox& box) const {
  gl_->BindFramebuffer(GL_FRAMEBUFFER, sampled_.name());
  set_viewport();
  gl_->Enable(GL_SCISSOR_TEST);
  gl_->Scissor(box.left - tile_.left, box.bottom - tile_.bottom, box.width(), box.height());
  gl_->Enable(GL_DEPTH_TEST);
  gl_->Clear(GL_DEPTH_BUFFER_BIT);
}

void FrameTarget::resolve(const PixelBox& box) const {
  gl_->Disable(GL_SCISSOR_TEST);
  gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, sampled_.name());
  gl_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, plain_.name());
  const int left = box.left - tile_.left, bottom = box.bottom - tile_.bottom;
  const int right = box.right - tile_.left, top = box.top - tile_.bottom;
  gl_->BlitFramebuffer(left, bottom, right, top, left, bottom, right, top, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void FrameTarget::read_into(Image& picture) {
  const int width = tile_.width() / scale_, height = tile_.height() / scale_;
  if (scale_ > 1) {
    // Half the size with bilinear filtering samples the middle of each 2 x 2 block: its mean.
    gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, plain_.name());
    gl_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, reduced_.name());
    gl_->BlitFramebuffer(0, 0, tile_.width(), tile_.height(), 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_LINEAR);
  }
  gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, scale_ > 1 ? reduced_.name() : plain_.name());
  gl_->ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba_.data());
  const auto put = picture.channels == 4 ? put_straight_rgba : put_rgb;
  for (int y = 0; y < height; ++y) {  // GL counts rows upwards
    std::uint8_t* row = picture.row(height_ - 1 - tile_.bottom / scale_ - y);
    put(rgba_.data() + std::size_t(y) * width * 4, width, row + std::size_t(tile_.left / scale_) * picture.channels);
  }
}

}  // namespace billow::render
