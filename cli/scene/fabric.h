// Fabrics that a scene can name, as published measurements have them (docs/scene_format.md says whose).
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace billow::cli {

/// A fabric's stuff, the mean of warp and weft.
struct Fabric {
  std::string_view name;
  double area_density;  // [kg/m^2]
  double stretch;       // [N/m]    tensile modulus: force per width and strain of a strip that is pulled
  double shear;         // [N/m]    shear modulus: force per width and radian
  double bend;          // [N m]    flexural rigidity: moment per width and curvature
  double thickness;     // [m]
  double friction;      // Coulomb's, of it against its like
};

/// All of them, in the order in which messages list them.
std::span<const Fabric> fabrics();
/// Throws std::logic_error where none has that name.
const Fabric& fabric(std::string_view name);
/// The words of the key `fabric`: "none", then their names.
std::vector<std::string_view> fabric_words();

/// [N/m] of a square grid's edges, whose diagonals have `shear`, so that the sheet has the fabric's moduli
/// (docs/method.md).
double structural_stiffness(const Fabric& fabric);
/// [N/m] of bend springs over two edges of `edge` [m] each, which then take as much energy as the fabric where folds
/// have a radius of 2 cm: at most a tenth of the edges' stiffness, because they resist stretching as well.
double bend_stiffness(const Fabric& fabric, double edge);
/// [N m^2] of Choi and Ko's beams along the edges and diagonals of a square grid, which give it the flexural rigidity
/// `bend` [N m].
double beam_rigidity(double bend, double edge);

}  // namespace billow::cli
