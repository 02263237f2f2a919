// The data view: what compositing and measuring want of every pixel, as numbers.
#include <algorithm>
#include <limits>
#include <map>

#include "render/frame/geometry_pass.h"
#include "render/frame/view_drawing.h"
#include "render/image/cryptomatte.h"

namespace billow::render {
namespace {

constexpr const char* summed_channels[] = {"R",          "G",          "B",        "A",        "velocity.X",
                                           "velocity.Y", "velocity.Z", "motion.X", "motion.Y", "N.X",
                                           "N.Y",        "N.Z",        "UV.U",     "UV.V",     "strain"};
constexpr int sums = std::size(summed_channels);
constexpr int depth_channel = sums, first_id_channel = sums + 1;
constexpr int id_ranks = 4;  // bodies told apart in one pixel: two channels each
constexpr const char* id_layer = "id";

using Sums = Eigen::Matrix<double, sums, 1>;

Sums values_of(const GeometrySample& sample) {
  Sums values;
  values << sample.albedo, 1.0, sample.velocity, sample.motion, sample.normal, sample.uv, sample.strain;
  return values;
}

DataImage empty_image(int width, int height) {
  DataImage image{width, height, {}, {}};
  const auto add = [&](const std::string& name, float value) {
    image.channels.push_back({name, std::vector<float>(std::size_t(width) * height, value)});
  };
  for (const char* name : summed_channels) add(name, 0.0f);
  add("Z", std::numeric_limits<float>::infinity());
  for (int rank = 0; rank < id_ranks; rank += 2)
    for (const char* component : {"R", "G", "B", "A"})
      add(std::string(id_layer) + "0" + char('0' + rank / 2) + "." + component, 0.0f);
  return image;
}

class DataPainter : public ViewPainter {
 public:
  DataPainter(const FrameParts& frame, const std::vector<DrawnBody>& bodies)
      : pass_(std::make_unique<GeometryPass>(frame, Scenery::drawn)) {
    std::vector<std::string> names;
    for (const DrawnBody& body : bodies) {
      names.push_back(body.name);
      ids_.push_back(cryptomatte_id(body.name));
    }
    notes_ = cryptomatte_notes(id_layer, names);
  }

  Picture draw(FrameParts& frame) const override {
    DataImage image = empty_image(frame.settings.width, frame.settings.height);
    image.notes = notes_;
    pass_->draw(frame, [&](int x, int y, std::span<const GeometrySample> hits) {
      const std::size_t pixel = std::size_t(y) * image.width + x;
      add_values(image, pixel, hits);
      add_ids(image, pixel, hits);
    });
    return image;
  }

 private:
  // Means over all samples of the pixel, those that see nothing counting 0: premultiplied by A.
  void add_values(DataImage& image, std::size_t pixel, std::span<const GeometrySample> hits) const {
    Sums sum = Sums::Zero();
    double depth = hits.front().depth;
    for (const GeometrySample& hit : hits) {
      sum += values_of(hit);
      depth = std::min(depth, hit.depth);
    }
    sum /= pass_->samples_per_pixel();
    for (int c = 0; c < sums; ++c) image.channels[c].value[pixel] = static_cast<float>(sum[c]);
    image.channels[depth_channel].value[pixel] = static_cast<float>(depth);
  }

  // Which bodies, the one with the most samples first, and the share of the pixel's samples that each has.
  void add_ids(DataImage& image, std::size_t pixel, std::span<const GeometrySample> hits) const {
    std::map<int, int> count;
    for (const GeometrySample& hit : hits) ++count[hit.body];
    std::vector<std::pair<int, int>> ranked(count.begin(), count.end());
    std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
    for (std::size_t rank = 0; rank < std::min<std::size_t>(ranked.size(), id_ranks); ++rank) {
      const auto [body, samples] = ranked[rank];
      image.channels[first_id_channel + 2 * rank].value[pixel] = ids_[body];
      image.channels[first_id_channel + 2 * rank + 1].value[pixel] = float(samples) / pass_->samples_per_pixel();
    }
  }

  std::unique_ptr<GeometryPass> pass_;
  std::vector<float> ids_;  // one per body
  ImageNotes notes_;
};

}  // namespace

std::unique_ptr<ViewPainter> make_data_painter(const FrameParts& frame, const std::vector<DrawnBody>& bodies) {
  return std::make_unique<DataPainter>(frame, bodies);
}

}  // namespace billow::render
