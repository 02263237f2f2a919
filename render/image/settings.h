// What a scene says about its pictures.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "base/words.h"
#include "render/image/views.h"

namespace billow::render {

/// How the velocity view colours: `components` c = 1/2 + 1/2 v / v_max per axis into RGB; `magnitude` |v| through a
/// perceptually uniform map.
enum class VelocityColour { components, magnitude };
Words<VelocityColour> words(VelocityColour);

/// Where a moving camera is at one moment.
struct CameraKey {
  double time = 0.0;             // [s]
  Eigen::Vector3d eye, look_at;  // [m]
  double vertical_fov;           // [rad]
};

/// A pinhole camera. Unset fields are fitted to the bodies' motion.
struct Camera {
  Eigen::Vector3d eye{0.0, 0.0, 3.0};      // [m]
  Eigen::Vector3d look_at{0.0, 0.0, 0.0};  // [m]
  double vertical_fov = 0.6981317;         // [rad] 40 degrees
  bool fitted = false;                     // eye and look_at are to be found from the bodies' bounding box
  std::vector<CameraKey> keys = {};        // ascending in time; where there are any, they say all of the above
  double turn_period = 0.0;                // [s] in which it turns once around look_at; 0: it does not
};

struct Background {
  bool none = false;                            // pictures have an alpha instead
  Eigen::Vector3f top{0.56f, 0.62f, 0.68f};     // linear-light RGB in [0, 1]
  Eigen::Vector3f bottom{0.86f, 0.85f, 0.83f};  // linear-light RGB in [0, 1]
};

struct Settings {
  int width = 1280, height = 720;  // [pixel]
  double fps = 25.0;               // [1/s]
  int samples = 4;                 // multisampling; 1, 2, 4, or 8, 16 by supersampling
  std::vector<View> views{View::textured, View::velocity};
  Camera camera;
  bool ground = true;                   // draw a ground plane that receives the shadow
  bool shadow_only = false;             // of the ground only the shadow, where there is no background
  std::optional<double> ground_height;  // [m] y; unset: just below the lowest point of the run
  VelocityColour velocity_colour = VelocityColour::components;
  std::optional<double> velocity_range;  // [m/s] v_max; unset: found from the run
  double velocity_shading = 0.25;        // how much the velocity view darkens surfaces that turn
                                         // away from the eye, in [0, 1]; 0: exact colours everywhere
  bool legend = true;                    // label the velocity view with its scale
  Background background;
};

/// The same settings with every place [m] as seen from `origin` [m].
Settings seen_from(Settings settings, const Eigen::Vector3d& origin);

}  // namespace billow::render
