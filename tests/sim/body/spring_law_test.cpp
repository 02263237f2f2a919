// The spring laws against their derivations: inverse sinc, Choi & Ko's buckled beam, slopes and energies.
#include "sim/body/spring_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace billow::sim {
namespace {

constexpr double pi = std::numbers::pi;

double sinc(double a) { return std::sin(a) / a; }

TEST(InverseSinc, UndoesSincTo1e12) {
  for (int k = 1; k < 2000; ++k) {
    const double a = pi * k / 2000.0;
    EXPECT_NEAR(inverse_sinc(sinc(a)), a, 1e-12 * std::max(1.0, 0.1 / a)) << "A = " << a;
  }
}

// Near 0, sinc is so flat that A cannot be known to 1e-12 from a rounded ratio; the ratio can.
TEST(InverseSinc, SolvesItsEquationToRoundingOverTheWholeRange) {
  for (const double tiny : {1e-15, 1e-12, 1e-9, 1e-6, 1e-3}) {
    EXPECT_NEAR(sinc(inverse_sinc(1.0 - tiny)), 1.0 - tiny, 3e-16) << tiny;
    EXPECT_NEAR(inverse_sinc(tiny), pi * (1.0 - tiny + tiny * tiny), 9.0 * tiny * tiny * tiny + 1e-15) << tiny;
  }
  for (int k = 1; k < 1000; ++k) EXPECT_NEAR(sinc(inverse_sinc(k / 1000.0)), k / 1000.0, 5e-16) << k;
}

TEST(InverseSinc, EndsAtAStraightBeamAndAtAClosedRing) {
  EXPECT_EQ(inverse_sinc(1.0), 0.0);
  EXPECT_EQ(inverse_sinc(1.5), 0.0);
  EXPECT_EQ(inverse_sinc(0.0), pi);
  EXPECT_EQ(inverse_sinc(-0.5), pi);
}

/// A beam that buckles almost at once: its straight branch holds over a ten-thousandth of its length.
struct Beam {
  double length = 0.2, stiffness = 4e4, rigidity = 3e-3;
  double scale() const { return 4.0 * rigidity / (length * length); }
  Tension tension(double l) const { return buckling_tension(l, length, stiffness, rigidity); }
  double energy(double l) const { return buckling_energy(l, length, stiffness, rigidity); }
};

// T = A^2 / (cos A - sin A / A) falls from -3 (straight) to -pi^2 (ends together).
TEST(Buckling, NumberRunsFromMinusThreeToMinusPiSquared) {
  const Beam beam;
  double last = -pi * pi;
  for (int k = 1; k < 999; ++k) {
    const double t = beam.tension(beam.length * k / 1000.0).force / beam.scale();
    EXPECT_GE(t, last) << "weaker the less it is bent, k = " << k;
    EXPECT_LE(t, -3.0);
    last = t;
  }
  EXPECT_NEAR(beam.tension(1e-12).force / beam.scale(), -pi * pi, 1e-9);
  EXPECT_NEAR(beam.tension(beam.length * (1.0 - 1e-3)).force / beam.scale(), -3.0, 0.002);
}

TEST(Buckling, ForceIsThePapersFormula) {
  const Beam beam;
  for (const double a : {0.3, 1.0, 2.0, 2.8, 3.1}) {
    const double expected = beam.scale() * a * a / (std::cos(a) - std::sin(a) / a);
    EXPECT_NEAR(beam.tension(beam.length * sinc(a)).force, expected, 1e-12 * std::abs(expected));
  }
}

TEST(Buckling, NothingActsOnceStretched) {
  const Beam beam;
  for (const double l : {beam.length, 1.001 * beam.length, 5.0 * beam.length}) {
    EXPECT_EQ(beam.tension(l).force, 0.0);
    EXPECT_EQ(beam.tension(l).slope, 0.0);
    EXPECT_EQ(beam.energy(l), 0.0);
  }
}

/// Rigidities from a thread to a rod: the last beams are straight over part or all of their range.
std::vector<Beam> beams() {
  std::vector<Beam> list;
  for (const double ratio : {1e-6, 1e-3, 0.1, 0.3, 0.9, 1.02, 1.1, 1.5, 4.0}) {  // 4 k_b pi^2 / (c_b L^3)
    Beam beam;
    beam.rigidity = ratio * beam.stiffness * std::pow(beam.length, 3) / (4.0 * pi * pi);
    list.push_back(beam);
  }
  return list;
}

TEST(Buckling, ForceIsTheLargerOfBothBranchesAndContinuousBetweenThem) {
  for (const Beam& beam : beams()) {
    SCOPED_TRACE(beam.rigidity);
    double last = beam.tension(beam.length * 1e-4).force;
    for (int k = 2; k <= 10000; ++k) {
      const double l = beam.length * k * 1e-4, a = inverse_sinc(l / beam.length);
      const double straight = beam.stiffness * (l - beam.length);
      const double buckled = beam.scale() * (a < 0.01 ? -3.0 - 0.3 * a * a : a * a / (std::cos(a) - sinc(a)));
      const double force = k == 10000 ? 0.0 : std::max(straight, buckled);
      ASSERT_NEAR(beam.tension(l).force, force, 1e-9 * beam.scale() + 1e-12 * beam.stiffness) << "l/L = " << k * 1e-4;
      const double steepest = std::max(beam.stiffness, 3.0 * pi * pi * beam.scale() / beam.length);
      ASSERT_LE(std::abs(force - last), 1.01e-4 * beam.length * steepest + 1e-12) << "l/L = " << k * 1e-4;
      last = force;
    }
  }
}

TEST(Buckling, ForceIsTheDerivativeOfTheEnergy) {
  for (const Beam& beam : beams()) {
    SCOPED_TRACE(beam.rigidity);
    for (int k = 1; k < 100; ++k) {
      const double l = beam.length * k / 100.0, d = 1e-4 * std::min(l, beam.length - l);
      const double difference =
          (8.0 * (beam.energy(l + d) - beam.energy(l - d)) - (beam.energy(l + 2.0 * d) - beam.energy(l - 2.0 * d))) /
          (12.0 * d);
      EXPECT_NEAR(difference, beam.tension(l).force, 1e-6 * std::abs(beam.tension(l).force)) << "l/L = " << k / 100.0;
    }
  }
}

// Up to a constant, the energy of the arc: 1/2 k_b L kappa^2, kappa = 2 A / L.
TEST(Buckling, EnergyIsThatOfACircularArc) {
  const Beam beam;
  const auto arc = [&](double l) {
    const double curvature = 2.0 * inverse_sinc(l / beam.length) / beam.length;
    return 0.5 * beam.rigidity * beam.length * curvature * curvature;
  };
  const double expected = arc(0.3 * beam.length) - arc(0.8 * beam.length);
  EXPECT_NEAR(beam.energy(0.3 * beam.length) - beam.energy(0.8 * beam.length), expected, 1e-10 * expected);
}

// The slope jumps where the branches meet; elsewhere it is the derivative.
TEST(Buckling, SlopeIsTheDerivativeOfTheForce) {
  for (const Beam& beam : beams()) {
    SCOPED_TRACE(beam.rigidity);
    int kinks = 0;
    for (int k = 1; k < 200; ++k) {
      const double l = beam.length * k / 200.0, d = 1e-5 * std::min(l, beam.length - l);
      const double difference = (beam.tension(l + d).force - beam.tension(l - d).force) / (2.0 * d);
      const double error = std::abs(difference - beam.tension(l).slope);
      kinks += error > 1e-5 * std::abs(difference);
      EXPECT_GT(beam.tension(l).slope, 0.0);
    }
    EXPECT_LE(kinks, 2);
  }
}

TEST(Buckling, SlopeIsNowhereSteeperThanTheSteepest) {
  for (const Beam& beam : beams()) {
    const double steepest = steepest_buckling_slope(beam.length, beam.stiffness, beam.rigidity);
    double found = beam.tension(beam.length * (1.0 - 1e-9)).slope;
    for (int k = 1; k < 20000; ++k) found = std::max(found, beam.tension(beam.length * k / 20000.0).slope);
    EXPECT_LE(found, steepest * (1.0 + 1e-12)) << beam.rigidity;
    EXPECT_GE(found, steepest * 0.999) << beam.rigidity;
  }
}

TEST(Buckling, SlopeIsSmoothWhereTheSeriesTakesOver) {
  Beam beam;
  beam.rigidity = 1e-9;
  for (const double a : {0.3, 0.05 * 1.001, 0.05 * 0.999, 0.02 * 1.001, 0.02 * 0.999, 0.005}) {
    const double l = beam.length * sinc(a);
    const double expected = 1.8 * (1.0 + a * a * (27.0 / 210.0 + 0.1)) * beam.scale() / beam.length;
    EXPECT_NEAR(beam.tension(l).slope, expected, (0.02 * a * a + 2e-9 / (a * a)) * expected) << "A = " << a;
  }
}

TEST(ChoiKo, SequentialConnectionsOnlyPull) {
  EXPECT_EQ(stretch_tension(0.9, 1.0, 50.0).force, 0.0);
  EXPECT_EQ(stretch_tension(0.9, 1.0, 50.0).slope, 0.0);
  EXPECT_DOUBLE_EQ(stretch_tension(1.2, 1.0, 50.0).force, 10.0);
  EXPECT_EQ(stretch_tension(1.2, 1.0, 50.0).slope, 50.0);
}

TEST(ChoiKo, EdgesAndDiagonalsStretchAndInterlacedConnectionsBuckle) {
  Body body;
  body.spring_model = SpringModel::choi_ko;
  body.buckling_rigidity = 1e-3;
  for (const SpringKind kind : {SpringKind::structural, SpringKind::shear}) {
    EXPECT_EQ(tension(body, kind, 0.5, 1.0, 50.0).force, 0.0);
    EXPECT_GT(tension(body, kind, 1.5, 1.0, 50.0).force, 0.0);
    EXPECT_EQ(spring_energy(body, kind, 0.5, 1.0, 50.0), 0.0);
  }
  EXPECT_LT(tension(body, SpringKind::bend, 0.5, 1.0, 50.0).force, 0.0);
  EXPECT_EQ(tension(body, SpringKind::bend, 1.5, 1.0, 50.0).force, 0.0);
}

}  // namespace
}  // namespace billow::sim
