// crossings SCENE [-D KEY=VALUE]... [--threads N]: runs a scene and counts, with exact predicates, what of its surfaces
// crosses in every frame. Prints the frames that have crossings, a sum, and a hash of the last state; fails on any.
#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>

#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "cli/scene/hash.h"
#include "cli/scene/simulation.h"
#include "sim/contact/contact.h"
#include "tests/support/intersections.h"

namespace billow {
namespace {

// Bodies and colliders as they are drawn: something rounded by its mesh.
test::TriangleSoup surfaces(const sim::ContactModel& model, const sim::State& state) {
  const sim::ContactSurface& surface = model.surface();
  sim::Points x = surface.rest;
  for (int i = 0; i < surface.particles; ++i) x[i] = state.position.row(i);
  model.place_colliders(state.time, x);
  Eigen::MatrixX3d position(surface.vertices(), 3);
  for (int v = 0; v < surface.vertices(); ++v) position.row(v) = x[v];
  std::vector<sim::Face> faces;
  for (const sim::SurfacePart& part : surface.part)
    for (int f = part.first_face; f < part.first_face + part.faces && !part.rounded(); ++f)
      faces.push_back({surface.face[f][0], surface.face[f][1], surface.face[f][2], -1});
  test::TriangleSoup soup;
  soup.add(position, faces);
  for (const sim::Collider& collider : model.options().collider) {
    if (!collider.rounded) continue;
    const Eigen::Isometry3d place = collider.motion.at(state.time);
    soup.add((collider.mesh.position * place.linear().transpose()).rowwise() + place.translation().transpose(),
             collider.mesh.face);
  }
  return soup;
}

int below_planes(const sim::ContactModel& model, const sim::State& state) {
  int below = 0;
  for (const int h : model.surface().half_space) {
    const sim::Collider& collider = model.options().collider[h];
    const Eigen::Isometry3d place = collider.motion.at(state.time);
    const Eigen::Vector3d point = place * collider.half_space->point,
                          normal = place.linear() * collider.half_space->normal;
    for (const sim::SurfacePart& part : model.surface().part)
      for (int v = part.first_vertex; v < part.first_vertex + part.vertices && part.is_body(); ++v)
        below += normal.dot(state.position.row(v).transpose() - point) < 0.0;
  }
  return below;
}

std::size_t crossings_of(const sim::ContactModel& model, const sim::State& state) {
  return test::crossings(surfaces(model, state)).size() + static_cast<std::size_t>(below_planes(model, state));
}

int run(const std::string& file, const std::vector<cli::Override>& overrides) {
  const cli::Scene scene = cli::read_scene(file, overrides);
  const cli::Simulation simulation(scene);
  const auto& contact = simulation.phase().contact;
  if (!contact) {
    fmt::print("{}: nothing touches\n", file);
    return 1;
  }
  long frame = 0, crossings = 0;
  const auto next = [&] {
    const double time = static_cast<double>(++frame) / scene.render.fps;
    return time <= scene.duration + 1e-9 ? time : INFINITY;
  };
  const auto watched = simulation.make_run(simulation.choose_step(), next);
  sim::State last = simulation.initial_state();
  long frames = 0;
  while (const auto sample = watched->next()) {
    last = sample->state;
    ++frames;
    const auto count = static_cast<long>(crossings_of(*contact, last));
    if (count > 0) fmt::print("t = {:.3f} s: {} crossings\n", last.time, count);
    crossings += count;
  }
  cli::Hash hash;
  hash.add({reinterpret_cast<const char*>(last.position.data()),
            sizeof(double) * static_cast<std::size_t>(last.position.size())});
  fmt::print("{}: {} crossings in {} frames, {} steps, {} incidents, last state {}\n", file, crossings, frames,
             watched->steps(), watched->incidents().size(), hash.hex());
  return crossings > 0;
}

}  // namespace
}  // namespace billow

int main(int argc, char** argv) {
  std::string scene;
  std::vector<billow::cli::Override> overrides;
  std::size_t threads = 2;
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    if (word == "--threads" && k + 1 < argc) {
      threads = std::strtoul(argv[++k], nullptr, 10);
    } else if (word == "-D" && k + 1 < argc) {
      const std::string text = argv[++k];
      const auto equals = text.find('=');
      overrides.push_back({.path = text.substr(0, equals), .value = text.substr(equals + 1)});
    } else {
      scene = word;
    }
  }
  try {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
    return billow::run(scene, overrides);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
