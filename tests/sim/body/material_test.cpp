// The same material by meshes of any fineness: sheets that are pulled, sheared and rolled up, solids that hang, against
// the closed forms of elasticity.
#include <gtest/gtest.h>

#include <numbers>

#include "sim/body/soft_body.h"
#include "sim/body/spring_law.h"
#include "sim/mesh/closed_surface.h"
#include "tests/support/refined_meshes.h"
#include "tests/support/statics.h"

namespace billow::sim {
namespace {

using test::Weave;

constexpr Weave weaves[] = {Weave::squares, Weave::cut_squares, Weave::offset_rows, Weave::shaken_squares,
                            Weave::shaken_triangles};

Structure cloth_of(const Mesh& mesh, const SheetMaterial& material) {
  return build_cloth(mesh, {.mass = 1.0, .material = material});
}

// ---- sheets that are pulled ----

constexpr double length = 2.0, width = 1.0, stretch = 100.0, strain = 1e-3;

// Force per width and strain of a strip whose ends stay straight and free to narrow.
double pulled_modulus(const Mesh& mesh, const MembraneModuli& moduli) {
  const Structure cloth = cloth_of(mesh, {moduli});
  test::Loading loading = test::no_load(cloth);
  loading.held.col(2) = true;
  loading.held(0, 1) = true;
  for (int i = 0; i < cloth.particles(); ++i) {
    const double x = cloth.rest_position(i, 0);
    if (x > 0.0 && x < length) continue;
    loading.held(i, 0) = true;
    loading.displacement(i, 0) = strain * x;
  }
  const Eigen::MatrixX3d force = test::holding_forces(cloth, test::displacements(cloth, loading));
  double pull = 0.0;
  for (int i = 0; i < cloth.particles(); ++i)
    if (cloth.rest_position(i, 0) == length) pull += force(i, 0);
  return pull / (width * strain);
}

TEST(Material, AStripStretchesAlikeAtAnyResolution) {
  for (const Weave weave : weaves)
    for (const int across : {4, 8, 16, 32}) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(weave) << " by " << across);
      const double modulus = pulled_modulus(test::sheet(weave, length, width, across), isotropic_membrane(stretch));
      // Shaken quads give way by more: what their edges and diagonals lack only negative springs could give.
      EXPECT_NEAR(modulus / stretch, 1.0, weave == Weave::shaken_squares ? 0.11 : 0.05);
      RecordProperty("strip_" + std::to_string(static_cast<int>(weave)) + "_" + std::to_string(across),
                     std::to_string(modulus / stretch));
    }
}

TEST(Material, ASheetOfSquaresHasBothModuli) {
  for (const double shear : {10.0, 37.5, 60.0}) {
    EXPECT_NEAR(pulled_modulus(test::sheet(Weave::squares, length, width, 8), {stretch, shear}) / stretch, 1.0, 0.02);
    // Under u_x = g y all springs but diagonals keep their length; borders take a little off what these should be.
    const Structure cloth = cloth_of(test::sheet(Weave::squares, length, width, 8), {{stretch, shear}});
    Eigen::MatrixX3d sheared = Eigen::MatrixX3d::Zero(cloth.particles(), 3);
    sheared.col(0) = strain * cloth.rest_position.col(1);
    const double energy = 0.5 * sheared.cwiseProduct(test::holding_forces(cloth, sheared)).sum();
    EXPECT_NEAR(energy / (0.5 * shear * strain * strain * length * width), 1.0, 0.03);
  }
}

// ---- sheets that are rolled up ----

double energy(const Structure& structure, const Eigen::MatrixX3d& position) {
  double sum = 0.0;
  for (int s = 0; s < structure.springs(); ++s)
    sum += linear_energy((position.row(structure.spring(s, 1)) - position.row(structure.spring(s, 0))).norm(),
                         structure.rest_length(s), structure.stiffness(s));
  return sum;
}

// Rolled around an axis square to `angle`.
Eigen::MatrixX3d rolled(const Eigen::MatrixX3d& flat, double angle, double radius) {
  Eigen::MatrixX3d position = flat;
  const Eigen::RowVector3d way(std::cos(angle), std::sin(angle), 0.0);
  for (Eigen::Index i = 0; i < flat.rows(); ++i) {
    const double along = flat.row(i).dot(way);
    position.row(i) += (radius * std::sin(along / radius) - along) * way;
    position(i, 2) = radius * (1.0 - std::cos(along / radius));
  }
  return position;
}

// Hinges bend around vertices, so that half a cell at both ends of the roll stays flat, and more of a corner.
TEST(Material, ARolledSheetHasTheEnergyOfItsRigidity) {
  const double bend = 1e-4, radius = 100.0;
  for (const Weave weave : weaves)
    for (const int across : {4, 8, 16, 32}) {
      const Structure cloth = cloth_of(test::sheet(weave, 1.0, 1.0, across), {isotropic_membrane(stretch), bend});
      for (const double angle : {0.0, 0.25 * std::numbers::pi, 0.5 * std::numbers::pi}) {
        SCOPED_TRACE(testing::Message() << static_cast<int>(weave) << " by " << across << " at " << angle);
        const double gained =
            energy(cloth, rolled(cloth.rest_position, angle, radius)) - energy(cloth, cloth.rest_position);
        const double ratio = gained / (bend / (2.0 * radius * radius));
        if (angle == 0.25 * std::numbers::pi) {
          EXPECT_GT(ratio, 1.0 - 1.6 / across - 0.03);
          EXPECT_LT(ratio, 1.03);
        } else {
          EXPECT_NEAR(ratio / (1.0 - 1.0 / across), 1.0, across == 4 ? 0.08 : 0.03);
        }
        RecordProperty("roll_" + std::to_string(static_cast<int>(weave)) + "_" + std::to_string(across) + "_" +
                           std::to_string(std::lround(angle * 180.0 / std::numbers::pi)),
                       std::to_string(ratio));
      }
    }
}

TEST(Material, AFlatSheetIsInBalance) {
  for (const Weave weave : weaves) {
    const Structure cloth = cloth_of(test::sheet(weave, 1.0, 1.0, 8), {isotropic_membrane(stretch), 1e-4});
    Eigen::MatrixX3d force = Eigen::MatrixX3d::Zero(cloth.particles(), 3);
    double largest = 0.0;
    for (int s = 0; s < cloth.springs(); ++s) {
      const int i = cloth.spring(s, 0), j = cloth.spring(s, 1);
      const Eigen::RowVector3d way = cloth.rest_position.row(j) - cloth.rest_position.row(i);
      const double tension = cloth.stiffness(s) * (way.norm() - cloth.rest_length(s));
      force.row(i) += tension * way.normalized();
      force.row(j) -= tension * way.normalized();
      largest = std::max(largest, std::abs(tension));
    }
    EXPECT_GT(largest, 0.0);
    EXPECT_LT(force.cwiseAbs().maxCoeff(), 1e-3 * largest) << static_cast<int>(weave);
  }
}

// ---- solids ----

constexpr double young = 1e3;

Structure solid_of(const Mesh& mesh) {
  SoftBodyOptions options;
  options.young = young;
  return build_soft_body(mesh, options);
}

// A ball of 1 kg that hangs by its cap down to y = 1/2, where the coarsest of the meshes has vertices as well.
TEST(Material, ABallHangsAlikeAtAnyResolution) {
  double least = INFINITY, most = 0.0;
  for (const int times : {1, 2, 3, 4}) {
    const Structure ball = solid_of(test::sphere(times));
    test::Loading loading = test::no_load(ball);
    loading.force.col(1) = -9.81 * ball.mass;
    for (int i = 0; i < ball.particles(); ++i)
      if (ball.rest_position(i, 1) > 0.499) loading.held.row(i) = true;
    const double sag = -test::displacements(ball, loading).col(1).dot(ball.mass);
    RecordProperty("sag_" + std::to_string(ball.particles()), std::to_string(sag));
    least = std::min(least, sag), most = std::max(most, sag);
  }
  EXPECT_LT(most / least, 1.05);
}

// Pulled at its surface by s n_y along y it has the stress s and the strain s / E everywhere.
TEST(Material, ABallStretchesAsElasticitySays) {
  for (const int times : {1, 2, 3, 4}) {
    const Mesh mesh = test::sphere(times);
    const Structure ball = solid_of(mesh);
    test::Loading loading = test::no_load(ball);
    const double stress = 1.0;
    for (const Face& face : mesh.face) {
      const Eigen::Vector3d a = mesh.position.row(face[0]), b = mesh.position.row(face[1]),
                            c = mesh.position.row(face[2]);
      for (int k = 0; k < 3; ++k) loading.force(face[k], 1) += stress * (b - a).cross(c - a).y() / 6.0;
    }
    // Six axes of three vertices, so that it cannot move as a whole.
    loading.held.row(0) = true;
    loading.held(3, 0) = loading.held(3, 2) = loading.held(4, 0) = true;
    const Eigen::MatrixX3d u = test::displacements(ball, loading);
    const double work = u.cwiseProduct(loading.force).sum();
    EXPECT_NEAR(work / (stress * stress / young * enclosed_volume(mesh)), 1.0, 0.02) << times;
    RecordProperty("stretch_" + std::to_string(ball.particles()),
                   std::to_string(work / (stress * stress / young * enclosed_volume(mesh))));
  }
}

// u = rho g L^2 / (2 E) at the lower end.
double hanging_ratio(const Eigen::Vector3i& size, int fineness) {
  const Structure bar = solid_of(test::box(size, fineness));
  test::Loading loading = test::no_load(bar);
  loading.force.col(0) = bar.mass;
  double tip = 0.0, weight = 0.0;
  for (int i = 0; i < bar.particles(); ++i)
    if (bar.rest_position(i, 0) == 0.0) {
      loading.held(i, 0) = true;
      if (bar.rest_position(i, 1) == 0.0 && bar.rest_position(i, 2) == 0.0) loading.held.row(i) = true;
      if (bar.rest_position(i, 1) == 0.0 && bar.rest_position(i, 2) == size.z()) loading.held(i, 1) = true;
    }
  const Eigen::MatrixX3d u = test::displacements(bar, loading);
  for (int i = 0; i < bar.particles(); ++i)
    if (bar.rest_position(i, 0) == size.x()) tip += bar.mass(i) * u(i, 0), weight += bar.mass(i);
  const double area = size.y() * size.z();
  return tip / weight / (bar.mass.sum() / area * size.x() / (2.0 * young));
}

TEST(Material, ABarHangsAsLongAsItsModulusSays) {
  for (const int fineness : {1, 2, 4, 8}) {
    const double bar = hanging_ratio({4, 1, 1}, fineness), cube = hanging_ratio({1, 1, 1}, fineness);
    EXPECT_NEAR(bar, 1.0, 0.05) << fineness;
    EXPECT_NEAR(cube, 1.0, 0.1) << fineness;
    RecordProperty("bar_" + std::to_string(fineness), std::to_string(bar));
    RecordProperty("cube_" + std::to_string(fineness), std::to_string(cube));
  }
}

}  // namespace
}  // namespace billow::sim
