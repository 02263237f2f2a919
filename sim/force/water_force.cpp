// Faces -> pressure.
#include "sim/force/water_force.h"

#include "sim/mesh/face_vector.h"

namespace billow::sim {

/// How a face moves against the water.
struct WaterForce::Flow {
  int corners = 0;
  Eigen::RowVector3d normal, velocity;  // A n [m^2]; relative to the water [m/s]
  double area = 0.0;                    // A [m^2]
  double outflow = 0.0;                 // A (n . v) [m^3/s]
  bool pushed() const { return outflow > 0.0 && area > 0.0; }
};

WaterForce::WaterForce(const Structure& structure, const Water& water, const std::vector<Face>& faces,
                       int first_particle)
    : structure_(structure), water_(water), face_(faces) {
  for (Face& face : face_)
    for (int c = 0; c < corner_count(face); ++c) face[c] += first_particle;
}

WaterForce::Flow WaterForce::flow_at(const State& state, const Face& face) const {
  Flow flow{corner_count(face), area_vector(state.position, face), Eigen::RowVector3d::Zero()};
  for (int c = 0; c < flow.corners; ++c) flow.velocity += state.velocity.row(face[c]) / flow.corners;
  flow.velocity -= water_.velocity.transpose();
  flow.area = flow.normal.norm();
  flow.outflow = flow.normal.dot(flow.velocity);
  return flow;
}

void WaterForce::add_force(const State& state, Eigen::MatrixX3d& force) const {
  for (const Face& face : face_) {
    const Flow flow = flow_at(state, face);
    if (!flow.pushed()) continue;
    const Eigen::RowVector3d share = -water_.resistance * flow.outflow / (flow.area * flow.corners) * flow.normal;
    for (int c = 0; c < flow.corners; ++c) force.row(face[c]) += share;
  }
}

// Against the water's own motion the pressure only takes energy out.
double WaterForce::work(const State& before, const State& after) const {
  if (passive()) return 0.0;
  Eigen::MatrixX3d push = Eigen::MatrixX3d::Zero(structure_.particles(), 3);
  add_force(before, push);
  add_force(after, push);
  return 0.5 * (after.time - before.time) * push.colwise().sum().dot(water_.velocity.transpose());
}

// A corner's share is -c / m g with g = (N . v) N / |N|, N = A n the face's area normal, v the mean of its corners'.
// -df/dv at each corner is c / m^2 N N^T / |N|. With dg/dN = (N v^T + (N . v) (I - N N^T / N^2)) / |N| and
// dN = dx_k x (x_next - x_previous) / 2, -df/dx_k is -c / 2m dg/dN [x_next - x_previous]_x.
void WaterForce::add_linearisation(const State& state, double position_weight, double velocity_weight,
                                   JacobianForm form, StiffnessMatrix& matrix) const {
  for (const Face& face : face_) {
    const Flow flow = flow_at(state, face);
    if (!flow.pushed()) continue;
    const int m = flow.corners;
    const Eigen::Vector3d n = flow.normal.transpose() / flow.area;
    const Eigen::Matrix3d by_velocity = velocity_weight * water_.resistance * flow.area / (m * m) * n * n.transpose();
    const bool turns = form == JacobianForm::exact && position_weight != 0.0;
    const Eigen::Matrix3d by_normal =
        n * flow.velocity + flow.outflow / flow.area * (Eigen::Matrix3d::Identity() - n * n.transpose());
    for (int k = 0; k < m; ++k) {
      Eigen::Matrix3d block = by_velocity;
      if (turns) {
        const Eigen::Matrix3d turn = cross_matrix(across(state.position, face, k));
        block -= 0.5 * position_weight * water_.resistance / m * by_normal * turn;
      }
      for (int c = 0; c < m; ++c) matrix.add_block(face[c], face[k], block);
    }
  }
}

// At any shape n n^T <= I. How the pressure turns with its face counts for nothing: in a step of h it changes
// velocities by h^2 K dx, with |K| about |C| |v| / (size of the face), so by less than damping does by the share h |v|
// / size of itself that a face crosses in a step.
bool WaterForce::add_bound(Shapes shapes, Linearisation& bound) const {
  for (const Face& face : face_) {
    const int m = corner_count(face);
    const Eigen::Vector3d normal = area_vector(structure_.rest_position, face).transpose();
    if (normal.norm() == 0.0) continue;
    const Eigen::Matrix3d reach = shapes == Shapes::any
                                      ? Eigen::Matrix3d(largest_growth * normal.norm() * Eigen::Matrix3d::Identity())
                                      : Eigen::Matrix3d(normal * normal.transpose() / normal.norm());
    for (int k = 0; k < m; ++k)
      for (int c = 0; c < m; ++c) bound.damping.add_block(face[c], face[k], water_.resistance / (m * m) * reach);
  }
  return true;
}

}  // namespace billow::sim
