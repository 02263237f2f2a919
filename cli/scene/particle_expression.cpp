// Evaluating formulas with muParser.
#include "cli/scene/particle_expression.h"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace billow::cli {

namespace {

/// What the expression's names stand for at the particle under evaluation.
struct Particle {
  double x = 0.0, y = 0.0, z = 0.0, red = 1.0, green = 1.0, blue = 1.0;
  int index = 0;
  const sim::Mesh* mesh = nullptr;

  void move_to(int i, const Eigen::MatrixX3d& position) {
    index = i;
    x = position(i, 0), y = position(i, 1), z = position(i, 2);
    if (i >= mesh->colour.rows()) return;
    red = mesh->colour(i, 0), green = mesh->colour(i, 1), blue = mesh->colour(i, 2);
  }
};

std::string known_groups(const sim::Mesh& mesh) {
  if (mesh.group.empty()) return "it has none";
  std::string names;
  for (const auto& [name, vertices] : mesh.group) names += (names.empty() ? "" : ", ") + name;
  return "its groups are: " + names;
}

mu::value_type in_group(void* user, const mu::char_type* name) {
  const Particle& particle = *static_cast<const Particle*>(user);
  const auto group = particle.mesh->group.find(name);
  if (group == particle.mesh->group.end())
    throw InputError(fmt::format("the mesh has no group '{}'; {}", name, known_groups(*particle.mesh)));
  return std::binary_search(group->second.begin(), group->second.end(), particle.index) ? 1.0 : 0.0;
}

void define_names(mu::Parser& parser, Particle& particle) {
  parser.DefineVar("x", &particle.x);
  parser.DefineVar("y", &particle.y);
  parser.DefineVar("z", &particle.z);
  parser.DefineVar("red", &particle.red);
  parser.DefineVar("green", &particle.green);
  parser.DefineVar("blue", &particle.blue);
  parser.DefineFunUserData("group", in_group, &particle, false);
}

double value_at(mu::Parser& parser, const Particle& particle) {
  const double value = parser.Eval();
  if (std::isfinite(value)) return value;
  throw InputError(fmt::format("the expression has no finite value at vertex {} ({:.4g}, {:.4g}, {:.4g})",
                               particle.index, particle.x, particle.y, particle.z));
}

}  // namespace

Eigen::VectorXd evaluate_at_particles(const std::string& expression, const Eigen::MatrixX3d& position,
                                      const sim::Mesh& mesh) {
  Particle particle;
  particle.mesh = &mesh;
  Eigen::VectorXd values(position.rows());
  try {
    mu::Parser parser;
    define_names(parser, particle);
    parser.SetExpr(expression);
    for (int i = 0; i < position.rows(); ++i) {
      particle.move_to(i, position);
      values(i) = value_at(parser, particle);
    }
  } catch (const mu::ParserError& error) {
    throw InputError(fmt::format("the expression '{}' cannot be evaluated: {}", expression, error.GetMsg()));
  }
  return values;
}

}  // namespace billow::cli
