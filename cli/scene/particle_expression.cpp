// Evaluating formulas with muParser.
#include "cli/scene/particle_expression.h"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/suggest.h"
#include "cli/text/text_file.h"
#include "sim/mesh/selection.h"

namespace billow::cli {

namespace {

// Nobody writes longer ones, and tables and plots show them.
constexpr std::size_t longest_formula = 1000;

/// Says what is wrong at byte `place` of a formula.
[[noreturn]] void refuse(std::string_view formula, std::size_t place, std::string_view reason) {
  place = std::min(place, formula.size());
  throw InputError(fmt::format("in the formula '{}', at its character {}: {}", shortened_around(formula, place),
                               character_count(formula.substr(0, place)) + 1, reason));
}

// muParser sets variables: 'x=3' would move the particle.
bool is_assignment(std::string_view formula, std::size_t k) {
  const char before = k > 0 ? formula[k - 1] : ' ', after = k + 1 < formula.size() ? formula[k + 1] : ' ';
  return formula[k] == '=' && after != '=' && std::string_view("=<>!").find(before) == std::string_view::npos;
}

// What muParser would take for something else than it is.
void check_characters(std::string_view formula) {
  if (character_count(formula) > longest_formula)
    throw InputError(fmt::format("the formula '{}' has {} characters; at most {} are read", shortened(formula),
                                 character_count(formula), longest_formula));
  if (formula.find_first_not_of(" \t\r\n") == std::string_view::npos) throw InputError("the formula is empty");
  bool in_text = false;
  for (std::size_t k = 0; k < formula.size(); ++k) {
    if (formula[k] == '"' && (k == 0 || formula[k - 1] != '\\')) in_text = !in_text;
    if (formula[k] == '\0') refuse(formula.substr(0, k), k, "a character 0 follows");
    if (!in_text && is_assignment(formula, k)) refuse(formula, k, "'=' sets nothing here; equal is '=='");
  }
}

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

mu::value_type in_group(void* user, const mu::char_type* name) {
  const Particle& particle = *static_cast<const Particle*>(user);
  const auto group = particle.mesh->group.find(name);
  if (group == particle.mesh->group.end()) sim::select_vertices(*particle.mesh, sim::GroupName{name});  // throws
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

// A token that is no name may go on to the end of the formula.
std::string unknown_token(const mu::Parser& parser, std::string_view token) {
  const bool is_name = !token.empty() && (std::isalpha(static_cast<unsigned char>(token[0])) || token[0] == '_');
  const std::string shown = shortened(token.substr(0, token.find(' ')));
  if (!is_name) return fmt::format("'{}' means nothing here", shown);
  if (parser.GetFunDef().contains(std::string(token)))
    return fmt::format("'{}' needs values, as in {}(…)", shown, shown);
  std::vector<std::string_view> known;
  for (const auto& [name, value] : parser.GetVar()) known.push_back(name);
  for (const auto& [name, function] : parser.GetFunDef()) known.push_back(name);
  return fmt::format("there is no '{}'{}", shown, suggestion(token, known, "known are"));
}

// In our words: muParser's repeat the whole formula, and speak of tokens.
std::string reason_of(const mu::Parser& parser, const mu::ParserError& error) {
  const std::string token = shortened(error.GetToken());
  switch (error.GetCode()) {
    case mu::ecUNASSIGNABLE_TOKEN:
    case mu::ecINVALID_NAME:
      return unknown_token(parser, error.GetToken());
    case mu::ecUNEXPECTED_EOF:
    case mu::ecEMPTY_EXPRESSION:
      return "it ends too early";
    case mu::ecMISSING_PARENS:
      return "a parenthesis is not closed";
    case mu::ecUNTERMINATED_STRING:
      return "a text is not closed";
    case mu::ecMISSING_ELSE_CLAUSE:
    case mu::ecMISPLACED_COLON:
      return "'?' and ':' belong together, as in 'x > 0 ? 1 : 2'";
    case mu::ecTOO_MANY_PARAMS:
      return fmt::format("'{}' is given too many values", token);
    case mu::ecTOO_FEW_PARAMS:
      return fmt::format("'{}' is given too few values", token);
    case mu::ecSTRING_EXPECTED:
      return fmt::format("'{}' needs a text, as in group(\"NAME\")", token);
    case mu::ecVAL_EXPECTED:
    case mu::ecSTR_RESULT:
    case mu::ecUNEXPECTED_STR:
      return "a text is no number";
    case mu::ecDIV_BY_ZERO:
      return "it divides by 0";
    default:
      return token.empty() ? "something is out of place" : fmt::format("'{}' is out of place", token);
  }
}

double value_at(const mu::Parser& parser, const std::string& formula, const Particle& particle) {
  const double value = parser.Eval();
  if (std::isfinite(value)) return value;
  throw InputError(fmt::format("the formula '{}' has no finite value at vertex {} ({:.4g}, {:.4g}, {:.4g})",
                               shortened(formula), particle.index, particle.x, particle.y, particle.z));
}

// Known once it has been evaluated.
void check_is_one_value(const mu::Parser& parser, std::string_view formula) {
  if (parser.GetNumResults() != 1)
    throw InputError(
        fmt::format("the formula '{}' has {} values, set apart by commas; it must have one, and a decimal "
                    "sign is a point",
                    shortened(formula), parser.GetNumResults()));
}

}  // namespace

Eigen::VectorXd evaluate_at_particles(const std::string& expression, const Eigen::MatrixX3d& position,
                                      const sim::Mesh& mesh) {
  check_characters(expression);
  Particle particle;
  particle.mesh = &mesh;
  Eigen::VectorXd values(position.rows());
  mu::Parser parser;
  try {
    define_names(parser, particle);
    parser.SetExpr(expression);
    for (int i = 0; i < position.rows(); ++i) {
      particle.move_to(i, position);
      values(i) = value_at(parser, expression, particle);
      if (i == 0) check_is_one_value(parser, expression);
    }
  } catch (const mu::ParserError& error) {
    const int place = error.GetPos();
    refuse(expression, place < 0 ? expression.size() : static_cast<std::size_t>(place), reason_of(parser, error));
  }
  return values;
}

}  // namespace billow::cli
