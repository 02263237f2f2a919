// Surfaces in closed form.
#include "tests/support/drawn_sheet.h"

#include <array>
#include <cmath>

namespace billow::test {
namespace {

sim::Surface grid_surface(int n) {
  sim::Surface surface;
  surface.point = Eigen::VectorXi::LinSpaced(n * n, 0, n * n - 1);
  surface.uv.resize(n * n, 2);
  for (int p = 0; p < n * n; ++p) surface.uv.row(p) << float(p % n) / float(n - 1), 1.0f - float(p / n) / float(n - 1);
  surface.triangle.resize(2 * (n - 1) * (n - 1), 3);
  for (int q = 0; q < (n - 1) * (n - 1); ++q) {
    const int a = q / (n - 1) * n + q % (n - 1);
    surface.triangle.row(2 * q) << a, a + n, a + 1;
    surface.triangle.row(2 * q + 1) << a + 1, a + n, a + n + 1;
  }
  return surface;
}

DrawnSheet flat_grid(int n, float side) {
  DrawnSheet sheet;
  sheet.body.surface = grid_surface(n);
  sheet.state.position.setZero(n * n, 3);
  sheet.state.position.leftCols(2) = side * (sheet.body.surface.uv.array() - 0.5f);
  sheet.state.velocity.setZero(n * n, 3);
  return sheet;
}

void find_bounds(DrawnSheet& sheet) {
  for (Eigen::Index p = 0; p < sheet.state.position.rows(); ++p)
    sheet.bounds.box.extend(Eigen::Vector3d(sheet.state.position.row(p).transpose().cast<double>()));
}

}  // namespace

DrawnSheet wavy_sheet(int n) {
  DrawnSheet sheet = flat_grid(n, 1.0f);
  sheet.body.finish[0] = {.texture = checker(), .colour = Eigen::Vector3f::Ones()};
  for (int p = 0; p < n * n; ++p) {
    const float u = sheet.state.position(p, 0), down = 0.5f - sheet.state.position(p, 1);
    sheet.state.position(p, 2) = (0.03f + 0.09f * down) * std::sin(15.0f * u) + 0.15f * down * down;
    sheet.state.velocity.row(p) << std::sin(5.0f * u), std::cos(4.0f * down), std::sin(3.0f * u + 5.0f * down);
  }
  find_bounds(sheet);
  return sheet;
}

DrawnSheet flat_sheet(const Eigen::Vector3f& velocity) {
  DrawnSheet sheet = flat_grid(3, 2.0f);
  sheet.state.velocity.rowwise() = velocity.transpose();
  find_bounds(sheet);
  return sheet;
}

render::Image checker() {
  render::Image image(64, 64, 3);
  constexpr std::array<std::array<std::uint8_t, 3>, 2> colours{{{196, 62, 48}, {244, 236, 216}}};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) image.row(y)[3 * x + c] = colours[(x / 8 + y / 8) % 2][c];
  return image;
}

render::Settings sheet_settings() {
  render::Settings settings;
  settings.width = 320;
  settings.height = 240;
  settings.camera.fitted = true;
  settings.legend = false;
  return settings;
}

render::Settings frontal_settings() {
  render::Settings settings = sheet_settings();
  settings.width = settings.height = 64;
  settings.camera.fitted = false;
  settings.camera.eye = {0.0, 0.0, 2.0};
  settings.camera.look_at.setZero();
  settings.camera.vertical_fov = 2.0 * std::atan(1.0);  // the picture is 4 m high at the sheet
  settings.ground = false;
  return settings;
}

render::Image draw_sheet(const DrawnSheet& sheet, render::View view, const render::Settings& settings) {
  render::MeshRenderer renderer(settings, {sheet.body}, sheet.bounds);
  return std::get<render::Image>(renderer.draw(view, {sheet.state}));
}

}  // namespace billow::test
