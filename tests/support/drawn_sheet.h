// A small wavy sheet to draw: built in code, so that a golden image depends on the renderer alone.
#pragma once

#include "render/frame/mesh_renderer.h"

namespace billow::test {

/// What a MeshRenderer needs for one body in one frame.
struct DrawnSheet {
  render::DrawnBody body;
  sim::SurfaceState state;
  render::RunBounds bounds;
};

/// n x n points over about one square metre, hanging in folds around the origin, facing +z; checker texture; every
/// velocity component spans about [-1, 1] m/s.
DrawnSheet wavy_sheet(int n = 24);

/// A flat square of side 2 m at z = 0 facing +z, every point moving at `velocity` [m/s].
DrawnSheet flat_sheet(const Eigen::Vector3f& velocity = Eigen::Vector3f::Zero());

/// 8 x 8 squares of two colours, 64 x 64 pixels.
render::Image checker();

/// Small pictures with the camera fitted, no legend.
render::Settings sheet_settings();

/// Straight at the flat sheet, which fills the middle half of the picture.
render::Settings frontal_settings();

/// One frame by a renderer of its own, of a view whose pictures are Images.
render::Image draw_sheet(const DrawnSheet& sheet, render::View view, const render::Settings& settings);

}  // namespace billow::test
