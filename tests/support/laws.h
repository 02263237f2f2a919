// Every law of force on a structure that it acts on, and what is true of it: one table for all that tests ask of laws.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/force/force_law.h"
#include "sim/mesh/mesh.h"

namespace billow::test::laws {

inline const Eigen::Vector3d gravity(1.0, -9.81, 0.5), current(0.3, -0.1, 0.2);
inline constexpr double resistance = 580.0;

/// What a law does to the energy of the motion, its own potential energy counted.
enum class Power { keeps, takes, gives };

/// A law on a structure that it acts on, and what is true of it.
struct Case {
  std::string name;
  std::shared_ptr<const sim::Structure> structure;
  std::shared_ptr<const sim::ForceLaw> law;
  Power power;
  std::vector<sim::Face> faces = {};  // whose growth bounds the shapes that its bound is for
  std::optional<Eigen::Vector3d> stream =
      {};  // [m/s] of what flows evenly around it, and pushes it with nothing moving
};

/// Every law, several times where it has several models.
const std::vector<Case>& cases();
/// The springs of `structure` alone.
Case springs_of(const std::string& name, const sim::Structure& structure, Power power);

/// A small cloth, every spring damped differently.
sim::Structure sheet(sim::SpringModel model, sim::DampingModel damping);
/// A fish that is not the first body, so that what it counts from is seen.
sim::Structure ring_and_fish();
/// Quads and triangles over all of a sheet.
const std::vector<sim::Face>& sheet_faces();
inline constexpr int fish_body = 1, first_fish_particle = 5;

/// Everything moves, and a fish is somewhere in its swimming and turning.
sim::State shaken(const sim::Structure& structure, std::uint64_t seed, double distance = 0.02);

/// position_weight K + velocity_weight C of the case's law at `state` (3n x 3n).
Eigen::MatrixXd linearised(const Case& c, const sim::State& state, double position_weight, double velocity_weight,
                           sim::JacobianForm form);
Eigen::MatrixXd stiffness(const Case& c, const sim::State& state, sim::JacobianForm form);
Eigen::MatrixXd damping(const Case& c, const sim::State& state, sim::JacobianForm form);

template <class Check>
void for_every_law(const Check& check) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    check(c);
  }
}

}  // namespace billow::test::laws
