// The mass-spring structure that every solver shares. Built once, then const.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/words.h"

namespace billow::sim {

enum class SpringKind : std::uint8_t { structural, shear, bend, cross, normal, muscle, interior };

Words<SpringKind> words(SpringKind);
/// The kind's name as scenes and reports write it.
inline std::string_view name(SpringKind kind) { return word_of(kind); }

/// How a body's springs push: `linear` f = k (|d| - L) both ways; `choi_ko` as Choi & Ko 2002 (method.md section 1).
enum class SpringModel : std::uint8_t { linear, choi_ko };
Words<SpringModel> words(SpringModel);

/// How a body's springs damp: `projected` c (u . relative velocity) u along the spring u; `spring` c times the whole
/// relative velocity, which also damps rigid rotation (the common "incorrect" model, offered to compare).
enum class DampingModel : std::uint8_t { projected, spring };
Words<DampingModel> words(DampingModel);

/// One body of a scene: a contiguous range of particles and of springs, and the laws that hold in it.
struct Body {
  std::string name;
  int first_particle = 0, particles = 0;
  int first_spring = 0, springs = 0;
  SpringModel spring_model = SpringModel::linear;
  DampingModel damping_model = DampingModel::projected;
  double friction = 0.0;           // [kg/s]   fluid friction per particle: f = -friction v
  double mean_rest_length = 1.0;   // [m]      mean over the structural springs: the filter's unit of distance
  double buckling_rigidity = 0.0;  // [N m^2]  k_b of choi_ko
};

/// Mass-spring topology and material. n particles, m springs, SI units.
struct Structure {
  Eigen::MatrixX3d rest_position;  // [m]      (n x 3) also the initial positions
  Eigen::VectorXd mass;            // [kg]     (n)     > 0, also for pinned particles
  Eigen::VectorXd inverse_mass;    // [1/kg]   (n)     0 pins the particle
  Eigen::MatrixX2i spring;         //          (m x 2) end particles, column 0 < column 1
  Eigen::VectorXd rest_length;     // [m]      (m)     > 0
  Eigen::VectorXd stiffness;       // [N/m]    (m)     >= 0
  Eigen::VectorXd damping;         // [N s/m]  (m)     >= 0
  std::vector<SpringKind> kind;    //          (m)
  std::vector<Body> body;          //                  in order of particles

  int particles() const { return static_cast<int>(rest_position.rows()); }
  int springs() const { return static_cast<int>(spring.rows()); }
  bool pinned(int particle) const { return inverse_mass(particle) == 0.0; }
};

/// Masses (n) [kg], 0 of pinned particles: of the inner product in which stiffness, filters and their limits are seen.
Eigen::VectorXd free_mass(const Structure& structure);
/// The same (n), 0 also of all other bodies' particles.
Eigen::VectorXd free_mass(const Structure& structure, const Body& body);

/// Whether any spring of `body` damps.
bool is_damped(const Structure& structure, const Body& body);

/// The body that a particle belongs to.
const Body& body_of(const Structure& structure, int particle);

/// Several structures as one, particles and springs concatenated in order; every solver then steps them together.
Structure merge(const std::vector<Structure>& parts);

}  // namespace billow::sim
