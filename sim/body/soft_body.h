// A closed polygon mesh -> a soft solid: the springs of a cloth on its surface, and springs through its inside.
#pragma once

#include "sim/body/cloth.h"

namespace billow::sim {

struct SoftBodyOptions {
  /// Masses and springs of the surface, damping, friction and pins; its springs are linear.
  ClothOptions surface{.name = "soft", .mass = 1.0, .structural = 200.0, .shear = 140.0, .bend = 50.0};
  double interior = 100.0;           // [N/m] springs through the inside
  std::optional<double> young = {};  // [Pa]  of what it is made of, in place of all four
  Eigen::VectorXd stiffness_factor;  //       (v) > 0, of every spring the mean of its two ends' factors; empty: all 1
  Eigen::VectorXd mass_factor;       //       (v) > 0, density relative to the other particles'; empty: all 1
};

/// The soft body of `mesh`: one particle per vertex, the springs of build_cloth, then those of interior_pairs that are
/// not among them; with a modulus, those of them that it needs. The body weighs surface.mass, whatever the factors.
/// Throws InputError on a mesh that is no solid (require_solid) or no cloth (build_cloth).
Structure build_soft_body(const Mesh& mesh, const SoftBodyOptions& options);

}  // namespace billow::sim
