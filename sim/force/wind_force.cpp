// Faces in a flow -> drag and lift.
#include "sim/force/wind_force.h"

#include <algorithm>
#include <numeric>

#include "base/parallel.h"
#include "sim/mesh/face_vector.h"

namespace billow::sim {
namespace {

// Of C in units of 1/2 rho A drag V: 2 where the flow meets the face squarely, and where it does so nearly, faster than
// V, up to 0.24 % more (for the largest lift; by search over all speeds and angles).
constexpr double steepest = 2.005;

/// Psi(r), |v|^3 continued by a parabola, as the force needs it: p = psi'(r) / (3 r), q = psi(r) / r^2 and p'(r). Up to
/// `limit` they are r, r and 1.
struct Speed {
  Speed(double r, double limit) : p(r), q(r), p_slope(1.0) {
    if (r <= limit) return;
    const double share = limit / r;
    p = limit * (2.0 - share);
    q = limit * (3.0 - share * (3.0 - share));
    p_slope = share * share;
  }
  double p, q, p_slope;
};

/// The force per 1/2 rho A, without its sign, and its derivatives: h = p g v + lift q w with g = along + 3/2 lift c^2,
/// w = (n.v) n - c^2 v, c = n.v / |v|, `along` being the drag coefficient of a face along the flow.
struct Push {
  Push(const Eigen::Vector3d& v, const Eigen::Vector3d& n, const Wind& wind)
      : v(v), n(n), lift(wind.lift), r(v.norm()), through(n.dot(v)), speed(r, wind.quadratic_to) {
    if (r == 0.0) return;
    cosine2 = through * through / (r * r);
    g = wind.drag - 1.5 * lift * (1.0 - cosine2);
    w = through * n - cosine2 * v;
  }
  Eigen::Vector3d value() const { return speed.p * g * v + lift * speed.q * w; }
  // d c^2 = 2 w.dv / r^2, and q' = (3 p - 2 q) / r, which makes it symmetric.
  Eigen::Matrix3d by_velocity() const {
    if (r == 0.0) return Eigen::Matrix3d::Zero();
    const Eigen::Matrix3d mixed = v * w.transpose() + w * v.transpose();
    return (speed.p * g - lift * speed.q * cosine2) * Eigen::Matrix3d::Identity() + lift * speed.q * n * n.transpose() +
           speed.p_slope * g / r * v * v.transpose() + lift * (3.0 * speed.p - 2.0 * speed.q) / (r * r) * mixed;
  }
  // d c^2 = 2 (n.v) v.dn / r^2.
  Eigen::Matrix3d by_normal() const {
    if (r == 0.0) return Eigen::Matrix3d::Zero();
    return lift * ((3.0 * speed.p - 2.0 * speed.q) * through / (r * r) * v * v.transpose() +
                   speed.q * (n * v.transpose() + through * Eigen::Matrix3d::Identity()));
  }

  Eigen::Vector3d v, n, w = Eigen::Vector3d::Zero();
  double lift, r, through;
  Speed speed;
  double cosine2 = 0.0, g = 0.0;
};

}  // namespace

/// How a face moves against the air.
struct WindForce::Flow {
  int corners = 0;
  double area = 0.0;         // [m^2] its own
  double counted = 0.0;      // [m^2] what of it counts
  Eigen::Vector3d normal;    // of length 1
  Eigen::Vector3d place;     // [m] its middle
  Eigen::Vector3d air;       // [m/s]
  Eigen::Vector3d velocity;  // [m/s] relative to the air
};

WindForce::WindForce(const Structure& structure, const Wind& wind, const std::vector<Face>& faces, int first_particle)
    : structure_(structure), wind_(wind), field_(wind.velocity, wind.gusts) {
  panel_.reserve(faces.size());
  for (Face face : faces) {
    for (int c = 0; c < corner_count(face); ++c) face[c] += first_particle;
    panel_.push_back({face, area_vector(structure.rest_position, face).norm()});
  }
}

WindForce::Flow WindForce::flow_at(const State& state, const Panel& panel) const {
  Flow flow;
  const Eigen::Vector3d vector = area_vector(state.position, panel.corner).transpose();
  flow.corners = corner_count(panel.corner);
  flow.area = vector.norm();
  if (flow.area == 0.0) return flow;
  flow.counted = std::min(flow.area, largest_growth * panel.rest_area);
  flow.normal = vector / flow.area;
  flow.place.setZero(), flow.velocity.setZero();
  for (int c = 0; c < flow.corners; ++c) {
    flow.place += state.position.row(panel.corner[c]).transpose();
    flow.velocity += state.velocity.row(panel.corner[c]).transpose();
  }
  const double share = 1.0 / flow.corners;
  flow.place *= share, flow.velocity *= share;
  flow.air = field_.velocity(flow.place, state.time);
  flow.velocity -= flow.air;
  return flow;
}

Eigen::Vector3d WindForce::push(const Flow& flow) const {
  return -0.5 * wind_.density * flow.counted * Push(flow.velocity, flow.normal, wind_).value();
}

// Faces side by side, then each corner's sum in the order of the faces, whichever thread had them.
template <class Value, class Of>
std::vector<Value> WindForce::of_panels(const State& state, const Value& none, const Of& of) const {
  constexpr int least_panels_for_threads = 512;
  const int panels = static_cast<int>(panel_.size());
  std::vector<Value> value(panel_.size(), none);
  const auto evaluate = [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      const Flow flow = flow_at(state, panel_[static_cast<std::size_t>(k)]);
      if (flow.counted != 0.0) value[static_cast<std::size_t>(k)] = of(flow);
    }
  };
  const int parts = std::clamp(panels / least_panels_for_threads, 1, most_parts());
  if (parts == 1)
    evaluate(0, panels);
  else
    run_isolated(parts, [&](int part) {
      const auto begin = [&](int p) { return static_cast<int>(std::int64_t{panels} * p / parts); };
      evaluate(begin(part), begin(part + 1));
    });
  return value;
}

void WindForce::add_force(const State& state, Eigen::MatrixX3d& force) const {
  const std::vector<Eigen::Vector3d> share =
      of_panels(state, Eigen::Vector3d::Zero().eval(),
                [&](const Flow& flow) -> Eigen::Vector3d { return push(flow) / flow.corners; });
  for (std::size_t k = 0; k < panel_.size(); ++k)
    for (int c = 0; c < corner_count(panel_[k].corner); ++c) force.row(panel_[k].corner[c]) += share[k].transpose();
}

// Against the air's own motion the force only takes energy out.
double WindForce::work(const State& before, const State& after) const {
  if (passive()) return 0.0;
  const State middle{0.5 * (before.position + after.position), 0.5 * (before.velocity + after.velocity),
                     0.5 * (before.time + after.time)};
  const std::vector<double> power = of_panels(middle, 0.0, [&](const Flow& flow) { return push(flow).dot(flow.air); });
  return (after.time - before.time) * std::accumulate(power.begin(), power.end(), 0.0);
}

// With a = 1/2 rho and m corners, each has -a A / m h(v, n). v is the mean of the corners' less the air's at their mean
// place: -df/dv is a A / m^2 dh/dv between any two, and -df/dx has -a A / m^2 dh/dv grad(air). N = A n changes with
// corner k by -[across]_x / 2, and A h by (h n^T + dh/dn (I - n n^T)) dN, without the first where A no longer counts.
void WindForce::add_linearisation(const State& state, double position_weight, double velocity_weight, JacobianForm form,
                                  StiffnessMatrix& matrix) const {
  const bool turns = form == JacobianForm::exact && position_weight != 0.0;
  for (const Panel& panel : panel_) {
    const Flow flow = flow_at(state, panel);
    if (flow.counted == 0.0) continue;
    const int m = flow.corners;
    const Push push(flow.velocity, flow.normal, wind_);
    const double half_density = 0.5 * wind_.density;
    const Eigen::Matrix3d damping = half_density * flow.counted / (m * m) * push.by_velocity();
    Eigen::Matrix3d between = velocity_weight * damping, by_area = Eigen::Matrix3d::Zero();
    if (turns) {
      between -= position_weight * damping * field_.gradient(flow.place, state.time);
      by_area = flow.counted / flow.area * push.by_normal() *
                (Eigen::Matrix3d::Identity() - flow.normal * flow.normal.transpose());
      if (flow.counted == flow.area) by_area += push.value() * flow.normal.transpose();
    }
    for (int k = 0; k < m; ++k) {
      Eigen::Matrix3d block = between;
      if (turns)
        block -=
            0.5 * position_weight * half_density / m * by_area * cross_matrix(across(state.position, panel.corner, k));
      for (int c = 0; c < m; ++c) matrix.add_block(panel.corner[c], panel.corner[k], block);
    }
  }
}

// As with water, how the force turns with the face counts for nothing: in a step it changes velocities by less than
// damping does, by the share of itself that a face crosses in that step.
bool WindForce::add_bound(Shapes shapes, Linearisation& bound) const {
  const double growth = shapes == Shapes::any ? largest_growth : 1.0;
  for (const Panel& panel : panel_) {
    const int m = corner_count(panel.corner);
    const double most =
        steepest * 0.5 * wind_.density * growth * panel.rest_area * wind_.drag * wind_.quadratic_to / (m * m);
    for (int k = 0; k < m; ++k)
      for (int c = 0; c < m; ++c)
        bound.damping.add_block(panel.corner[c], panel.corner[k], most * Eigen::Matrix3d::Identity());
  }
  return true;
}

}  // namespace billow::sim
