// The soft starfish as they are drawn, in both views, once they swing.
#include <gtest/gtest.h>

#include "cli/drawn/drawn_scene.h"
#include "cli/run/film.h"
#include "cli/scene/simulation.h"
#include "render/frame/mesh_renderer.h"
#include "tests/support/golden.h"

namespace billow {
namespace {

// A step well within the certified limit spares the test its certificate.
const std::vector<cli::Override> small_picture{
    {"duration", "1"}, {"render.size", "[480, 270]"}, {"render.velocity_range", "3"}, {"solver.step", "0.0005"}};

TEST(SoftPicture, ShowsBothStars) {
  const cli::Scene scene = cli::read_scene(BILLOW_SOURCE_DIR "/scenes/soft_body.yaml", small_picture);
  const cli::Simulation simulation(scene);
  cli::StepChoice choice;
  choice.step = scene.solver.step;
  const cli::DrawnScene drawn(scene, simulation);
  const auto bodies = drawn.surfaces(simulation.make_solver(choice)->sample(0.32));
  render::RunBounds bounds;
  for (const sim::SurfaceState& body : bodies) {
    bounds.box.extend(body.position.colwise().minCoeff().transpose().cast<double>());
    bounds.box.extend(body.position.colwise().maxCoeff().transpose().cast<double>());
  }
  render::MeshRenderer renderer(scene.render, drawn.bodies(), bounds);
  EXPECT_GOLDEN(std::get<render::Image>(renderer.draw(render::View::textured, bodies)), "soft_textured");
  EXPECT_GOLDEN(std::get<render::Image>(renderer.draw(render::View::velocity, bodies)), "soft_velocity");
}

}  // namespace
}  // namespace billow
