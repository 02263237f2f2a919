// Words for what a look at a mesh finds.
#include "cli/scene/mesh_warnings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/scene/scene_pins.h"
#include "sim/mesh/mesh_report.h"
#include "sim/mesh/pieces.h"

namespace billow::cli {
namespace {

std::string shown(const Eigen::Vector3d& place) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", place.x(), place.y(), place.z());
}

/// The pieces of a body with a pin at the start: those that hold one, and the rest.
struct HeldPieces {
  std::vector<std::vector<int>> held, loose;
};

HeldPieces held_pieces(const BodySpec& body) {
  HeldPieces result;
  const std::vector<int> pinned = held_vertices(body.pins, 0.0);
  if (pinned.empty() || std::holds_alternative<FishSpec>(body.kind)) return result;
  for (std::vector<int>& piece : sim::pieces(body.mesh)) {
    const bool holds = std::any_of(piece.begin(), piece.end(),
                                   [&](int v) { return std::binary_search(pinned.begin(), pinned.end(), v); });
    (holds ? result.held : result.loose).push_back(std::move(piece));
  }
  return result;
}

void add_loose_pieces(const BodySpec& body, std::vector<std::string>& warnings) {
  const HeldPieces pieces = held_pieces(body);
  if (pieces.loose.empty()) return;
  const auto largest = std::max_element(pieces.loose.begin(), pieces.loose.end(),
                                        [](const auto& a, const auto& b) { return a.size() < b.size(); });
  const Eigen::Vector3d middle = body.mesh.position(*largest, Eigen::all).colwise().mean().transpose();
  warnings.push_back(fmt::format(
      "pieces of its mesh that no pin holds and that will fall: {} of {}, the largest {} vertices around {}, vertex {} "
      "among them; "
      "pin them, join them to the rest, or make them a body of their own",
      pieces.loose.size(), pieces.loose.size() + pieces.held.size(), largest->size(), shown(middle), largest->front()));
}

void add_unit(const sim::MeshReport& report, std::vector<std::string>& warnings) {
  const std::string_view unit = sim::likely_unit(report.box);
  if (!unit.empty())
    warnings.push_back(fmt::format(
        "its mesh is {:.4g} m long, counted in metres; if the file is in {}, say 'transform: {{unit: {}}}', "
        "and if it is as it should be, 'unit: m'",
        report.box.sizes().maxCoeff(), unit, unit));
}

void add_places(const sim::Places& places, std::string_view what, std::vector<std::string>& warnings) {
  if (places.count == 0) return;
  std::vector<std::string> where;
  for (const Eigen::Vector3d& place : places.first) where.push_back(shown(place));
  warnings.push_back(fmt::format("{}: {}, at {}{}", what, places.count, fmt::join(where, ", "),
                                 places.count > static_cast<int>(where.size()) ? " …" : ""));
}

}  // namespace

std::vector<std::string> mesh_warnings(const BodySpec& body, bool unit_given) {
  std::vector<std::string> warnings;
  if (body.mesh_file.empty()) return warnings;
  for (const std::string& what : body.mesh.ignored)
    warnings.push_back(fmt::format("not used of {}: {}", body.mesh_file.filename().string(), what));
  if (std::holds_alternative<FishSpec>(body.kind)) return warnings;
  const sim::MeshReport report = sim::report_of(body.mesh);
  if (!unit_given) add_unit(report, warnings);
  add_loose_pieces(body, warnings);
  add_places(report.crowded_edges, "edges of its mesh with more than two faces", warnings);
  add_places(report.turned_edges, "edges of its mesh between faces that face opposite ways", warnings);
  add_places(report.duplicate_faces, "faces of its mesh that are there twice", warnings);
  add_places(report.flat_faces, "faces of its mesh without an area", warnings);
  add_places(report.tiny_edges, "edges of its mesh shorter than a thousandth of the mean", warnings);
  if (report.dropped_faces > 0)
    warnings.push_back(
        fmt::format("faces of its file that collapse to a line or a point, left out: {}", report.dropped_faces));
  return warnings;
}

namespace {

// A cloth's sag hardly depends on its mesh, a soft body's does.
std::string by_spring(const BodySpec& body) {
  const auto* soft = std::get_if<SoftSpec>(&body.kind);
  if (!soft || soft->options.young || soft->max_eigenvalue) return "";
  return "; its stiffness is by the spring, so that a finer mesh makes it stiffer: 'material' does not";
}

}  // namespace

std::vector<std::string> mesh_lines(const Scene& scene) {
  std::vector<std::string> lines;
  for (const BodySpec& body : scene.bodies) {
    if (body.mesh_file.empty()) continue;
    const sim::MeshReport report = sim::report_of(body.mesh);
    const Eigen::Vector3d size = report.box.sizes();
    lines.push_back(
        fmt::format("mesh: body {}, {} vertices, {} triangles, {} quads, {} pieces, {}, {} seam edges, {:.3g} x {:.3g} "
                    "x {:.3g} m{}",
                    body.name, report.vertices, report.triangles, report.quads, report.pieces.size(),
                    report.closed() ? std::string("closed")
                                    : fmt::format("{} borders ({} holes)", report.borders.size(), report.holes()),
                    report.seams.count, size.x(), size.y(), size.z(), by_spring(body)));
  }
  return lines;
}

std::vector<int> framed_vertices(const BodySpec& body) {
  const HeldPieces pieces = held_pieces(body);
  std::vector<int> framed;
  if (pieces.loose.empty() || body.contact) return framed;
  for (const std::vector<int>& piece : pieces.held) framed.insert(framed.end(), piece.begin(), piece.end());
  std::sort(framed.begin(), framed.end());
  return framed;
}

namespace {

constexpr double float_step = 0x1p-23;  // of single precision, relative
constexpr double coarse_share = 1e-3;   // of the mean edge: steps that show

// The formats of caches hold single precision; glb stands at the scene's middle.
void add_coarse_caches(const Scene& scene, const BodySpec& body, std::vector<std::string>& warnings) {
  const bool caches = std::any_of(scene.caches.begin(), scene.caches.end(),
                                  [](CacheFormat format) { return format != CacheFormat::glb; });
  if (!caches || body.mesh.face.empty()) return;
  const double step = float_step * body.mesh.position.cwiseAbs().maxCoeff();
  if (step > coarse_share * sim::mean_edge_length(body.mesh))
    warnings.push_back(fmt::format(
        "body {}: caches hold single precision, steps of {:.2g} m so far from the origin; move the scene there, or "
        "take 'glb', which stands at the scene's middle, or the states of 'billow simulate'",
        body.name, step));
}

}  // namespace

std::vector<std::string> mesh_warnings(const Scene& scene) {
  std::vector<std::string> warnings;
  for (const BodySpec& body : scene.bodies) {
    for (const std::string& text : body.warnings) warnings.push_back(fmt::format("body {}: {}", body.name, text));
    add_coarse_caches(scene, body, warnings);
  }
  return warnings;
}

}  // namespace billow::cli
