// The fish as it is drawn, in both views, once it swims.
#include <gtest/gtest.h>

#include "cli/drawn/drawn_scene.h"
#include "cli/run/film.h"
#include "cli/scene/simulation.h"
#include "render/frame/mesh_renderer.h"
#include "tests/support/golden.h"

namespace billow {
namespace {

const std::vector<cli::Override> small_picture{{"duration", "2.5"},
                                               {"render.size", "[480, 270]"},
                                               {"render.velocity_range", "0.8"},
                                               {"solver.step", "0.0494438423530611"},
                                               {"water.motes", "0"}};

class FishPicture : public testing::Test {
 protected:
  render::Image draw(render::View view) const {
    render::RunBounds bounds;
    const auto bodies = drawn_.surfaces(simulation_.make_solver(simulation_.choose_step())->sample(2.2));
    for (const sim::SurfaceState& body : bodies) {
      bounds.box.extend(body.position.colwise().minCoeff().transpose().cast<double>());
      bounds.box.extend(body.position.colwise().maxCoeff().transpose().cast<double>());
    }
    return std::get<render::Image>(render::MeshRenderer(scene_.render, drawn_.bodies(), bounds).draw(view, bodies));
  }

  cli::Scene scene_ = cli::read_scene(BILLOW_SOURCE_DIR "/scenes/fish.yaml", small_picture);
  cli::Simulation simulation_{scene_};
  cli::DrawnScene drawn_{scene_, simulation_};
};

TEST_F(FishPicture, ShowsItsSkin) { EXPECT_GOLDEN(draw(render::View::textured), "fish_textured"); }

TEST_F(FishPicture, ShowsItsVelocity) { EXPECT_GOLDEN(draw(render::View::velocity), "fish_velocity"); }

}  // namespace
}  // namespace billow
