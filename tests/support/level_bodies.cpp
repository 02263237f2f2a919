// Cloths, bars, a fish and a chain.
#include "tests/support/level_bodies.h"

#include "base/random.h"
#include "sim/body/cloth.h"
#include "sim/body/soft_body.h"
#include "tests/support/mesh_files.h"
#include "tests/support/structures.h"
#include "tests/support/swimmers.h"

namespace billow::test {

sim::Structure irregular_cloth(int width, int height, std::vector<int> pinned) {
  sim::Mesh mesh = triangulated(quad_grid(width, height));
  mesh.position += 0.25 * seeded_noise(width * height, 19) * Eigen::Vector3d(1.0, 0.0, 1.0).asDiagonal();
  return sim::build_cloth(mesh, {.mass = 0.01 * width * height, .pinned = std::move(pinned)});
}

sim::Structure soft_bar(int length) {
  std::vector<Eigen::Vector3d> place;
  for (int x = 0; x <= length; ++x)
    for (const auto& [y, z] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) place.emplace_back(x, y, z);
  std::vector<sim::Face> faces{{3, 2, 1, 0}, {4 * length, 4 * length + 1, 4 * length + 2, 4 * length + 3}};
  for (int x = 0; x < length; ++x)
    for (int k = 0; k < 4; ++k)
      faces.push_back({4 * x + k, 4 * x + (k + 1) % 4, 4 * x + 4 + (k + 1) % 4, 4 * x + 4 + k});
  return sim::build_soft_body(bare_mesh(place, faces), {});
}

sim::Structure as_one_body(sim::Structure structure) {
  structure.body.resize(1);
  structure.body[0].particles = structure.particles();
  structure.body[0].springs = structure.springs();
  return structure;
}

std::vector<LevelBody> free_level_bodies() {
  return {{"grid", with_uneven_masses(light_cloth(7, 6), 0.5)},
          {"narrow grid", with_uneven_masses(light_cloth(2, 11), 0.5)},
          {"irregular cloth", irregular_cloth(7, 6)},
          {"soft bar", with_uneven_masses(soft_bar(8), 0.5)},
          {"fish", sim::build_fish(swimmer_options())}};
}

std::vector<LevelBody> pinned_level_bodies() {
  return {{"pinned grid", with_uneven_masses(light_cloth(9, 7, {0, 8, 31}), 0.5)},
          {"pinned irregular cloth", irregular_cloth(9, 7, {0, 8, 31})},
          {"chain between walls", with_uneven_masses(fixed_chain({.free_particles = 40}), 0.5)}};
}

std::vector<LevelBody> all_level_bodies() {
  std::vector<LevelBody> all = free_level_bodies();
  for (LevelBody& body : pinned_level_bodies()) all.push_back(std::move(body));
  return all;
}

}  // namespace billow::test
