// What lies behind each sample of a picture: exact numbers of the nearest surface, unshaded.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "render/frame/body_programs.h"
#include "render/frame/frame_parts.h"

namespace billow::render {

/// The nearest surface at one sample.
struct GeometrySample {
  int body;                  // its place in the list of drawn bodies
  double depth;              // [m] along the camera's axis
  Eigen::Vector3d normal;    // unit, world, of the side that the eye sees
  Eigen::Vector3d velocity;  // [m/s] world
  Eigen::Vector2d motion;    // [pixel per frame] to the right and up: where it is 1 / fps later if nothing accelerates
  Eigen::Vector2d uv;        // v up
  double strain;             // mean |l / l_0 - 1|, 0 where the body has none
  Eigen::Vector3d albedo;    // linear-light RGB
};

/// What a pass makes of bodies that are scenery (drawn_body.h).
enum class Scenery { drawn, left_out };

/// GL finds which triangle each sample sees; all else is interpolated from the triangle's corners in double precision.
/// Samples lie on a regular grid in each pixel: 1, 2 x 2 for up to 4 samples, 4 x 4 above that.
class GeometryPass {
 public:
  GeometryPass(const FrameParts& frame, Scenery scenery);

  /// Called for every pixel that sees a body, x to the right and y down, with the samples that do.
  using PixelWork = std::function<void(int x, int y, std::span<const GeometrySample> hits)>;
  void draw(const FrameParts& frame, const PixelWork& work);

  int samples_per_pixel() const { return grid_ * grid_; }

 private:
  struct Hit {
    GLuint body, triangle;
  };
  class Sampler;
  void draw_pane(const FrameParts& frame, const Sampler& sampler, const PixelBox& pane, const PixelWork& work);
  void draw_band(const FrameParts& frame, const PixelBox& pane, int bottom) const;
  void read_band(const PixelBox& box);

  const Gl* gl_;
  Scenery scenery_;
  int width_, height_, grid_;
  std::vector<PixelBox> panes_;  // of the picture, each no larger than a viewport; of most there is one
  int band_rows_;
  BodyPrograms programs_;
  GlObject hit_storage_, albedo_storage_, depth_storage_, target_;
  std::vector<Hit> hit_;  // of the band's box, rows upwards
  std::vector<Eigen::Vector4f> albedo_;
};

}  // namespace billow::render
