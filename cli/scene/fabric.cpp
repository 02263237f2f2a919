// A table of fabrics, and what springs they make. Moduli of the first four follow Clyde, Teran & Tamstorf 2017 as
// strips: E = a11 - a12^2 / a22, mean of warp and weft, and G = G12 / 2.
#include "cli/scene/fabric.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "sim/body/membrane_springs.h"

namespace billow::cli {

namespace {

constexpr Fabric table[] = {
    {"cotton", 0.104, 3080.0, 97.0, 5e-6, 0.18e-3, 0.5},    // a plain weave
    {"silk", 0.083, 540.0, 51.0, 3e-6, 0.18e-3, 0.3},       // charmeuse
    {"denim", 0.400, 2410.0, 810.0, 1.7e-5, 0.66e-3, 0.5},  // a twill
    {"wool", 0.481, 2140.0, 240.0, 3e-5, 1.28e-3, 0.5},     // coating
    {"leather", 0.48, 3000.0, 1100.0, 1e-4, 0.8e-3, 0.6},   // sheep, of garments
};

// At which bend springs, whose energy grows with its fourth power, have the energy of the fabric's, which grows with
// its square.
constexpr double fold_curvature = 50.0;  // [1/m]

constexpr double most_bend = 0.1;  // of the edges' stiffness

}  // namespace

std::span<const Fabric> fabrics() { return table; }

const Fabric& fabric(std::string_view name) {
  for (const Fabric& f : table)
    if (f.name == name) return f;
  throw std::logic_error("no fabric is called " + std::string(name));
}

std::vector<std::string_view> fabric_words() {
  std::vector<std::string_view> words{"none"};
  for (const Fabric& f : table) words.push_back(f.name);
  return words;
}

double structural_stiffness(const Fabric& fabric) { return sim::edge_stiffness({fabric.stretch, fabric.shear}); }

// Two edges of length l that turn by phi = kappa l leave 2 l cos(phi/2) between their far ends, l phi^2 / 4 less than
// at rest: k (l phi^2)^2 / 32 for a spring there, of which each l^2 has one a direction, where the fabric has
// B kappa^2 l^2 / 2.
double bend_stiffness(const Fabric& fabric, double edge) {
  const double turn = fold_curvature * edge;
  return std::min(16.0 * fabric.bend / (turn * turn * edge * edge), most_bend * structural_stiffness(fabric));
}

// Rolled up along an edge, each l^2 has a beam of length 2 l at the curvature kappa and two of 2 sqrt(2) l at kappa /
// 2: EI kappa^2 l (1 + 1 / sqrt 2) in all, where the fabric has B kappa^2 l^2 / 2.
double beam_rigidity(double bend, double edge) { return bend * edge / (2.0 + std::sqrt(2.0)); }

}  // namespace billow::cli
