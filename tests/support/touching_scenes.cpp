// Sheets, funnels and balls.
#include "tests/support/touching_scenes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

#include "sim/body/cloth.h"
#include "sim/import/mesh_import.h"
#include "sim/limit/certificate.h"
#include "sim/mesh/shapes.h"

namespace billow::test {

using namespace sim;

namespace {

constexpr double pi = std::numbers::pi;

Structure structure_of(const std::vector<ClothInScene>& cloths) {
  std::vector<Structure> parts;
  for (const ClothInScene& cloth : cloths) {
    ClothOptions options;
    options.name = "cloth_" + std::to_string(parts.size());
    options.mass = cloth.mass;
    options.structural = cloth.stiffness;
    options.shear = 0.5 * cloth.stiffness;
    options.bend = 0.05 * cloth.stiffness;
    options.friction = cloth.drag;
    options.pinned = cloth.pinned;
    parts.push_back(build_cloth(cloth.mesh, options));
  }
  return merge(parts);
}

Collider solid_mesh(const std::string& name, Mesh mesh) {
  Collider collider;
  collider.name = name;
  collider.mesh = std::move(mesh);
  return collider;
}

Collider ball(const std::string& name, const Eigen::Vector3d& centre, double radius) {
  Collider collider;
  collider.name = name;
  collider.rounded = Rounded{centre, centre, radius};
  collider.mesh = sphere_mesh(centre, radius);
  return collider;
}

Collider ground(double height, double friction = 0.5) {
  Collider collider;
  collider.name = "ground";
  collider.half_space = HalfSpace{{0.0, height, 0.0}, {0.0, 1.0, 0.0}};
  collider.friction = friction;
  return collider;
}

// Bridson, Fedkiw & Anderson 2002: the ball takes the cloth along when it turns.
std::unique_ptr<TouchingScene> turning_ball(bool as_mesh) {
  Collider turning = ball("ball", {0.0, 0.0, 0.0}, 0.3);
  if (as_mesh) turning = solid_mesh("ball", sphere_mesh({0.0, 0.0, 0.0}, 0.3));
  turning.friction = 0.6;
  turning.motion = KeyedMotion({{0.4}, {1.6, {0.0, 0.0, 0.0}, {0.0, 1.5 * pi, 0.0}}}, Eigen::Vector3d::Zero());
  const int squares = as_mesh ? 20 : 28;
  return touching_scene(as_mesh ? "turning_mesh" : "turning_ball",
                        {{.mesh = flat_sheet(squares, squares, 1.0, {0.0, 0.32, 0.0})}}, {turning, ground(-0.5)},
                        as_mesh ? 0.8 : 1.4);
}

// Harmon, Vouga, Tamstorf & Grinspun 2008: a cloth is pushed through a funnel.
std::unique_ptr<TouchingScene> funnel() {
  constexpr int around = 32, rings = 9;
  Mesh cone;
  cone.position.resize(around * rings, 3);
  for (int r = 0; r < rings; ++r)
    for (int k = 0; k < around; ++k) {
      const double s = r / (rings - 1.0), radius = 0.07 + 0.34 * s * s, angle = 2.0 * pi * k / around;
      cone.position.row(r * around + k) << radius * std::cos(angle), 0.4 * s, radius * std::sin(angle);
    }
  for (int r = 0; r + 1 < rings; ++r)
    for (int k = 0; k < around; ++k) {
      const int next = (k + 1) % around;
      cone.face.push_back({r * around + k, (r + 1) * around + k, (r + 1) * around + next, r * around + next});
    }
  Collider pusher = ball("pusher", {0.0, 0.65, 0.0}, 0.05);
  pusher.friction = 0.1;
  pusher.motion = KeyedMotion({{0.3}, {1.5, {0.0, -0.7, 0.0}, {0.0, 0.0, 0.0}}}, Eigen::Vector3d::Zero());
  Collider walls = solid_mesh("funnel", std::move(cone));
  walls.friction = 0.05;
  return touching_scene("funnel", {{.mesh = flat_sheet(22, 22, 0.6, {0.0, 0.45, 0.0}), .mass = 0.06, .friction = 0.05}},
                        {walls, pusher}, 1.6);
}

std::unique_ptr<TouchingScene> stack() {
  std::vector<ClothInScene> cloths;
  for (int k = 0; k < 5; ++k)
    cloths.push_back(
        {.mesh = flat_sheet(18, 18, 0.5, {0.031 * k, 0.05 + 0.05 * k, 0.017 * k * (k % 2)}), .mass = 0.05});
  return touching_scene("stack", cloths, {ground(0.0)}, 0.6);
}

// The two short ends turn four times against each other.
std::unique_ptr<TouchingScene> twisted() {
  constexpr int across = 48, along = 16;
  std::vector<int> pinned;
  MovingPin left, right;
  for (int z = 0; z <= along; ++z) {
    left.particle.push_back(z * (across + 1));
    right.particle.push_back(z * (across + 1) + across);
  }
  pinned = left.particle;
  pinned.insert(pinned.end(), right.particle.begin(), right.particle.end());
  std::sort(pinned.begin(), pinned.end());
  constexpr double turned = 4.0 * pi, closer = 0.12;
  left.motion = KeyedMotion({{0.0}, {2.0, {closer, 0.0, 0.0}, {turned, 0.0, 0.0}}}, Eigen::Vector3d::Zero());
  right.motion = KeyedMotion({{0.0}, {2.0, {-closer, 0.0, 0.0}, {-turned, 0.0, 0.0}}}, Eigen::Vector3d::Zero());
  auto scene = touching_scene("twisted",
                              {{.mesh = flat_sheet(across, along, 0.9, Eigen::Vector3d::Zero()),
                                .thickness = 0.003,
                                .drag = 2e-4,
                                .pinned = pinned}},
                              {}, 2.2);
  scene->pins = {left, right};
  return scene;
}

// Edge-on, at 30 m/s, at a sheet that is held.
std::unique_ptr<TouchingScene> thrown() {
  constexpr int squares = 20;
  std::vector<int> held;
  for (int z = 0; z <= squares; ++z) held.push_back(z * (squares + 1)), held.push_back(z * (squares + 1) + squares);
  std::sort(held.begin(), held.end());
  Mesh upright = flat_sheet(squares, squares, 0.3, Eigen::Vector3d::Zero());
  for (int v = 0; v < upright.vertices(); ++v) {
    const Eigen::RowVector3d p = upright.position.row(v);
    upright.position.row(v) << p(1), p(0) + 0.25, p(2) + 0.013;
  }
  return touching_scene("thrown",
                        {{.mesh = flat_sheet(squares, squares, 0.5, Eigen::Vector3d::Zero()), .pinned = held},
                         {.mesh = upright, .mass = 0.05, .velocity = {0.0, -30.0, 0.0}}},
                        {}, 0.3);
}

// Three layers of one cloth between two planes that close.
std::unique_ptr<TouchingScene> squeezed() {
  constexpr int across = 54, along = 9;
  constexpr double radius = 0.02, straight = 0.2;
  Mesh mesh = flat_sheet(across, along, 1.0, Eigen::Vector3d::Zero());
  const double bend = pi * radius, length = 3.0 * straight + 2.0 * bend;
  for (int v = 0; v < mesh.vertices(); ++v) {
    const double s = length * (mesh.position(v, 0) + 0.5), z = 0.2 * mesh.position(v, 2) * (across / double{along});
    double x = s, y = 0.0;
    const double second = straight + bend, third = 2.0 * straight + bend;
    if (s > straight && s <= second) {
      const double angle = (s - straight) / radius;
      x = straight + radius * std::sin(angle), y = radius * (1.0 - std::cos(angle));
    } else if (s > second && s <= third) {
      x = straight - (s - second), y = 2.0 * radius;
    } else if (s > third && s <= third + bend) {
      const double angle = (s - third) / radius;
      x = -radius * std::sin(angle), y = 3.0 * radius - radius * std::cos(angle);
    } else if (s > third + bend) {
      x = s - third - bend, y = 4.0 * radius;
    }
    mesh.position.row(v) << x, y + 0.01, z;
  }
  Collider lid;
  lid.name = "lid";
  lid.half_space = HalfSpace{{0.0, 0.11, 0.0}, {0.0, -1.0, 0.0}};
  lid.motion = KeyedMotion({{0.0}, {1.0, {0.0, -0.09, 0.0}, {0.0, 0.0, 0.0}}}, Eigen::Vector3d::Zero());
  return touching_scene("squeezed", {{.mesh = mesh, .mass = 0.1, .drag = 2e-4}}, {ground(0.0), lid}, 1.1);
}

std::unique_ptr<TouchingScene> bumpy() {
  constexpr int squares = 28;
  Mesh bumps = flat_sheet(squares, squares, 1.6, Eigen::Vector3d::Zero());
  for (int v = 0; v < bumps.vertices(); ++v)
    bumps.position(v, 1) = 0.12 * std::sin(9.0 * bumps.position(v, 0)) * std::cos(8.0 * bumps.position(v, 2));
  Mesh irregular = import_mesh(std::filesystem::path(BILLOW_SOURCE_DIR) / "assets/meshes/cloth_irregular.obj");
  const Eigen::RowVector3d middle = irregular.position.colwise().mean();
  irregular.position.rowwise() -= middle;
  const Eigen::RowVector3d extent = irregular.position.colwise().maxCoeff() - irregular.position.colwise().minCoeff();
  // Upright cloths are laid flat.
  if (extent(1) > extent(2)) irregular.position.col(1).swap(irregular.position.col(2));
  irregular.position.col(1).array() += 0.25;
  return touching_scene("bumpy", {{.mesh = irregular}}, {solid_mesh("bumps", bumps)}, 0.4);
}

const std::vector<std::pair<std::string, std::function<std::unique_ptr<TouchingScene>()>>>& scenes() {
  static const std::vector<std::pair<std::string, std::function<std::unique_ptr<TouchingScene>()>>> list{
      {"turning_ball", [] { return turning_ball(false); }},
      {"turning_mesh", [] { return turning_ball(true); }},
      {"funnel", funnel},
      {"stack", stack},
      {"twisted", twisted},
      {"thrown", thrown},
      {"squeezed", squeezed},
      {"bumpy", bumpy}};
  return list;
}

}  // namespace

Mesh flat_sheet(int across, int along, double size, const Eigen::Vector3d& middle) {
  Mesh mesh;
  mesh.position.resize((across + 1) * (along + 1), 3);
  for (int z = 0; z <= along; ++z)
    for (int x = 0; x <= across; ++x)
      mesh.position.row(z * (across + 1) + x) =
          middle.transpose() + size / across * Eigen::RowVector3d(x - 0.5 * across, 0.0, z - 0.5 * along);
  for (int z = 0; z < along; ++z)
    for (int x = 0; x < across; ++x) {
      const int corner = z * (across + 1) + x;
      mesh.face.push_back({corner, corner + across + 1, corner + across + 2, corner + 1});
    }
  return mesh;
}

std::unique_ptr<TouchingScene> touching_scene(const std::string& name, const std::vector<ClothInScene>& cloths,
                                              std::vector<Collider> colliders, double duration) {
  auto scene = std::make_unique<TouchingScene>();
  scene->name = name;
  scene->structure = structure_of(cloths);
  scene->contact.collider = std::move(colliders);
  scene->duration = duration;
  scene->start = rest_state(scene->structure);
  for (std::size_t b = 0; b < cloths.size(); ++b) {
    const Body& body = scene->structure.body[b];
    scene->contact.body.push_back({.touches = true,
                                   .self = true,
                                   .thickness = cloths[b].thickness,
                                   .friction = cloths[b].friction,
                                   .face = cloths[b].mesh.face});
    scene->start.velocity.middleRows(body.first_particle, body.particles).rowwise() = cloths[b].velocity.transpose();
  }
  const Forces forces(scene->structure, scene->gravity);
  const Linearisation bound = forces.bound(Shapes::any).linearisation;
  scene->step = 0.9 * certified_step({.structure = scene->structure,
                                      .linearisation = bound,
                                      .position = scene->structure.rest_position,
                                      .method = Method::fb_euler})
                          .step;
  return scene;
}

TouchingRun::TouchingRun(const TouchingScene& scene)
    : scene_(scene), forces_(scene.structure, scene.gravity), model_(scene.structure, scene.contact) {
  SolverOptions options;
  options.step = scene.step;
  options.max_strain = torn_strain;
  if (!scene.pins.empty())
    options.hooks.push_back([&] { return std::make_unique<MovingPins>(scene_.structure, forces_, scene_.pins); });
  options.hooks.push_back([&] {
    auto hook = std::make_unique<Contact>(model_);
    hook_ = hook.get();
    return hook;
  });
  check_start(model_, scene.start);
  solver_ = std::make_unique<Solver>(scene.structure, forces_, options, scene.start);
}

std::vector<std::string> touching_scene_names() {
  std::vector<std::string> names;
  for (const auto& [name, make] : scenes()) names.push_back(name);
  return names;
}

std::unique_ptr<TouchingScene> touching_scene_named(const std::string& name) {
  for (const auto& [known, make] : scenes())
    if (known == name) return make();
  throw std::invalid_argument("no touching scene " + name);
}

}  // namespace billow::test
