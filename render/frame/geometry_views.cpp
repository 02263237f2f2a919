// The depth, normal and id views: geometry as pictures, for looking and for tests.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "render/frame/camera.h"
#include "render/frame/geometry_pass.h"
#include "render/frame/view_drawing.h"
#include "render/image/camera_motion.h"
#include "render/image/colour_map.h"

namespace billow::render {
namespace {

/// The distances [m] along the camera's axis between which the run's bodies stay.
struct DepthRange {
  double near, far;
};

DepthRange depth_range(const FrameParts& frame) {
  if (frame.box.isEmpty()) return {0.0, 1.0};
  Eigen::AlignedBox3d seen;
  for (const Camera& camera : cameras_along(frame.camera)) seen.extend(transformed_box(frame.box, view_matrix(camera)));
  const double near = std::max(0.0, -seen.max().z());
  return {near, std::max(-seen.min().z(), near + 1e-3)};
}

// 0 is nothing; from 1 at the far end to 65535 at the near one.
std::uint16_t depth_code(double depth, const DepthRange& range) {
  const double nearness = std::clamp((range.far - depth) / (range.far - range.near), 0.0, 1.0);
  return static_cast<std::uint16_t>(1 + std::lround(65534.0 * nearness));
}

class DepthPainter : public ViewPainter {
 public:
  explicit DepthPainter(const FrameParts& frame)
      : pass_(std::make_unique<GeometryPass>(frame, Scenery::drawn)), range_(depth_range(frame)) {}

  Picture draw(FrameParts& frame) const override {
    Image16 image{frame.settings.width, frame.settings.height, {}, {}};
    image.pixels.resize(std::size_t(image.width) * image.height);
    image.notes = {{"near", fmt::format("{}", range_.near)}, {"far", fmt::format("{}", range_.far)}};
    pass_->draw(frame, [&](int x, int y, std::span<const GeometrySample> hits) {
      double depth = hits.front().depth;
      for (const GeometrySample& hit : hits) depth = std::min(depth, hit.depth);
      image.pixels[std::size_t(y) * image.width + x] = depth_code(depth, range_);
    });
    return image;
  }

 private:
  std::unique_ptr<GeometryPass> pass_;
  DepthRange range_;
};

class NormalPainter : public ViewPainter {
 public:
  explicit NormalPainter(const FrameParts& frame) : pass_(std::make_unique<GeometryPass>(frame, Scenery::drawn)) {}

  // c = 1/2 + 1/2 n of the mean over the samples that see a body.
  Picture draw(FrameParts& frame) const override {
    Image image(frame.settings.width, frame.settings.height, 3);
    pass_->draw(frame, [&](int x, int y, std::span<const GeometrySample> hits) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const GeometrySample& hit : hits) sum += hit.normal;
      const Rgb8 colour = velocity_rgb(sum, static_cast<double>(hits.size()));
      std::copy(colour.begin(), colour.end(), image.row(y) + 3 * x);
    });
    return image;
  }

 private:
  std::unique_ptr<GeometryPass> pass_;
};

// The b-th body's: hues a golden section apart, so that neighbours in the list differ most.
Rgb8 body_colour(std::size_t b) {
  constexpr double golden = 0.6180339887498949, least = 0.30;
  const double hue = 6.0 * std::fmod(golden * static_cast<double>(b), 1.0);
  const auto channel = [&](double turn) {
    const double place = std::fmod(hue + turn, 6.0);
    return std::lround(255.0 * (least + (1.0 - least) * std::clamp(std::abs(place - 3.0) - 1.0, 0.0, 1.0)));
  };
  return {static_cast<std::uint8_t>(channel(0.0)), static_cast<std::uint8_t>(channel(4.0)),
          static_cast<std::uint8_t>(channel(2.0))};
}

class IdPainter : public ViewPainter {
 public:
  IdPainter(const FrameParts& frame, const std::vector<DrawnBody>& bodies)
      : pass_(std::make_unique<GeometryPass>(frame, Scenery::drawn)) {
    for (std::size_t b = 0; b < bodies.size(); ++b) colours_.push_back(body_colour(b));
  }

  // The body with the most samples, the first of several: a mixture would be a third body's colour.
  Picture draw(FrameParts& frame) const override {
    Image image(frame.settings.width, frame.settings.height, 3);
    pass_->draw(frame, [&](int x, int y, std::span<const GeometrySample> hits) {
      std::map<int, int> count;
      for (const GeometrySample& hit : hits) ++count[hit.body];
      const auto most = std::max_element(count.begin(), count.end(),
                                         [](const auto& a, const auto& b) { return a.second < b.second; });
      const Rgb8& colour = colours_[most->first];
      std::copy(colour.begin(), colour.end(), image.row(y) + 3 * x);
    });
    return image;
  }

 private:
  std::unique_ptr<GeometryPass> pass_;
  std::vector<Rgb8> colours_;  // one per body
};

}  // namespace

std::unique_ptr<ViewPainter> make_depth_painter(const FrameParts& frame, const std::vector<DrawnBody>&) {
  return std::make_unique<DepthPainter>(frame);
}

std::unique_ptr<ViewPainter> make_normal_painter(const FrameParts& frame, const std::vector<DrawnBody>&) {
  return std::make_unique<NormalPainter>(frame);
}

std::unique_ptr<ViewPainter> make_id_painter(const FrameParts& frame, const std::vector<DrawnBody>& bodies) {
  return std::make_unique<IdPainter>(frame, bodies);
}

}  // namespace billow::render
