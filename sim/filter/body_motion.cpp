// Momenta about the centre of mass.
#include "sim/filter/body_motion.h"

#include <Eigen/Dense>

namespace billow::sim {

bool is_free(const Structure& structure, const Body& body) {
  return (structure.inverse_mass.segment(body.first_particle, body.particles).array() > 0.0).all();
}

BodyMotion body_motion(const Structure& structure, const Body& body, const Eigen::MatrixX3d& position,
                       const Eigen::MatrixX3d& field) {
  BodyMotion motion;
  const int begin = body.first_particle, end = begin + body.particles;
  for (int i = begin; i < end; ++i) {
    motion.mass += structure.mass(i);
    motion.centre += structure.mass(i) * position.row(i).transpose();
    motion.linear += structure.mass(i) * field.row(i).transpose();
  }
  motion.centre /= motion.mass;
  for (int i = begin; i < end; ++i) {
    const Eigen::Vector3d r = position.row(i).transpose() - motion.centre, v = field.row(i);
    motion.angular += structure.mass(i) * r.cross(v);
    motion.inertia += structure.mass(i) * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  }
  return motion;
}

// The pseudo-inverse leaves an axis without inertia alone.
void set_momenta(const Structure& structure, const Body& body, const Eigen::MatrixX3d& position,
                 const BodyMotion& motion, Eigen::MatrixX3d& field) {
  const BodyMotion now = body_motion(structure, body, position, field);
  const Eigen::Vector3d shift = (motion.linear - now.linear) / now.mass;
  const Eigen::Vector3d spin =
      now.inertia.completeOrthogonalDecomposition().solve(Eigen::Vector3d(motion.angular - now.angular));
  for (int i = body.first_particle; i < body.first_particle + body.particles; ++i) {
    const Eigen::Vector3d r = position.row(i).transpose() - now.centre;
    field.row(i) += (shift + spin.cross(r)).transpose();
  }
}

}  // namespace billow::sim
