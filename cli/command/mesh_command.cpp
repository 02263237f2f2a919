// billow mesh: a look at a mesh file, before it is put into a scene.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "cli/command/application.h"
#include "cli/command/commands.h"
#include "cli/text/json_text.h"
#include "cli/text/terminal.h"
#include "sim/import/mesh_import.h"
#include "sim/mesh/mesh_report.h"

namespace billow::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t shown_parts = 5;

Json list_of(const Eigen::Vector3d& place) { return {place.x(), place.y(), place.z()}; }

std::string text_of(const Eigen::Vector3d& place) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", place.x(), place.y(), place.z());
}

/// What is wrong with the mesh, as keys of JSON and in words.
struct Finding {
  const char* key;
  const char* text;
  sim::Places sim::MeshReport::*places;
};

constexpr Finding findings[] = {
    {"crowded_edges", "edges of more than two faces", &sim::MeshReport::crowded_edges},
    {"turned_edges", "edges between faces that face opposite ways", &sim::MeshReport::turned_edges},
    {"duplicate_faces", "faces that are there twice", &sim::MeshReport::duplicate_faces},
    {"flat_faces", "faces without an area", &sim::MeshReport::flat_faces},
    {"tiny_edges", "edges shorter than a thousandth of the mean", &sim::MeshReport::tiny_edges}};

Json places_json(const sim::Places& places) {
  Json first = Json::array();
  for (const Eigen::Vector3d& place : places.first) first.push_back(list_of(place));
  return {{"count", places.count}, {"first", first}};
}

template <class Map>
Json names_of(const Map& map) {
  Json names = Json::array();
  for (const auto& [name, value] : map) names.push_back(name);
  return names;
}

Json as_json(const sim::Mesh& mesh, const sim::MeshReport& report) {
  Json json = {{"vertices", report.vertices},
               {"faces", report.triangles + report.quads},
               {"triangles", report.triangles},
               {"quads", report.quads},
               {"edges", report.edges},
               {"file_vertices", report.file_vertices},
               {"loose_vertices", report.loose_vertices},
               {"dropped_faces", report.dropped_faces},
               {"low", list_of(report.box.min())},
               {"high", list_of(report.box.max())},
               {"likely_unit", sim::likely_unit(report.box)},
               {"edge_length", {report.shortest_edge, report.mean_edge, report.longest_edge}},
               {"area", report.area},
               {"closed", report.closed()},
               {"volume", report.volume},
               {"holes", report.holes()}};
  for (const sim::MeshReport::Piece& piece : report.pieces)
    json["pieces"].push_back({{"vertices", piece.vertices}, {"faces", piece.faces}, {"middle", list_of(piece.middle)}});
  json["borders"] = Json::array();
  for (const sim::MeshReport::Border& border : report.borders)
    json["borders"].push_back({{"edges", border.edges}, {"length", border.length}, {"middle", list_of(border.middle)}});
  json["texture_coordinates"] = report.has_uv;
  json["seams"] = places_json(report.seams);
  for (const Finding& finding : findings) json[finding.key] = places_json(report.*finding.places);
  json["groups"] = names_of(mesh.group);
  json["weights"] = names_of(mesh.weight);
  json["colours"] = mesh.colour.rows() > 0;
  json["materials"] = Json::array();
  for (const sim::Material& material : mesh.material) json["materials"].push_back(material.name);
  json["not_used"] = mesh.ignored;
  return json;
}

void print_row(std::string_view what, const std::string& text) { print_line("  {:<10} {}", what, text); }

void print_size(const sim::MeshReport& report) {
  const Eigen::Vector3d size = report.box.sizes();
  const std::string_view unit = sim::likely_unit(report.box);
  print_row("size", fmt::format("{:.4g} x {:.4g} x {:.4g} m, from {} to {}{}", size.x(), size.y(), size.z(),
                                text_of(report.box.min()), text_of(report.box.max()),
                                unit.empty() ? "" : fmt::format("; most likely in {}", unit)));
  print_row("edges", fmt::format("{}, {:.4g} to {:.4g} m, {:.4g} m in the mean", report.edges, report.shortest_edge,
                                 report.longest_edge, report.mean_edge));
  print_row("surface", report.closed() ? fmt::format("{:.6g} m², closed, {:.6g} m³ inside", report.area, report.volume)
                                       : fmt::format("{:.6g} m², open", report.area));
}

void print_parts(const sim::MeshReport& report) {
  std::vector<std::string> parts;
  for (const sim::MeshReport::Piece& piece : report.pieces)
    if (parts.size() < shown_parts)
      parts.push_back(fmt::format("{} vertices around {}", piece.vertices, text_of(piece.middle)));
  print_row("pieces", fmt::format("{}: {}{}", report.pieces.size(), fmt::join(parts, "; "),
                                  report.pieces.size() > shown_parts ? "; …" : ""));
  if (report.borders.empty()) return;
  parts.clear();
  for (const sim::MeshReport::Border& border : report.borders)
    if (parts.size() < shown_parts)
      parts.push_back(
          fmt::format("{:.4g} m ({} edges) around {}", border.length, border.edges, text_of(border.middle)));
  print_row("borders", fmt::format("{}: {}{}", report.borders.size(), fmt::join(parts, "; "),
                                   report.borders.size() > shown_parts ? "; …" : ""));
}

template <class Names>
void print_names(std::string_view what, const Names& names) {
  if (!names.empty()) print_row(what, fmt::format("{}", fmt::join(names, ", ")));
}

void print_extras(const sim::Mesh& mesh, const sim::MeshReport& report) {
  std::vector<std::string> has;
  if (report.has_uv) has.push_back(fmt::format("texture coordinates ({} edges are seams)", report.seams.count));
  if (mesh.colour.rows() > 0) has.emplace_back("colours of vertices");
  print_names("has", has);
  std::vector<std::string> materials;
  for (const sim::Material& material : mesh.material)
    materials.push_back(material.texture.empty() ? material.name
                                                 : fmt::format("{} ({})", material.name, material.texture));
  print_names("materials", materials);
  for (const auto& [what, names] :
       {std::pair<std::string_view, Json>{"groups", names_of(mesh.group)}, {"weights", names_of(mesh.weight)}})
    print_names(what, names.get<std::vector<std::string>>());
  print_names("not used", mesh.ignored);
}

void print_findings(const sim::MeshReport& report) {
  if (report.loose_vertices > 0)
    print_row("beware", fmt::format("vertices of no face, left out: {}", report.loose_vertices));
  if (report.dropped_faces > 0)
    print_row("beware", fmt::format("faces that collapse to a line or a point, left out: {}", report.dropped_faces));
  for (const Finding& finding : findings) {
    const sim::Places& places = report.*finding.places;
    if (places.count == 0) continue;
    std::vector<std::string> where;
    for (const Eigen::Vector3d& place : places.first) where.push_back(text_of(place));
    print_row("beware", fmt::format("{}: {}, at {}{}", finding.text, places.count, fmt::join(where, "; "),
                                    places.count > sim::Places::shown ? "; …" : ""));
  }
}

}  // namespace

int mesh_command(const MeshOptions& options) {
  const sim::Mesh mesh = sim::import_mesh(options.mesh);
  const sim::MeshReport report = sim::report_of(mesh);
  if (options.json) {
    print_json(json_text(as_json(mesh, report), 2));
    return exit_done;
  }
  print_line("{}: {} vertices, {} faces ({} triangles, {} quads)", options.mesh.string(), report.vertices,
             report.triangles + report.quads, report.triangles, report.quads);
  print_size(report);
  print_parts(report);
  print_extras(mesh, report);
  print_findings(report);
  return exit_done;
}

}  // namespace billow::cli
