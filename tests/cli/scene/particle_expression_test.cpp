// Formulas over particles.
#include "cli/scene/particle_expression.h"

#include <fmt/format.h>

#include "base/error.h"
#include "tests/support/mesh_files.h"

namespace billow::cli {
namespace {

sim::Mesh painted_grid() {
  sim::Mesh mesh = test::quad_grid(3, 2);
  mesh.colour = Eigen::MatrixX3f::Constant(6, 3, 0.25f);
  mesh.group["hem"] = {1, 4};
  return mesh;
}

Eigen::VectorXd values(const std::string& expression) {
  const sim::Mesh mesh = painted_grid();
  return evaluate_at_particles(expression, mesh.position, mesh);
}

std::string error_of(const std::string& expression) {
  try {
    values(expression);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ParticleExpression, SeesPositionColourAndGroup) {
  const sim::Mesh mesh = painted_grid();
  EXPECT_EQ(values("x + 10 * z"), Eigen::VectorXd(mesh.position.col(0) + 10.0 * mesh.position.col(2)));
  EXPECT_EQ(values("4 * red + blue - green"), Eigen::VectorXd::Ones(6));
  Eigen::VectorXd hem(6);
  hem << 2, 0.5, 2, 2, 0.5, 2;
  EXPECT_EQ(values("group(\"hem\") ? 0.5 : 2"), hem);
}

TEST(ParticleExpression, TakesColoursAsWhiteWithoutAny) {
  const sim::Mesh mesh = test::quad_grid(2, 2);
  EXPECT_EQ(evaluate_at_particles("red * green * blue", mesh.position, mesh), Eigen::VectorXd::Ones(4));
}

TEST(ParticleExpression, SaysWhatIsWrong) {
  const auto in = [](const std::string& formula, int place, const std::string& reason) {
    return fmt::format("in the formula '{}', at its character {}: {}", formula, place, reason);
  };
  EXPECT_EQ(error_of("1 + "), in("1 + ", 5, "it ends too early"));
  EXPECT_EQ(error_of("2 * sqtr(x)"), in("2 * sqtr(x)", 5, "there is no 'sqtr'; did you mean 'sqrt'?"));
  EXPECT_EQ(error_of("sqrt"), in("sqrt", 1, "'sqrt' needs values, as in sqrt(…)"));
  EXPECT_EQ(error_of("sin(x, 1)"), in("sin(x, 1)", 9, "'sin' is given too many values"));
  EXPECT_EQ(error_of("group(x)"), in("group(x)", 9, "'group' needs a text, as in group(\"NAME\")"));
  EXPECT_EQ(error_of("\"hem\""), in("\"hem\"", 6, "a text is no number"));
  EXPECT_EQ(error_of("((x"), in("((x", 4, "a parenthesis is not closed"));
  EXPECT_EQ(error_of("x ? 1"), in("x ? 1", 6, "'?' and ':' belong together, as in 'x > 0 ? 1 : 2'"));
  EXPECT_EQ(error_of("ä + 1"), in("ä + 1", 1, "'ä' means nothing here"));
  EXPECT_EQ(error_of(std::string("x\0", 2)), in("x", 2, "a character 0 follows"));
  EXPECT_EQ(error_of("group(\"hm\")"), "there is no group 'hm' in the mesh; did you mean 'hem'? it has 'hem'");
  EXPECT_EQ(error_of("1 / x").rfind("the formula '1 / x' has no finite value at vertex 0 (", 0), 0u);
}

TEST(ParticleExpression, HasOneValue) {
  for (const char* none : {"", " ", "\t\n"}) EXPECT_EQ(error_of(none), "the formula is empty");
  EXPECT_EQ(error_of("1,2,3"),
            "the formula '1,2,3' has 3 values, set apart by commas; it must have one, and a decimal sign is a point");
  EXPECT_EQ(error_of("max(1, 2)"), "");
}

TEST(ParticleExpression, SetsNothing) {
  for (const char* formula : {"x=3", "x = y = 1", "3=x", "(x)=3", "x += 1", "x==3=y"})
    EXPECT_NE(error_of(formula).find("'=' sets nothing here; equal is '=='"), std::string::npos) << formula;
  for (const char* formula : {"x==3", "x<=3", "x>=3", "x!=3", "group(\"hem\") == 1"})
    EXPECT_EQ(error_of(formula), "") << formula;
}

TEST(ParticleExpression, IsShownAroundItsFaultAlone) {
  const std::string sum = fmt::format("{}q{}", std::string(400, ' ') + "1 + ", std::string(400, ' ') + "+ 1");
  EXPECT_LT(error_of(sum).size(), 300u);
  EXPECT_NE(error_of(sum).find("1 + q   "), std::string::npos) << error_of(sum);
  const std::string deep = std::string(100'000, '(') + "x" + std::string(100'000, ')');
  EXPECT_EQ(error_of(deep),
            "the formula '(((((((((((((((((((((((((((((((((((((...' has 200001 characters; at most 1000 are read");
  EXPECT_EQ(error_of(std::string(499, '(') + "x" + std::string(499, ')')), "");
}

}  // namespace
}  // namespace billow::cli
