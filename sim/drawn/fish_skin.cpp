// Weights of the particles in a travelling frame.
#include "sim/drawn/fish_skin.h"

#include <array>

#include "sim/body/cloth.h"
#include "sim/drawn/cubic_spline.h"

namespace billow::sim {
namespace {

constexpr int stations = fish_rings + 2;
using Weights = Eigen::Matrix<double, 1, fish_particles>;

/// A station's frame as linear combinations of the particles. At rest, in a fish of length 1, `up` and `side` come to
/// the unit vectors +y and +z.
struct Frame {
  Weights middle = Weights::Zero(), up = Weights::Zero(), side = Weights::Zero();
};

double rest_height(const Eigen::MatrixX3d& rest, const Weights& weights) { return (weights * rest).y(); }
double rest_width(const Eigen::MatrixX3d& rest, const Weights& weights) { return (weights * rest).z(); }

Frame ring_frame(int ring, const Eigen::MatrixX3d& rest) {
  Frame frame;
  for (const Side side : {Side::left, Side::right})
    for (const Level level : {Level::dorsal, Level::ventral}) {
      const int node = fish_node(ring, side, level);
      frame.middle(node) = 0.25;
      frame.up(node) = level == Level::dorsal ? 1.0 : -1.0;
      frame.side(node) = side == Side::right ? 1.0 : -1.0;
    }
  frame.up /= rest_height(rest, frame.up);
  frame.side /= rest_width(rest, frame.side);
  return frame;
}

// The snout and the tail's tips are no rings: what they cannot tell they take from the ring beside them.
std::array<Frame, stations> station_frames(const Eigen::MatrixX3d& rest) {
  std::array<Frame, stations> frame;
  for (int r = 0; r < fish_rings; ++r) frame[r + 1] = ring_frame(r, rest);
  frame.front() = frame[1];
  frame.front().middle = Weights::Unit(fish_snout());
  Frame& tail = frame.back();
  const int top = fish_tail_tip(Level::dorsal), bottom = fish_tail_tip(Level::ventral);
  tail = frame[fish_rings];
  tail.middle = 0.5 * (Weights::Unit(top) + Weights::Unit(bottom));
  tail.up = Weights::Unit(top) - Weights::Unit(bottom);
  tail.up /= rest_height(rest, tail.up);
  return frame;
}

// Positions at rest in the body axes of a fish of length 1.
Eigen::MatrixX3d unit_rest() {
  FishOptions unit;
  unit.length = 1.0;
  return build_fish(unit).rest_position;
}

// The frame at a distance behind the snout, in shares of the length.
Frame frame_at(double behind, const std::array<Frame, stations>& frame) {
  const auto knots = fish_stations();
  const Eigen::VectorXd share =
      spline_weights(Eigen::VectorXd::Map(knots.data(), static_cast<Eigen::Index>(knots.size())), behind);
  Frame blend;
  for (int k = 0; k < stations; ++k) {
    blend.middle += share(k) * frame[k].middle;
    blend.up += share(k) * frame[k].up;
    blend.side += share(k) * frame[k].side;
  }
  return blend;
}

void bind_point(int point, const Eigen::RowVector3d& position, const Frame& frame, const Eigen::MatrixX3d& rest,
                Skin& skin) {
  const Eigen::RowVector3d origin = frame.middle * rest;
  skin.middle.row(point) = frame.middle.cast<float>();
  skin.up.row(point) = frame.up.cast<float>();
  skin.side.row(point) = frame.side.cast<float>();
  skin.height(point) = static_cast<float>(position.y() - origin.y());
  skin.width(point) = static_cast<float>(position.z() - origin.z());
}

}  // namespace

Skin bind_fish_skin(const Mesh& mesh, double length) {
  const Eigen::MatrixX3d rest = unit_rest();
  const std::array<Frame, stations> frame = station_frames(rest);
  const int points = mesh.vertices();
  Skin skin{build_surface(mesh)};
  for (Eigen::MatrixXf* weight : {&skin.middle, &skin.up, &skin.side}) weight->resize(points, fish_particles);
  skin.height.resize(points), skin.width.resize(points);
  for (int v = 0; v < points; ++v)
    bind_point(v, mesh.position.row(v), frame_at(0.5 - mesh.position(v, 0), frame), rest, skin);
  skin.height *= static_cast<float>(length);
  skin.width *= static_cast<float>(length);
  return skin;
}

Eigen::MatrixXd fish_axis(int rows) {
  const std::array<Frame, stations> frame = station_frames(unit_rest());
  const auto knots = fish_stations();
  Eigen::MatrixXd weights(rows, fish_particles);
  for (int r = 0; r < rows; ++r)
    weights.row(r) = frame_at(knots.front() + (knots.back() - knots.front()) * r / (rows - 1.0), frame).middle;
  return weights;
}

Skin plain_fish_skin() {
  Mesh mesh;
  mesh.position = unit_rest();
  mesh.face = fish_faces();
  return {build_surface(mesh)};
}

}  // namespace billow::sim
