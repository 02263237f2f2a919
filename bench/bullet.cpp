// Bullet's soft body on the grid of 100 x 100: the same particles and, with its bending constraints of distance 2, the
// same kinds of links. One position iteration, no collisions, no aerodynamics.
#include <BulletSoftBody/btDefaultSoftBodySolver.h>
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <benchmark/benchmark.h>

#include "bench/cloths.h"
#include "bench/sections.h"

namespace billow::bench {

namespace {

constexpr const char* bullet_name = "Bullet, grid 100";

void bullet_step(benchmark::State& run) {
  const sim::Mesh mesh = grid_mesh(100);
  btAlignedObjectArray<btVector3> nodes;
  for (int v = 0; v < mesh.vertices(); ++v)
    nodes.push_back(btVector3(static_cast<btScalar>(mesh.position(v, 0)), static_cast<btScalar>(mesh.position(v, 1)),
                              static_cast<btScalar>(mesh.position(v, 2))));
  btSoftBodyWorldInfo world;
  world.m_gravity.setValue(0, -9.81f, 0);
  btSoftBody body(&world, nodes.size(), &nodes[0], nullptr);
  for (const sim::Face& face : mesh.face) {
    for (int c = 0; c < 4; ++c) body.appendLink(face[c], face[(c + 1) % 4], nullptr, true);
    body.appendLink(face[0], face[2], nullptr, true);
    body.appendLink(face[1], face[3], nullptr, true);
  }
  for (int row = 0; row < 100; ++row)
    for (int column = 0; column < 100; ++column) {
      const int i = 100 * row + column;
      if (column + 2 < 100) body.appendLink(i, i + 2, nullptr, true);
      if (row + 2 < 100) body.appendLink(i, i + 200, nullptr, true);
    }
  body.setTotalMass(0.2f);
  body.setMass(0, 0);
  body.setMass(1, 0);
  body.m_cfg.piterations = 1;
  body.m_cfg.collisions = 0;
  for (auto _ : run) {
    body.predictMotion(1e-3f);
    body.solveConstraints();
    body.integrateMotion();
  }
  run.counters["springs"] = body.m_links.size();
}

}  // namespace

Targets add_bullet() {
  benchmark::RegisterBenchmark(bullet_name, bullet_step);
  return {{"Bullet's step against ours, per link", bullet_name, pass_name("step", "grid 100", 1), 12.0, true}};
}

}  // namespace billow::bench
