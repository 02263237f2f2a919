#include "tests/support/laws.h"

#include "sim/force/buoyancy.h"
#include "sim/force/fluid_friction.h"
#include "sim/force/gravity.h"
#include "sim/force/muscle_force.h"
#include "sim/force/spring_force.h"
#include "sim/force/water_force.h"
#include "sim/force/wind_force.h"
#include "sim/limit/linear_force.h"
#include "tests/support/structures.h"
#include "tests/support/swimmers.h"

namespace billow::test::laws {

using namespace sim;

Structure sheet(SpringModel model, DampingModel damping) {
  Structure structure =
      grid({.width = 4, .height = 3, .spacing = 0.1, .mass = 0.02, .structural = 100.0, .shear = 70.0, .bend = 30.0});
  structure.damping = Eigen::VectorXd::LinSpaced(structure.springs(), 0.0, 2.0);
  structure.body[0].spring_model = model;
  structure.body[0].damping_model = damping;
  structure.body[0].buckling_rigidity = 4e-3;
  structure.body[0].friction = 0.3;
  return test::with_uneven_masses(structure, 0.5);
}

const std::vector<Face>& sheet_faces() {
  static const std::vector<Face> faces = {{0, 4, 5, 1},  {1, 5, 6, 2},  {2, 6, 7, -1}, {2, 7, 3, -1},
                                          {4, 8, 9, -1}, {4, 9, 5, -1}, {5, 9, 10, 6}, {6, 10, 11, 7}};
  return faces;
}

Structure ring_and_fish() {
  Structure whole = merge({test::ring(5, 0.4, 30.0), build_fish(test::swimmer_options())});
  whole.body[0].friction = 0.2;
  whole.body[1].friction = 0.05;
  return whole;
}
namespace {

using Maker = std::function<std::shared_ptr<const ForceLaw>(const Structure&)>;

Case make(const std::string& name, const Structure& structure, Power power, const Maker& maker) {
  const auto shared = std::make_shared<const Structure>(structure);
  return {name, shared, maker(*shared), power};
}

std::vector<Face> fish_faces_in_the_whole() {
  std::vector<Face> faces = fish_faces();
  for (Face& face : faces)
    for (int c = 0; c < corner_count(face); ++c) face[c] += first_fish_particle;
  return faces;
}

}  // namespace

Case springs_of(const std::string& name, const Structure& structure, Power power) {
  return make(name, structure, power, [](const Structure& s) { return std::make_shared<SpringForce>(s); });
}

namespace {

Case spring_case(const std::string& name, SpringModel model, DampingModel damping) {
  return springs_of(name, sheet(model, damping), Power::takes);
}

Case muscle_case(const std::string& name, const MotionOptions& motion, Power power) {
  return make(name, ring_and_fish(), power,
              [&](const Structure& s) { return std::make_shared<MuscleForce>(s, fish_body, FishMotion(motion)); });
}

Case water_case(const std::string& name, const Eigen::Vector3d& velocity, Power power) {
  Case water = make(name, ring_and_fish(), power, [&](const Structure& s) {
    return std::make_shared<WaterForce>(s, Water{resistance, velocity}, fish_faces(), first_fish_particle);
  });
  water.faces = fish_faces_in_the_whole();
  if (power == Power::gives) water.stream = velocity;
  return water;
}

// In these motions some faces meet the air slower than the force is quadratic, and some faster.
Case wind_case(const std::string& name, const Eigen::Vector3d& velocity, Power power) {
  Case wind = make(name, sheet(SpringModel::linear, DampingModel::projected), power, [&](const Structure& s) {
    return std::make_shared<WindForce>(s, Wind{.velocity = velocity, .quadratic_to = velocity.isZero() ? 0.5 : 1.5},
                                       sheet_faces(), 0);
  });
  if (power == Power::gives) wind.stream = velocity;
  return wind;
}

// It refers to a linearisation, which lives as long as it does.
Case linearised_case() {
  return make("linearised springs", sheet(SpringModel::linear, DampingModel::projected), Power::takes,
              [](const Structure& s) -> std::shared_ptr<const ForceLaw> {
                struct Owner {
                  explicit Owner(const Structure& s) : linearisation(linearise_at_rest(s)), law(linearisation) {}
                  Linearisation linearisation;
                  LinearForce law;
                };
                const auto owner = std::make_shared<const Owner>(s);
                return {owner, &owner->law};
              });
}

}  // namespace

const std::vector<Case>& cases() {
  static const std::vector<Case> list = {
      spring_case("springs, projected damping", SpringModel::linear, DampingModel::projected),
      spring_case("springs, relative damping", SpringModel::linear, DampingModel::spring),
      spring_case("Choi-Ko springs, projected damping", SpringModel::choi_ko, DampingModel::projected),
      make("friction", ring_and_fish(), Power::takes,
           [](const Structure& s) { return std::make_shared<FluidFriction>(s); }),
      make("gravity", ring_and_fish(), Power::keeps,
           [](const Structure& s) { return std::make_shared<Gravity>(s, gravity); }),
      make("buoyancy", ring_and_fish(), Power::keeps,
           [](const Structure& s) { return std::make_shared<Buoyancy>(s, fish_body, gravity, 0.8); }),
      muscle_case("swimming muscles", test::swimming(), Power::gives),
      muscle_case("turning muscles", test::turning(0.4), Power::gives),
      muscle_case("still muscles", {}, Power::keeps),
      water_case("still water", Eigen::Vector3d::Zero(), Power::takes),
      water_case("a current", current, Power::gives),
      wind_case("still air", Eigen::Vector3d::Zero(), Power::takes),
      wind_case("a wind", 4.0 * current, Power::gives),
      linearised_case(),
  };
  return list;
}

State shaken(const Structure& structure, std::uint64_t seed, double distance) {
  State state = test::shaken_state(structure, distance, 0.5, 10 * seed);
  state.time = 2.7 + 0.37 * static_cast<double>(seed);
  return state;
}

Eigen::MatrixXd linearised(const Case& c, const State& state, double position_weight, double velocity_weight,
                           JacobianForm form) {
  StiffnessMatrix matrix(*c.structure);
  c.law->add_linearisation(state, position_weight, velocity_weight, form, matrix);
  return Eigen::MatrixXd(matrix.assemble(false));
}

Eigen::MatrixXd stiffness(const Case& c, const State& state, JacobianForm form) {
  return linearised(c, state, 1.0, 0.0, form);
}

Eigen::MatrixXd damping(const Case& c, const State& state, JacobianForm form) {
  return linearised(c, state, 0.0, 1.0, form);
}

}  // namespace billow::test::laws
