// Every key that a scene may have, with the numbers and words it accepts. Upper bounds are there to catch slips such as
// grams for kilograms, or a frame that no memory holds; they are far beyond any cloth.
#include "cli/scene/scene_keys.h"

#include <algorithm>
#include <stdexcept>

#include "cli/scene/placement_reader.h"
#include "cli/scene/scene.h"
#include "sim/mesh/selection.h"

namespace billow::cli::keys {
namespace {

constexpr Range at_least_0(double max, std::string_view unit = {}) { return {0.0, max, false, unit}; }
constexpr Range above_0(double max, std::string_view unit = {}) { return {0.0, max, true, unit}; }
constexpr Range within(double bound, std::string_view unit = {}) { return {-bound, bound, false, unit}; }
constexpr Range between(double min, double max, std::string_view unit = {}) { return {min, max, false, unit}; }

const Section scene{"the scene",
                    {{"billow"},
                     {"duration", above_0(1e5, "s")},
                     {"gravity", within(1e4, "m/s²")},
                     {"bodies"},
                     {"colliders"},
                     {"water"},
                     {"wind", {}, {"none"}},
                     {"solver"},
                     {"render"},
                     {"caches", {}, all_words<CacheFormat>()},
                     {"strip", {}, {"none"}},
                     {"spectrum", {}, {"none"}}}};

std::vector<std::string_view> alpha_words() {
  std::vector<std::string_view> all = all_words<AlphaMode>();
  all.insert(all.begin(), "auto");
  return all;
}

// With a key for each kind of body.
std::vector<Key> body_keys() {
  std::vector<Key> keys = {{"name"}};
  for (const BodyKindRow& kind : body_kinds) keys.push_back({kind.key});
  keys.insert(keys.end(), {{"contact", {}, {"none"}},
                           {"texture", {}, {"mesh", "none"}},
                           {"colour", between(0, 1)},
                           {"alpha", {}, alpha_words()}});
  return keys;
}

const Section body{"body", body_keys()};

const Section contact{
    "contact",
    {{"self", {}, {"true", "false"}}, {"thickness", above_0(1, "m"), {"auto"}}, {"friction", between(0, 100)}}};

const Section cloth{"cloth",
                    {{"mesh"},
                     {"transform"},
                     {"fabric", {}, fabric_words()},
                     {"mass", above_0(1e6, "kg"), {"fabric"}},
                     {"density", above_0(1e6, "kg/m²"), {"none"}},
                     {"mass_distribution", {}, {"area", "uniform"}},
                     {"model", {}, all_words<sim::SpringModel>()},
                     {"material", {}, {"none"}},
                     {"stiffness"},
                     {"buckling_rigidity", at_least_0(1e6, "N m²"), {"fabric"}},
                     {"strain_limit", above_0(10), {"none"}},
                     {"damping"},
                     {"velocity", within(1e4, "m/s")},
                     {"pins"}}};

const Section stiffness{"stiffness",
                        {{"structural", above_0(1e12, "N/m")},
                         {"shear", at_least_0(1e12, "N/m")},
                         {"bend", at_least_0(1e12, "N/m"), {"fabric"}},
                         {"max_eigenvalue", above_0(1e16, "s⁻²"), {"none"}}}};

const Section material{"material",
                       {{"stretch", above_0(1e12, "N/m")},
                        {"shear", above_0(1e12, "N/m"), {"isotropic"}},
                        {"bend", at_least_0(1e6, "N m")}}};

const Section damping{"damping",
                      {{"model", {}, all_words<sim::DampingModel>()},
                       {"coefficient", at_least_0(1e9, "N s/m")},
                       {"friction", at_least_0(1e9, "kg/s")}}};

const Section pin{"pin",
                  {{"corner", {}, all_words<sim::Corner>()},
                   {"vertices", at_least_0(1e9)},
                   {"box", within(1e6, "m")},
                   {"group"},
                   {"weights"},
                   {"over", within(1e6)},
                   {"motion"},
                   {"pivot", within(1e6, "m"), {"mean"}},
                   {"until", above_0(1e5, "s"), {"none"}}}};

const Section place_key{
    "the key", {{"time", between(0, 1e5, "s")}, {"translate", within(1e6, "m")}, {"rotate", within(36000, "degrees")}}};

const Section transform{"transform",
                        {{"unit", {}, all_words<LengthUnit>()},
                         {"z_up", {}, {"true", "false"}},
                         {"scale", above_0(1e6)},
                         {"rotate", within(3600, "degrees")},
                         {"translate", within(1e6, "m")}}};

const Section axis_angle{"rotate", {{"axis", within(1e6)}, {"angle", within(3600, "degrees")}}};

const Section soft{"soft",
                   {{"mesh"},
                    {"transform"},
                    {"close_holes", {}, {"true", "false"}},
                    {"mass", above_0(1e6, "kg")},
                    {"density", above_0(1e6, "kg/m³"), {"none"}},
                    {"mass_distribution", {}, {"area", "uniform"}},
                    {"material", {}, {"none"}},
                    {"stiffness"},
                    {"variation"},
                    {"damping"},
                    {"velocity", within(1e4, "m/s")},
                    {"pins"}}};

const Section soft_stiffness{"stiffness",
                             {{"structural", above_0(1e12, "N/m")},
                              {"shear", at_least_0(1e12, "N/m")},
                              {"bend", at_least_0(1e12, "N/m")},
                              {"interior", above_0(1e12, "N/m")},
                              {"max_eigenvalue", above_0(1e16, "s⁻²"), {"none"}}}};

const Section soft_material{"material", {{"young", above_0(1e12, "Pa")}}};

const Section variation{"variation", {{"stiffness"}, {"mass"}}};

const Section fish{"fish",
                   {{"skin"},
                    {"length", above_0(1e4, "m")},
                    {"mass"},
                    {"stiffness"},
                    {"viscosity", at_least_0(1e9, "N s/m")},
                    {"position", within(1e6, "m")},
                    {"heading", within(3600, "degrees")},
                    {"velocity", within(1e4, "m/s")},
                    {"buoyancy", between(0, 10)},
                    {"motion"}}};

const Section fish_mass{
    "mass", {{"snout", above_0(1e9, "kg")}, {"rings", above_0(1e9, "kg")}, {"tail_tip", above_0(1e9, "kg")}}};

const Section fish_stiffness{
    "stiffness", {{"cross", above_0(1e12, "N/m")}, {"normal", above_0(1e12, "N/m")}, {"muscle", above_0(1e12, "N/m")}}};

const Section motion{"motion",
                     {{"keys"},
                      {"transition", at_least_0(1e5, "s")},
                      {"lag", within(3600, "degrees")},
                      {"phase", within(3600, "degrees")}}};

const Section motion_key{"the key",
                         {{"time", between(0, 1e5, "s")},
                          {"swim", between(0, 1)},
                          {"turn", between(-1, 1)},
                          {"frequency", above_0(1e3, "1/s")}}};

const Section collider{"collider",
                       {{"name"},
                        {"plane"},
                        {"sphere"},
                        {"capsule"},
                        {"cylinder"},
                        {"box"},
                        {"mesh"},
                        {"thickness", above_0(1, "m")},
                        {"friction", between(0, 100)},
                        {"motion"},
                        {"pivot", within(1e6, "m"), {"centre"}},
                        {"texture", {}, {"mesh", "none"}},
                        {"colour", between(0, 1)},
                        {"alpha", {}, alpha_words()}}};

const Section plane{"plane", {{"height", within(1e6, "m")}, {"point", within(1e6, "m")}, {"normal", within(1e6)}}};

const Section sphere{"sphere", {{"centre", within(1e6, "m")}, {"radius", above_0(1e5, "m")}}};

const Section capsule{"capsule", {{"from", within(1e6, "m")}, {"to", within(1e6, "m")}, {"radius", above_0(1e5, "m")}}};

const Section cylinder{"cylinder",
                       {{"from", within(1e6, "m")}, {"to", within(1e6, "m")}, {"radius", above_0(1e5, "m")}}};

const Section box{"box",
                  {{"centre", within(1e6, "m")}, {"size", above_0(1e5, "m")}, {"rotate", within(3600, "degrees")}}};

const Section mesh{"mesh", {{"file"}, {"transform"}}};

const Section water{
    "water",
    {{"resistance", at_least_0(1e9, "kg/(m² s)")}, {"current", within(1e4, "m/s")}, {"motes", between(0, 10000)}}};

const Section wind{"wind",
                   {{"velocity", within(1e4, "m/s")},
                    {"gusts", {}, {"none"}},
                    {"drag", at_least_0(1e3)},
                    {"lift", at_least_0(1e3)},
                    {"density", at_least_0(1e5, "kg/m³")},
                    {"quadratic_to", above_0(1e5, "m/s"), {"auto"}}}};

const Section gusts{"gusts",
                    {{"strength", between(0, 10)},
                     {"period", above_0(1e5, "s")},
                     {"length", above_0(1e6, "m"), {"auto"}},
                     {"seed", between(0, 1e9)}}};

const Section solver{"solver",
                     {{"method", {}, all_words<sim::Method>()},
                      {"step", above_0(1e5, "s"), {"auto", "paper"}},
                      {"safety", {0.0, 1.0, true}},
                      {"watch", {}, {"true", "false"}},
                      {"linear_solver", {}, all_words<sim::LinearSolver>()},
                      {"tolerance", {0.0, 0.5, true}},
                      {"max_iterations", between(1, 1e6)},
                      {"filter", {}, {"none"}}}};

const Section filter{"filter",
                     {{"kernel", {}, all_words<sim::FilterKernel>()},
                      {"lambda", above_0(1e3, "per mean rest length")},
                      {"lambda_keys", between(0, 1e5)},
                      {"form", {}, all_words<sim::FilterForm>()},
                      {"target", {}, all_words<sim::FilterTarget>()},
                      {"neighbours", {}, all_words<sim::FilterNeighbours>()},
                      {"radius", above_0(100, "mean rest lengths")},
                      {"distances", {}, all_words<sim::FilterDistances>()},
                      {"passes", between(1, 100)},
                      {"ratio", between(1, 1000), {"auto"}}}};

const Section render{"render",
                     {{"size", between(16, 8192, "pixels")},
                      {"fps", above_0(1e4, "frames per second")},
                      {"samples", {}, {"1", "2", "4", "8", "16"}},
                      {"views", {}, all_words<render::View>()},
                      {"camera", {}, {"fit"}},
                      {"ground", within(1e6, "m"), {"true", "false", "shadow_only"}},
                      {"velocity_colour", {}, all_words<render::VelocityColour>()},
                      {"velocity_range", above_0(1e6, "m/s"), {"auto"}},
                      {"velocity_shading", between(0, 1)},
                      {"legend"},
                      {"background", between(0, 1), {"none"}}}};

const Section camera{"camera",
                     {{"eye", within(1e6, "m"), {"fit"}},
                      {"look_at", within(1e6, "m"), {"fit"}},
                      {"fov", between(1, 170, "degrees")},
                      {"keys"},
                      {"turntable", above_0(1e5, "s"), {"none"}},
                      {"follow"}}};

const Section camera_key{"the camera's key",
                         {{"time", between(0, 1e5, "s")},
                          {"eye", within(1e6, "m")},
                          {"look_at", within(1e6, "m")},
                          {"fov", between(1, 170, "degrees")}}};

const Section ground{"ground",
                     {{"height", within(1e6, "m")},
                      {"collide", {}, {"true", "false"}},
                      {"thickness", above_0(1, "m")},
                      {"friction", between(0, 100)},
                      {"shadow_only", {}, {"true", "false"}}}};

const Section background{"background", {{"top", between(0, 1)}, {"bottom", between(0, 1)}}};

const Section strip{"strip", {{"step", above_0(1e5, "s")}, {"order", {}, all_words<StripOrder>()}}};

const Section spectrum{"spectrum",
                       {{"step", above_0(1e5, "s")},
                        {"at", at_least_0(1e5, "s")},
                        {"range", between(10, 300, "dB")},
                        {"window", {}, all_words<render::Window>()},
                        {"body"}}};

}  // namespace

const std::vector<PlacedSection>& all() {
  static const std::vector<PlacedSection> sections{{"", &scene},
                                                   {"bodies[]", &body},
                                                   {"bodies[].contact", &contact},
                                                   {"bodies[].cloth", &cloth},
                                                   {"bodies[].cloth.transform", &transform},
                                                   {"bodies[].cloth.transform.rotate", &axis_angle},
                                                   {"bodies[].cloth.stiffness", &stiffness},
                                                   {"bodies[].cloth.material", &material},
                                                   {"bodies[].cloth.damping", &damping},
                                                   {"bodies[].cloth.pins[]", &pin},
                                                   {"bodies[].cloth.pins[].motion[]", &place_key},
                                                   {"bodies[].soft", &soft},
                                                   {"bodies[].soft.transform", &transform},
                                                   {"bodies[].soft.transform.rotate", &axis_angle},
                                                   {"bodies[].soft.stiffness", &soft_stiffness},
                                                   {"bodies[].soft.material", &soft_material},
                                                   {"bodies[].soft.variation", &variation},
                                                   {"bodies[].soft.damping", &damping},
                                                   {"bodies[].soft.pins[]", &pin},
                                                   {"bodies[].soft.pins[].motion[]", &place_key},
                                                   {"bodies[].fish", &fish},
                                                   {"bodies[].fish.mass", &fish_mass},
                                                   {"bodies[].fish.stiffness", &fish_stiffness},
                                                   {"bodies[].fish.motion", &motion},
                                                   {"bodies[].fish.motion.keys[]", &motion_key},
                                                   {"colliders[]", &collider},
                                                   {"colliders[].plane", &plane},
                                                   {"colliders[].sphere", &sphere},
                                                   {"colliders[].capsule", &capsule},
                                                   {"colliders[].cylinder", &cylinder},
                                                   {"colliders[].box", &box},
                                                   {"colliders[].box.rotate", &axis_angle},
                                                   {"colliders[].mesh", &mesh},
                                                   {"colliders[].mesh.transform", &transform},
                                                   {"colliders[].mesh.transform.rotate", &axis_angle},
                                                   {"colliders[].motion[]", &place_key},
                                                   {"water", &water},
                                                   {"wind", &wind},
                                                   {"wind.gusts", &gusts},
                                                   {"solver", &solver},
                                                   {"solver.filter", &filter},
                                                   {"render", &render},
                                                   {"render.camera", &camera},
                                                   {"render.camera.keys[]", &camera_key},
                                                   {"render.ground", &ground},
                                                   {"render.background", &background},
                                                   {"strip", &strip},
                                                   {"spectrum", &spectrum}};
  return sections;
}

const Section& section(std::string_view path) {
  const auto found = std::find_if(all().begin(), all().end(), [&](const PlacedSection& s) { return s.path == path; });
  if (found == all().end()) throw std::logic_error("no section of keys stands at " + std::string(path));
  return *found->section;
}

}  // namespace billow::cli::keys
