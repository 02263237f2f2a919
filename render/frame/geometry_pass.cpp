// Which triangle a sample sees, from GL; where on it, from the sample's ray.
#include "render/frame/geometry_pass.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "render/frame/camera.h"
#include "render/frame/shaders.h"
#include "render/image/camera_motion.h"

namespace billow::render {
namespace {

constexpr int band_samples = 1 << 20;  // drawn and read at a time: what is held does not grow with the picture

int grid_of(int samples) { return samples <= 1 ? 1 : samples <= 4 ? 2 : 4; }

std::vector<PixelBox> panes_of(const FrameParts& frame, int grid) {
  const int side = std::min(frame.tile_limits.data_viewport, frame.context.limits().max_size) / grid;
  return split_evenly(frame.settings.width, frame.settings.height, side, side);
}

int rows_at_once(const PixelBox& pane, int grid) {
  return std::clamp(band_samples / (pane.width() * grid * grid), 1, pane.height());
}

// What fills the pane of a picture fills the whole of it afterwards: clip space, before the division.
Eigen::Matrix4d crop(const PixelBox& pane, int width, int height) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix(0, 0) = double(width) / pane.width();
  matrix(1, 1) = double(height) / pane.height();
  matrix(0, 3) = double(width - pane.left - pane.right) / pane.width();
  matrix(1, 3) = double(height - pane.bottom - pane.top) / pane.height();
  return matrix;
}

GlObject make_storage(const Gl& gl, GLenum format, int width, int height) {
  GlObject buffer = make_renderbuffer(gl);
  gl.BindRenderbuffer(GL_RENDERBUFFER, buffer.name());
  gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, 0, format, width, height);
  return buffer;
}

GlObject make_target(const Gl& gl, const GlObject& hit, const GlObject& albedo, const GlObject& depth) {
  GlObject target = make_framebuffer(gl);
  gl.BindFramebuffer(GL_FRAMEBUFFER, target.name());
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, hit.name());
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_RENDERBUFFER, albedo.name());
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth.name());
  const GLenum attachments[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  gl.DrawBuffers(2, attachments);
  if (const GLenum status = gl.CheckFramebufferStatus(GL_FRAMEBUFFER); status != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error(fmt::format("the geometry framebuffer is incomplete (0x{:04x})", status));
  return target;
}

Eigen::Vector3d vector_of(const float* xyz) { return Eigen::Vector3d(xyz[0], xyz[1], xyz[2]); }

// Of the drawn target's pixels, the picture's.
PixelBox picture_box(const FrameParts& frame) {
  const int scale = frame.target.drawn_width() / frame.settings.width;
  const PixelBox& box = frame.covered;
  return {box.left / scale, box.bottom / scale, (box.right + scale - 1) / scale, (box.top + scale - 1) / scale};
}

}  // namespace

/// Samples of one frame.
class GeometryPass::Sampler {
 public:
  Sampler(const FrameParts& frame, int grid)
      : frame_(frame),
        view_(view_matrix(frame.stage.camera)),
        per_pixel_(grid),
        focal_(0.5 * frame.settings.height / std::tan(0.5 * frame.stage.camera.vertical_fov)) {
    for (const BodyMesh& mesh : frame.meshes) {
      std::vector<Eigen::Vector3d>& seen = seen_.emplace_back();
      for (const BodyMesh::Corner& corner : mesh.corners())
        seen.push_back((view_ * vector_of(corner.position).homogeneous()).head<3>());
    }
  }

  // What sample (column, row) of the whole picture, rows upwards, sees of a body's triangle.
  GeometrySample at(int column, int row, int body, int triangle, const Eigen::Vector4f& albedo) const {
    const BodyMesh& mesh = frame_.meshes[body];
    const Eigen::RowVector3i corner = mesh.surface().triangle.row(triangle);
    const Eigen::Vector3d ray = ray_of(column, row);
    const std::vector<Eigen::Vector3d>& seen = seen_[body];
    const Eigen::Vector3d share = shares(ray, seen[corner[0]], seen[corner[1]], seen[corner[2]]);
    GeometrySample sample{body, 0.0, {0, 0, 0}, {0, 0, 0}, {0, 0}, {0, 0}, 0.0, albedo.head<3>().cast<double>()};
    for (int c = 0; c < 3; ++c) {
      const BodyMesh::Corner& end = mesh.corners()[corner[c]];
      sample.depth -= share[c] * seen[corner[c]].z();
      sample.normal += share[c] * vector_of(end.normal);
      sample.velocity += share[c] * vector_of(end.velocity);
      sample.uv += share[c] * mesh.surface().uv.row(corner[c]).transpose().cast<double>();
      sample.strain += share[c] * end.strain;
    }
    const Eigen::Vector3d front = (seen[corner[1]] - seen[corner[0]]).cross(seen[corner[2]] - seen[corner[0]]);
    sample.normal = (front.dot(ray) > 0.0 ? -sample.normal : sample.normal).normalized();
    sample.motion = motion(ray, sample);
    return sample;
  }

 private:
  // View space, with z = -1: the point at depth t lies at t times this.
  Eigen::Vector3d ray_of(int column, int row) const {
    return {((column + 0.5) / per_pixel_ - 0.5 * frame_.settings.width) / focal_,
            ((row + 0.5) / per_pixel_ - 0.5 * frame_.settings.height) / focal_, -1.0};
  }

  // The ray meets the triangle's plane where w_a a + w_b b + w_c c is along it: w_a = ray . (b x c), and so on around.
  // GL places corners on a grid, so that a sample may lie just outside: then it takes the nearest edge's.
  static Eigen::Vector3d shares(const Eigen::Vector3d& ray, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                const Eigen::Vector3d& c) {
    const Eigen::Vector3d weight(ray.dot(b.cross(c)), ray.dot(c.cross(a)), ray.dot(a.cross(b)));
    const Eigen::Vector3d clamped = (weight.sum() < 0.0 ? -weight : weight).cwiseMax(0.0);
    const double sum = clamped.sum();
    return sum > 0.0 ? Eigen::Vector3d(clamped / sum) : Eigen::Vector3d::Constant(1.0 / 3.0);
  }

  // x' / z' - x / z without cancellation, for x' = x + u dt, z' = z + w dt: (u - w x / z) dt / z'. Depth is -z. What
  // would pass the eye within a frame stops just before it.
  Eigen::Vector2d motion(const Eigen::Vector3d& ray, const GeometrySample& sample) const {
    if (moves(frame_.camera)) return motion_before(frame_.next_camera, ray, sample);
    const Eigen::Vector3d way =
        view_.topLeftCorner<3, 3>() * (sample.velocity - frame_.camera_velocity) / frame_.settings.fps;
    const double depth = std::max(sample.depth - way.z(), 1e-3 * sample.depth);
    return focal_ / depth * (way.head<2>() + way.z() * ray.head<2>());
  }

  // The same where the next frame is taken by another camera.
  Eigen::Vector2d motion_before(const Camera& next, const Eigen::Vector3d& ray, const GeometrySample& sample) const {
    const Eigen::Vector3d place =
        view_.topLeftCorner<3, 3>().transpose() * (sample.depth * ray) + frame_.stage.camera.eye;
    const Eigen::Vector3d there = place + (sample.velocity - frame_.camera_velocity) / frame_.settings.fps;
    const Eigen::Vector3d seen = (view_matrix(next) * there.homogeneous()).head<3>();
    const double next_focal = 0.5 * frame_.settings.height / std::tan(0.5 * next.vertical_fov);
    return next_focal / std::max(-seen.z(), 1e-3 * sample.depth) * seen.head<2>() - focal_ * ray.head<2>();
  }

  const FrameParts& frame_;
  Eigen::Matrix4d view_;
  int per_pixel_;
  double focal_;                                    // [pixel]
  std::vector<std::vector<Eigen::Vector3d>> seen_;  // [m] of each body's corners, view space
};

GeometryPass::GeometryPass(const FrameParts& frame, Scenery scenery)
    : gl_(&frame.gl()),
      scenery_(scenery),
      width_(frame.settings.width),
      height_(frame.settings.height),
      grid_(grid_of(frame.settings.samples)),
      panes_(panes_of(frame, grid_)),
      band_rows_(rows_at_once(panes_.front(), grid_)),
      programs_(frame.gl(), "geometry", shaders::surface_vertex, shaders::geometry_fragment, frame.albedos) {
  const int w = panes_.front().width() * grid_, h = band_rows_ * grid_;
  hit_storage_ = make_storage(*gl_, GL_RG32UI, w, h);
  albedo_storage_ = make_storage(*gl_, GL_RGBA32F, w, h);
  depth_storage_ = make_storage(*gl_, GL_DEPTH_COMPONENT32F, w, h);
  target_ = make_target(*gl_, hit_storage_, albedo_storage_, depth_storage_);
}

// The window onto the pane moves up by the band, which begins at a row of the picture.
void GeometryPass::draw_band(const FrameParts& frame, const PixelBox& pane, int bottom) const {
  const GLuint nothing[] = {0, 0, 0, 0};
  gl_->BindFramebuffer(GL_FRAMEBUFFER, target_.name());
  gl_->Viewport(0, (pane.bottom - bottom) * grid_, pane.width() * grid_, pane.height() * grid_);
  gl_->Disable(GL_SCISSOR_TEST);
  gl_->Enable(GL_DEPTH_TEST);
  gl_->ClearBufferuiv(GL_COLOR, 0, nothing);
  gl_->Clear(GL_DEPTH_BUFFER_BIT);
  const Eigen::Matrix4d view_projection = crop(pane, width_, height_) * frame.stage.view_projection;
  programs_.set_up([&](const Program& program) { program.set("view_projection", view_projection); });
  for (const Albedo& albedo : frame.albedos) {
    if (albedo.scenery && scenery_ == Scenery::left_out) continue;
    const Program& program = programs_.use_for(albedo, 0);
    bind_texture(*gl_, 0, albedo.texture.name());
    program.set("colour", albedo.colour);
    program.set("body", static_cast<int>(albedo.body + 1));
    program.set("first", albedo.triangles.first);
    frame.meshes[albedo.body].draw(albedo.triangles);
  }
}

// `box` in pixels of the band.
void GeometryPass::read_band(const PixelBox& box) {
  const std::size_t samples = std::size_t(box.width()) * box.height() * samples_per_pixel();
  hit_.resize(samples);
  albedo_.resize(samples);
  const int x = box.left * grid_, y = box.bottom * grid_, w = box.width() * grid_, h = box.height() * grid_;
  gl_->ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl_->ReadPixels(x, y, w, h, GL_RG_INTEGER, GL_UNSIGNED_INT, hit_.data());
  gl_->ReadBuffer(GL_COLOR_ATTACHMENT1);
  gl_->ReadPixels(x, y, w, h, GL_RGBA, GL_FLOAT, albedo_.data());
}

void GeometryPass::draw(const FrameParts& frame, const PixelWork& work) {
  const Sampler sampler(frame, grid_);
  for (const PixelBox& pane : panes_) draw_pane(frame, sampler, pane, work);
}

void GeometryPass::draw_pane(const FrameParts& frame, const Sampler& sampler, const PixelBox& pane,
                             const PixelWork& work) {
  const PixelBox box = overlap(picture_box(frame), pane);
  if (box.empty()) return;
  std::vector<GeometrySample> hits;
  for (int bottom = box.bottom; bottom < box.top; bottom += band_rows_) {
    const int rows = std::min(band_rows_, box.top - bottom);
    draw_band(frame, pane, bottom);
    read_band({box.left - pane.left, 0, box.right - pane.left, rows});
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < box.width(); ++x) {
        hits.clear();
        for (int s = 0; s < samples_per_pixel(); ++s) {
          const int column = x * grid_ + s % grid_, row = y * grid_ + s / grid_;
          const std::size_t place = std::size_t(row) * box.width() * grid_ + column;
          if (const Hit& hit = hit_[place]; hit.body != 0)
            hits.push_back(sampler.at(box.left * grid_ + column, bottom * grid_ + row, static_cast<int>(hit.body) - 1,
                                      static_cast<int>(hit.triangle), albedo_[place]));
        }
        if (!hits.empty()) work(box.left + x, height_ - 1 - bottom - y, hits);
      }
  }
}

}  // namespace billow::render
