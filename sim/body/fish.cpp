// Stations, nodes and units of the fish. What joins what follows Tu & Terzopoulos 1994, figure 3: rings braced by their
// diagonals, every side between two rings braced by both of its diagonals, muscles along the body.
#include "sim/body/fish.h"

#include <cmath>

#include "base/error.h"

namespace billow::sim {
namespace {

constexpr std::array<Level, 2> levels{Level::dorsal, Level::ventral};
constexpr std::array<Side, 2> sides{Side::left, Side::right};

/// A cross-section of the body at rest, in shares of the length.
struct Station {
  double behind;       // distance behind the tip of the snout
  double half_height;  // of its particles above and below the axis
  double half_width;   // of its particles beside the axis
};

// The particles form a cage rather than the outline: slender in front, where it parts the water, and wider towards the
// tail than a fish is, so that the tail fin is held firmly enough to push. The stiffest mode of all, the tips of the
// tail moving apart, is near 1000 s^-2.
constexpr Station snout_station{0.011, 0.0, 0.0};
constexpr std::array<Station, fish_rings> ring_station{{{0.181, 0.033, 0.039},
                                                        {0.315, 0.050, 0.057},
                                                        {0.509, 0.065, 0.059},
                                                        {0.717, 0.060, 0.073},
                                                        {0.858, 0.060, 0.074}}};
constexpr Station tail_station{0.980, 0.155, 0.0};

double sign(Side side) { return side == Side::right ? 1.0 : -1.0; }
double sign(Level level) { return level == Level::dorsal ? 1.0 : -1.0; }

Eigen::RowVector3d place(const Station& station, double side, double level) {
  return {0.5 - station.behind, level * station.half_height, side * station.half_width};
}

// In body axes, for a fish of length 1 (23 x 3).
Eigen::MatrixX3d unit_positions() {
  Eigen::MatrixX3d position(fish_particles, 3);
  position.row(fish_snout()) = place(snout_station, 0.0, 0.0);
  for (int r = 0; r < fish_rings; ++r)
    for (const Level level : levels)
      for (const Side side : sides)
        position.row(fish_node(r, side, level)) = place(ring_station[r], sign(side), sign(level));
  for (const Level level : levels) position.row(fish_tail_tip(level)) = place(tail_station, 0.0, sign(level));
  return position;
}

Eigen::VectorXd masses(const FishMass& mass) {
  Eigen::VectorXd result(fish_particles);
  result(fish_snout()) = mass.snout;
  for (int r = 0; r < fish_rings; ++r)
    for (const Level level : levels)
      for (const Side side : sides) result(fish_node(r, side, level)) = mass.ring[r];
  for (const Level level : levels) result(fish_tail_tip(level)) = mass.tail_tip;
  return result;
}

/// Clockwise around a ring as the fish sees it: dorsal left, dorsal right, ventral right, ventral left.
int corner(int ring, int k) {
  constexpr std::array<Side, 4> side{Side::left, Side::right, Side::right, Side::left};
  constexpr std::array<Level, 4> level{Level::dorsal, Level::dorsal, Level::ventral, Level::ventral};
  return fish_node(ring, side[k % 4], level[k % 4]);
}

struct Unit {
  SpringKind kind;
  int first, second;
};

void add_head(std::vector<Unit>& units) {
  for (int k = 0; k < 4; ++k) units.push_back({SpringKind::normal, fish_snout(), corner(0, k)});
}

void add_ring(int ring, std::vector<Unit>& units) {
  for (int k = 0; k < 4; ++k) units.push_back({SpringKind::normal, corner(ring, k), corner(ring, k + 1)});
  for (int k = 0; k < 2; ++k) units.push_back({SpringKind::cross, corner(ring, k), corner(ring, k + 2)});
}

// Between a ring and the next: a unit along the body in each corner, both diagonals on each of the four sides.
void add_segment(int ring, std::vector<Unit>& units) {
  const SpringKind along = ring < fish_segments ? SpringKind::muscle : SpringKind::normal;
  for (int k = 0; k < 4; ++k) {
    units.push_back({along, corner(ring, k), corner(ring + 1, k)});
    units.push_back({SpringKind::cross, corner(ring, k), corner(ring + 1, k + 1)});
    units.push_back({SpringKind::cross, corner(ring, k + 1), corner(ring + 1, k)});
  }
}

// Each tip is held by its own pair of the last ring, braced by the other pair, and joined to the other tip.
void add_tail(std::vector<Unit>& units) {
  for (const Level tip : levels)
    for (const Level level : levels)
      for (const Side side : sides)
        units.push_back({tip == level ? SpringKind::normal : SpringKind::cross, fish_node(fish_rings - 1, side, level),
                         fish_tail_tip(tip)});
  units.push_back({SpringKind::normal, fish_tail_tip(Level::dorsal), fish_tail_tip(Level::ventral)});
}

std::vector<Unit> units_head_to_tail() {
  std::vector<Unit> units;
  add_head(units);
  for (int r = 0; r < fish_rings; ++r) {
    add_ring(r, units);
    if (r + 1 < fish_rings) add_segment(r, units);
  }
  add_tail(units);
  return units;
}

double stiffness_of(SpringKind kind, const FishOptions& options) {
  if (kind == SpringKind::cross) return options.cross;
  return kind == SpringKind::muscle ? options.muscle : options.normal;
}

void add_springs(const std::vector<Unit>& units, const FishOptions& options, Structure& fish) {
  const auto m = static_cast<Eigen::Index>(units.size());
  fish.spring.resize(m, 2);
  fish.rest_length.resize(m);
  fish.stiffness.resize(m);
  fish.damping = Eigen::VectorXd::Constant(m, options.viscosity);
  for (Eigen::Index s = 0; s < m; ++s) {
    const auto [kind, first, second] = units[static_cast<std::size_t>(s)];
    fish.spring.row(s) << std::min(first, second), std::max(first, second);
    fish.rest_length(s) = (fish.rest_position.row(second) - fish.rest_position.row(first)).norm();
    fish.stiffness(s) = stiffness_of(kind, options);
    fish.kind.push_back(kind);
  }
}

}  // namespace

int fish_snout() { return 0; }

int fish_node(int ring, Side side, Level level) {
  return 1 + 4 * ring + 2 * (level == Level::ventral) + (side == Side::right);
}

int fish_tail_tip(Level level) { return 1 + 4 * fish_rings + (level == Level::ventral); }

FishOptions fish_of_length(double length) {
  const double s = length / default_fish_length;
  FishOptions fish;
  fish.length = length;
  fish.mass.snout *= s * s * s;
  for (double& mass : fish.mass.ring) mass *= s * s * s;
  fish.mass.tail_tip *= s * s * s;
  fish.cross *= s, fish.normal *= s, fish.muscle *= s;
  fish.viscosity *= s * s;
  return fish;
}

Structure build_fish(const FishOptions& options) {
  Structure fish;
  fish.rest_position =
      (options.length * unit_positions() * options.rotation.transpose()).rowwise() + options.position.transpose();
  fish.mass = masses(options.mass);
  if (!(fish.mass.minCoeff() > 0.0)) throw InputError("every particle of a fish needs a mass");
  fish.inverse_mass = fish.mass.cwiseInverse();
  add_springs(units_head_to_tail(), options, fish);
  Body body;
  body.name = options.name;
  body.particles = fish.particles();
  body.springs = fish.springs();
  body.friction = options.friction;
  body.mean_rest_length = fish.rest_length.mean();
  fish.body.push_back(body);
  return fish;
}

std::vector<Muscle> fish_muscles() {
  const std::vector<Unit> units = units_head_to_tail();
  std::vector<Muscle> muscles;
  for (std::size_t s = 0; s < units.size(); ++s) {
    if (units[s].kind != SpringKind::muscle) continue;
    const int segment = (units[s].first - 1) / 4;
    const Side side = (units[s].first - 1) % 2 == 0 ? Side::left : Side::right;
    muscles.push_back({static_cast<int>(s), segment, side});
  }
  return muscles;
}

// A side between a station in front and one behind it, corners k and k + 1: where a station has shrunk to a point or a
// line, the quad is a triangle.
std::vector<Face> fish_faces() {
  const int top = fish_tail_tip(Level::dorsal), bottom = fish_tail_tip(Level::ventral);
  constexpr int last = fish_rings - 1;
  std::vector<Face> faces;
  for (int k = 0; k < 4; ++k) {
    faces.push_back({corner(0, k), corner(0, k + 1), fish_snout(), -1});
    for (int r = 0; r < last; ++r)
      faces.push_back({corner(r + 1, k), corner(r + 1, k + 1), corner(r, k + 1), corner(r, k)});
  }
  faces.push_back({top, corner(last, 1), corner(last, 0), -1});
  faces.push_back({top, bottom, corner(last, 2), corner(last, 1)});
  faces.push_back({bottom, corner(last, 3), corner(last, 2), -1});
  faces.push_back({bottom, top, corner(last, 0), corner(last, 3)});
  return faces;
}

std::array<double, fish_rings + 2> fish_stations() {
  std::array<double, fish_rings + 2> behind{};
  behind.front() = snout_station.behind;
  for (int r = 0; r < fish_rings; ++r) behind[r + 1] = ring_station[r].behind;
  behind.back() = tail_station.behind;
  return behind;
}

}  // namespace billow::sim
