// Levels against their theory: what F is, what it leaves alone, what it conserves, and the step that it is to allow.
#include "sim/filter/level_filter.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <cmath>

#include "base/error.h"
#include "base/random.h"
#include "sim/body/momenta.h"
#include "sim/filter/body_motion.h"
#include "sim/filter/filter.h"
#include "sim/filter/level_shares.h"
#include "sim/filter/spring_bound.h"
#include "sim/force/forces.h"
#include "sim/step/solver.h"
#include "tests/support/dense_levels.h"
#include "tests/support/evaluations.h"
#include "tests/support/filters.h"
#include "tests/support/level_bodies.h"
#include "tests/support/step_matrix.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

using Eigen::MatrixX3d, Eigen::MatrixXd, Eigen::VectorXd;
using test::light_cloth;
using test::shaken_state;

FilterOptions levels(double ratio) {
  return {.kernel = FilterKernel::levels, .target = FilterTarget::force, .ratio = ratio};
}

/// The given share of the particles, of the last of three levels the most.
FilterOptions given_levels(double correction) {
  FilterOptions options = levels(1.0);
  options.level_shares = {{{0.1, 0.2, 0.7}, correction}};
  return options;
}

MatrixXd weights(const Filter& filter, const Structure& structure) {
  return MatrixXd(filter.weights(structure.rest_position, 0.0));
}

std::vector<int> free_particles(const Structure& structure) {
  std::vector<int> free;
  for (int i = 0; i < structure.particles(); ++i)
    if (!structure.pinned(i)) free.push_back(i);
  return free;
}

/// Levels that were found, and some given with a correction of a half and a whole, on every sort of body.
template <class Check>
void for_every_filter(const Check& check) {
  for (const auto& [name, structure] : test::all_level_bodies())
    for (const FilterOptions& options : {levels(1.8), given_levels(0.0), given_levels(0.5), given_levels(1.0)}) {
      SCOPED_TRACE(testing::Message() << name << ", "
                                      << (options.level_shares.empty() ? -1.0 : options.level_shares[0].correction));
      check(structure, Filter(structure, options));
    }
}

// The sum as the header writes it, level by level.
MatrixXd sum_of_levels(const Structure& structure, const LevelShares& shares) {
  const std::vector<MatrixXd> p =
      test::interpolations(build_levels(structure, structure.body[0]), structure.particles());
  const VectorXd mass = free_mass(structure);
  MatrixXd sum = MatrixXd::Zero(p[0].rows(), p[0].rows());
  for (std::size_t l = 0; l < shares.gamma.size(); ++l) {
    const VectorXd d = p[l].transpose() * mass;
    const MatrixXd inverse = (d.array() > 0.0).select(d.array().inverse(), 0.0).matrix().asDiagonal();
    const double c = l > 0 && l + 1 == shares.gamma.size() ? shares.correction : 0.0;
    const MatrixXd middle = (1.0 + c) * inverse - c * inverse * (p[l].transpose() * mass.asDiagonal() * p[l]) * inverse;
    if (l > 0) sum += shares.gamma[l] * p[l] * middle * p[l].transpose() * mass.asDiagonal();
  }
  for (int i = 0; i < structure.particles(); ++i) sum(i, i) += structure.pinned(i) ? 1.0 : shares.gamma[0];
  return sum;
}

TEST(LevelFilter, IsTheSumOverLevelsThatItsHeaderWrites) {
  for_every_filter([](const Structure& structure, const Filter& filter) {
    const MatrixXd expected = sum_of_levels(structure, filter.options().level_shares[0]);
    EXPECT_LT((weights(filter, structure) - expected).norm(), 1e-13 * expected.norm());
  });
}

TEST(LevelFilter, RunsWhatItsWeightsSay) {
  for_every_filter([](const Structure& structure, const Filter& filter) {
    const LevelFilter bare(structure, filter.options());
    const MatrixX3d field = seeded_noise(structure.particles(), 3);
    MatrixX3d after = MatrixX3d::Constant(structure.particles(), 3, NAN);
    FilterScratch scratch;
    bare.run(columns_of(field, after), scratch);
    EXPECT_LT((after - weights(filter, structure) * field).norm(), 1e-12);
  });
}

/// Rigid motions of all particles (3n x 6), orthonormal in the masses' inner product: particle-major, like `wide`.
MatrixXd rigid_motions(const Structure& structure, const MatrixX3d& position, const VectorXd& root) {
  MatrixXd motion(3 * structure.particles(), 6);
  for (int i = 0; i < structure.particles(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis), at = position.row(i);
      motion.block<3, 1>(3 * i, axis) = root(i) * unit;
      motion.block<3, 1>(3 * i, 3 + axis) = root(i) * unit.cross(at);
    }
  return Eigen::HouseholderQR<MatrixXd>(motion).householderQ() * MatrixXd::Identity(motion.rows(), 6);
}

/// `matrix` on every axis alike.
MatrixXd wide(const MatrixXd& matrix) {
  MatrixXd result = MatrixXd::Zero(3 * matrix.rows(), 3 * matrix.cols());
  for (int r = 0; r < matrix.rows(); ++r)
    for (int c = 0; c < matrix.cols(); ++c) result.block<3, 3>(3 * r, 3 * c).diagonal().setConstant(matrix(r, c));
  return result;
}

/// M^1/2 F M^-1/2 over the free particles: symmetric.
MatrixXd scaled_weights(const Structure& structure, const Filter& filter) {
  const std::vector<int> free = free_particles(structure);
  const VectorXd root = structure.mass(free).cwiseSqrt();
  return root.asDiagonal() * weights(filter, structure)(free, free) * root.cwiseInverse().asDiagonal();
}

/// The same on all axes, and with rigid motions of a free body as they are.
MatrixXd whole_filter(const Structure& structure, const Filter& filter, const MatrixX3d& position) {
  MatrixXd f = wide(scaled_weights(structure, filter));
  if (!is_free(structure, structure.body[0])) return f;
  const MatrixXd p = rigid_motions(structure, position, structure.mass.cwiseSqrt());
  f -= p * (p.transpose() * f);
  f -= (f * p) * p.transpose();
  return f + p * p.transpose();
}

VectorXd flat(const Structure& structure, const MatrixX3d& field) {
  const std::vector<int> free = free_particles(structure);
  VectorXd result(3 * static_cast<int>(free.size()));
  for (std::size_t k = 0; k < free.size(); ++k)
    result.segment<3>(3 * static_cast<int>(k)) = std::sqrt(structure.mass(free[k])) * field.row(free[k]).transpose();
  return result;
}

TEST(LevelFilter, AppliesThemWithRigidMotionsOfFreeBodiesAsTheyAre) {
  for_every_filter([](const Structure& structure, const Filter& filter) {
    const MatrixX3d position = shaken_state(structure, 0.05, 0.0).position;
    MatrixX3d field = seeded_noise(structure.particles(), 4);
    const VectorXd expected = whole_filter(structure, filter, position) * flat(structure, field);
    test::apply(filter, position, 0.0, field);
    EXPECT_LT((flat(structure, field) - expected).norm(), 1e-12 * expected.norm());
  });
}

TEST(LevelFilter, IsSelfAdjointWithItsSpectrumFromTheParticlesShareToOne) {
  for_every_filter([](const Structure& structure, const Filter& filter) {
    const MatrixXd f = scaled_weights(structure, filter);
    EXPECT_LT((f - f.transpose()).norm(), 1e-13);
    const double share = filter.options().level_shares[0].gamma[0];
    EXPECT_GT(share, 0.0);
    EXPECT_GE(test::least_eigenvalue(f), share - 1e-13);
    EXPECT_LE(-test::least_eigenvalue(-f), 1.0 + 1e-13);
    EXPECT_TRUE(filter.self_adjoint() && filter.nonnegative() && filter.constant_weights());
    EXPECT_LT((weights(filter.adjoint(), structure) - weights(filter, structure)).norm(), 1e-15);
    EXPECT_LT((weights(filter.frozen(1.0), structure) - weights(filter, structure)).norm(), 1e-15);
  });
}

// Gravity among them: what hangs from pins falls no slower.
TEST(LevelFilter, LetsAConstantAccelerationOfTheFreeParticlesPassAsItIs) {
  for_every_filter([](const Structure& structure, const Filter& filter) {
    const MatrixX3d constant = structure.inverse_mass.cwiseSign() * Eigen::RowVector3d(1.0, -9.81, 3.0);
    MatrixX3d after = constant;
    test::apply(filter, structure.rest_position, 0.0, after);
    EXPECT_LT((after - constant).cwiseAbs().maxCoeff(), 1e-13);
  });
}

TEST(LevelFilter, NeverChangesAPinnedParticleNorCountsIt) {
  for (const auto& [name, structure] : test::pinned_level_bodies())
    for (const double correction : {0.0, 0.5}) {
      SCOPED_TRACE(name);
      const Filter filter(structure, given_levels(correction));
      MatrixX3d one = seeded_noise(structure.particles(), 3), other = one;
      for (int i = 0; i < structure.particles(); ++i)
        if (structure.pinned(i)) other.row(i) << 7.0, -8.0, 9.0;
      const MatrixX3d before = other;
      test::apply(filter, structure.rest_position, 0.0, one);
      test::apply(filter, structure.rest_position, 0.0, other);
      for (int i = 0; i < structure.particles(); ++i)
        EXPECT_EQ(other.row(i), (structure.pinned(i) ? before : one).row(i)) << i;
    }
}

void expect_same_momenta(const Structure& structure, const Body& body, const MatrixX3d& position,
                         const MatrixX3d& before, const MatrixX3d& after) {
  const BodyMotion was = body_motion(structure, body, position, before),
                   is = body_motion(structure, body, position, after);
  double linear = 0.0, angular = 0.0;  // what the particles' momenta sum to without their signs
  for (int i = body.first_particle; i < body.first_particle + body.particles; ++i) {
    linear += structure.mass(i) * before.row(i).norm();
    angular += structure.mass(i) * before.row(i).norm() * (position.row(i).transpose() - was.centre).norm();
  }
  EXPECT_LT((is.linear - was.linear).norm(), 1e-12 * linear);
  EXPECT_LT((is.angular - was.angular).norm(), 1e-12 * angular);
}

TEST(LevelFilter, KeepsBothMomentaOfEveryFreeBodyOnItsOwn) {
  std::vector<Structure> structures;
  for (const auto& [name, structure] : test::free_level_bodies()) structures.push_back(structure);
  structures.push_back(merge(structures));
  structures.push_back(merge({structures[0], test::pinned_level_bodies()[0].structure, structures[2]}));
  for (const Structure& structure : structures) {
    const Filter filter(structure, levels(3.0));
    const MatrixX3d position = shaken_state(structure, 0.2, 0.0).position,
                    before = seeded_noise(structure.particles(), 5);
    MatrixX3d after = before;
    test::apply(filter, position, 0.0, after);
    EXPECT_GT((after - before).norm(), 0.1 * before.norm()) << "it must filter";
    for (const Body& body : structure.body)
      if (is_free(structure, body)) expect_same_momenta(structure, body, position, before, after);
  }
}

/// The largest eigenvalue of F M^-1 K, both as M^1/2 ( ) M^-1/2: with F = C C^T that of C^T M^-1/2 K M^-1/2 C.
double largest_eigenvalue_of(const MatrixXd& f, const MatrixXd& k) {
  const Eigen::LLT<MatrixXd> root(f);
  EXPECT_EQ(root.info(), Eigen::Success) << "a filter without an inverse";
  const MatrixXd c = root.matrixL();
  return -test::least_eigenvalue(-(c.transpose() * k * c));
}

/// M^-1/2 L M^-1/2 of the free particles.
MatrixXd bound_of(const Structure& structure) {
  const std::vector<int> free = free_particles(structure);
  const VectorXd inverse_root = structure.inverse_mass(free).cwiseSqrt();
  return inverse_root.asDiagonal() * MatrixXd(spring_bound(structure))(free, free) * inverse_root.asDiagonal();
}

constexpr double of_eigenvalues = 2.1e-3;  // the error that find_level_shares lets its eigenvalues have

// What makes the step `ratio` times as long at any shape, and no more of it than that takes.
TEST(LevelShares, BoundTheStiffnessByTheUnfilteredOverTheSquaredRatioAndHardlyMore) {
  for (const auto& [name, structure] : test::all_level_bodies())
    for (const double ratio : {1.1, 2.0, 3.0, 6.0}) {
      SCOPED_TRACE(testing::Message() << name << ", ratio " << ratio);
      const MatrixXd bound = bound_of(structure);
      const Filter filter(structure, levels(ratio));
      const double most = -test::least_eigenvalue(-bound) / (ratio * ratio),
                   found = largest_eigenvalue_of(scaled_weights(structure, filter), bound);
      EXPECT_LE(found, most * (1.0 + of_eigenvalues));
      // Where the last level is not taken at all, the others need nothing of it.
      if (filter.options().level_shares[0].gamma.back() > 1e-12) {
        EXPECT_GE(found, most * 0.99) << "weaker levels would do";
      }
    }
}

/// M^-1/2 K M^-1/2 of the free particles at `state`, which need not be definite.
MatrixXd stiffness_at(const Structure& structure, const State& state) {
  const Forces forces(structure, Eigen::Vector3d::Zero());
  MatrixXd k = test::dense_dynamics(structure, forces.linearise(state, 1.0, 0.0, JacobianForm::exact));
  const std::vector<int> free = free_particles(structure);
  for (int r = 0; r < k.rows(); ++r)
    for (int c = 0; c < k.cols(); ++c) k(r, c) *= std::sqrt(structure.mass(free[r / 3]) / structure.mass(free[c / 3]));
  return k;
}

// Compressed springs make K indefinite; what is stretched to several times its length comes nearest to the bound.
TEST(LevelShares, BoundTheTrueStiffnessAtCrumpledShapesToo) {
  for (const auto& [name, structure] : test::all_level_bodies()) {
    const double unfiltered = -test::least_eigenvalue(-bound_of(structure));
    const Filter filter(structure, levels(3.0));
    for (const double distance : {0.3, 2.0}) {
      SCOPED_TRACE(testing::Message() << name << ", " << distance);
      const State state = shaken_state(structure, distance * structure.body[0].mean_rest_length, 0.0);
      const MatrixXd k = stiffness_at(structure, state);
      const double most = unfiltered / 9.0 * (1.0 + of_eigenvalues);
      EXPECT_LE(largest_eigenvalue_of(wide(scaled_weights(structure, filter)), k), most);
      if (distance > 1.0) continue;
      EXPECT_LT(test::least_eigenvalue(k), -1e-3 * unfiltered) << "it must be crumpled";
      // Rigid motions, which pass unfiltered, are smooth where the body still is roughly what it was.
      EXPECT_LE(largest_eigenvalue_of(whole_filter(structure, filter, state.position), k), most);
    }
  }
}

TEST(LevelShares, LeaveABodyAloneThatIsSofterThanTheBound) {
  const Structure stiff = light_cloth(8, 8), soft = test::grid({.width = 6, .height = 6}),
                  between = test::grid({.width = 8, .height = 8, .mass = 0.01, .structural = 25.0, .shear = 17.0});
  const Structure all = merge({stiff, soft, between});
  const Filter filter(all, levels(4.0));
  const std::vector<LevelShares>& shares = filter.options().level_shares;
  EXPECT_EQ(shares[0].gamma, Filter(stiff, levels(4.0)).options().level_shares[0].gamma) << "as if it were alone";
  EXPECT_EQ(shares[1].gamma, std::vector<double>{1.0});
  EXPECT_GT(shares[2].gamma.size(), 1u);
  EXPECT_GT(shares[2].gamma[0], 1.5 * shares[0].gamma[0]) << "it needs less";
  const std::vector<LevelTable> table = filter.levels();
  EXPECT_EQ(table[1].nodes, std::vector<int>{36});
  EXPECT_EQ((std::vector<int>{table[0].nodes[0], table[0].nodes[1]}), (std::vector<int>{64, 16}));
  const MatrixX3d field = seeded_noise(all.particles(), 6);
  MatrixX3d after = MatrixX3d::Zero(all.particles(), 3);
  FilterScratch scratch;
  LevelFilter(all, filter.options()).run(columns_of(field, after), scratch);
  EXPECT_EQ(after.middleRows(64, 36), field.middleRows(64, 36));
}

TEST(LevelShares, OfRatioOneAreTheIdentity) {
  for (const auto& [name, structure] : test::all_level_bodies()) {
    SCOPED_TRACE(name);
    const Filter filter(structure, levels(1.0));
    EXPECT_EQ(filter.options().level_shares[0].gamma, std::vector<double>{1.0});
    EXPECT_EQ(weights(filter, structure), MatrixXd::Identity(structure.particles(), structure.particles()));
  }
}

TEST(LevelShares, SumToOneAndAreGivenBackAsTheyWereGiven) {
  for_every_filter([](const Structure& structure, const Filter& filter) {
    const LevelShares& shares = filter.options().level_shares[0];
    double sum = 0.0;
    for (const double gamma : shares.gamma) {
      EXPECT_GE(gamma, 0.0);
      sum += gamma;
    }
    EXPECT_NEAR(sum, 1.0, 1e-14);
    EXPECT_GE(shares.correction, 0.0);
    EXPECT_LE(shares.correction, 1.0);
    const Filter again(structure, filter.options());
    EXPECT_EQ(weights(again, structure), weights(filter, structure));
  });
}

std::string error_of(const Structure& structure, double ratio) {
  try {
    const Filter filter(structure, levels(ratio));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(LevelShares, AreRefusedWhereNoLevelReachesTheRatio) {
  const Structure held = light_cloth(8, 8, {0, 7});
  const std::string refusal = error_of(held, 100.0), begin = "levels of 'body' allow at most ";
  ASSERT_TRUE(refusal.starts_with(begin)) << refusal;
  EXPECT_TRUE(refusal.ends_with(" times the unfiltered step; use a smaller ratio or step")) << refusal;
  const double most = std::stod(refusal.substr(begin.size()));
  EXPECT_GT(most, 1.0);
  EXPECT_EQ(error_of(held, most), "") << "what it says is there";
  EXPECT_EQ(error_of(light_cloth(8, 8), 100.0), "") << "a free body's last level feels no spring";
  for (const double ratio : {0.999, -3.0, static_cast<double>(NAN), static_cast<double>(INFINITY)})
    EXPECT_EQ(error_of(held, ratio), "the filter's ratio must be a number of at least 1") << ratio;
}

TEST(LevelShares, AreFoundWhereNothingIsThereToFilter) {
  Structure held = light_cloth(4, 3);
  held.inverse_mass.setZero();
  const Structure both = merge({held, light_cloth(6, 6)});
  const Filter filter(both, levels(3.0));
  MatrixX3d field = seeded_noise(both.particles(), 2);
  const MatrixX3d before = field;
  test::apply(filter, both.rest_position, 0.0, field);
  EXPECT_EQ(field.topRows(12), before.topRows(12));
  EXPECT_TRUE(field.allFinite());
}

TEST(LevelFilter, MovesAndKicksByWhatItApplies) {
  for_every_filter([](const Structure& structure, const Filter& filter) {
    test::expect_moves_and_kicks_as_applied(filter, structure, shaken_state(structure, 0.01, 1.0));
  });
}

// What acts on one particle and knows its mass alone, as an impulse of contact does, puts in more energy than that mass
// says: in the filtered motion v^T M F^-1 v / 2 counts, and the springs get it all.
TEST(LevelFilter, ABlowWeighsAsMuchAsTheFilteredMotionDoes) {
  const Structure cloth = test::light_cloth(12, 12);
  const Forces forces(cloth, Eigen::Vector3d::Zero());
  const auto gain = [&](const std::optional<FilterOptions>& filter) {
    State struck = rest_state(cloth);
    struck.velocity(5 * 12 + 6, 0) = 0.01;
    const double blow = kinetic_energy(cloth, struck);
    Solver solver(cloth, forces, {.method = Method::verlet, .filter = filter, .step = 2e-4}, struck);
    double most = 0.0;
    for (int k = 0; k < 4000; ++k) {
      solver.advance();
      most = std::max(most, kinetic_energy(cloth, solver.state()) + forces.potential_energy(solver.state()));
    }
    return most / blow;
  };
  EXPECT_NEAR(gain({}), 1.0, 1e-3);
  EXPECT_GT(gain(levels(3.0)), 4.0);
  EXPECT_GT(gain(levels(6.0)), 16.0);
}

}  // namespace
}  // namespace billow::sim
