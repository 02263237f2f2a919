// What all views of a run are drawn with: the GL, the bodies in it, their shadows and surroundings.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "render/frame/albedo.h"
#include "render/frame/body_mesh.h"
#include "render/frame/drawing_options.h"
#include "render/frame/drawn_body.h"
#include "render/frame/shadow.h"
#include "render/frame/stage.h"
#include "render/frame/surroundings.h"
#include "render/gl/frame_target.h"
#include "render/gl/gl_context.h"
#include "render/gl/pixel_box.h"
#include "render/image/settings.h"

namespace billow::render {

/// Made once per run. Its context must be current wherever it is used, destroyed or drawn with.
struct FrameParts {
  FrameParts(const Settings& settings, const std::vector<DrawnBody>& bodies, const RunBounds& bounds,
             const DrawingOptions& options);

  const Gl& gl() const { return context.gl(); }
  /// Moves the bodies, states[b] belonging to the b-th, and the camera to `time` [s]. Throws std::invalid_argument when
  /// the states are not theirs.
  void update(const std::vector<sim::SurfaceState>& states, double time);

  void move_camera(double time);

  /// The picture, RGB or RGBA, of which `paint` paints a tile at a time into the target's plain picture; it is told the
  /// box of the tile that bodies cover.
  Image draw_tiles(bool with_alpha, const std::function<void(const PixelBox& covered)>& paint);
  /// Makes the plain picture background and ground.
  void recall_backdrop();

  Settings settings;
  double velocity_range;    // [m/s] v_max: the settings', or else the run's
  Eigen::AlignedBox3d box;  // [m] of the run's bodies
  Camera camera;            // as it starts to move
  Stage stage;
  Camera next_camera;  // of the frame after the current one
  TileLimits tile_limits;
  GlContext context;
  FrameTarget target;
  std::vector<Albedo> albedos;  // of all bodies
  Shadow shadow;
  Surroundings surroundings;
  std::vector<BodyMesh> meshes;                               // one per body
  PixelBox covered;                                           // by the bodies of the current frame, of all tiles
  std::optional<PixelBox> backdrop_tile;                      // whose backdrop the target keeps
  Eigen::Vector3d camera_velocity = Eigen::Vector3d::Zero();  // [m/s] of the current frame
};

}  // namespace billow::render
