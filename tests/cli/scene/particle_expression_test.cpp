// Formulas over particles.
#include "cli/scene/particle_expression.h"

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
  EXPECT_NE(error_of("1 + ").find("the expression '1 + ' cannot be evaluated: "), std::string::npos);
  EXPECT_NE(error_of("q").find("cannot be evaluated"), std::string::npos);
  EXPECT_EQ(error_of("group(\"hm\")"), "the mesh has no group 'hm'; its groups are: hem");
  EXPECT_EQ(error_of("1 / x").rfind("the expression has no finite value at vertex 0 (", 0), 0u);
}

}  // namespace
}  // namespace billow::cli
