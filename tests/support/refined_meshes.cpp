// Built from scratch at every fineness.
#include "tests/support/refined_meshes.h"

#include <array>
#include <cmath>
#include <map>
#include <random>

#include "tests/support/mesh_files.h"

namespace billow::test {

namespace {

using Points = std::vector<Eigen::Vector3d>;

bool shaken(Weave weave) { return weave == Weave::shaken_squares || weave == Weave::shaken_triangles; }

void add_square(Weave weave, const std::array<int, 4>& corner, bool flipped, std::vector<sim::Face>& faces) {
  const auto& [a, b, c, d] = corner;
  if (weave == Weave::squares || weave == Weave::shaken_squares)
    faces.push_back({a, b, c, d});
  else if (flipped)
    faces.insert(faces.end(), {{a, b, c, -1}, {a, c, d, -1}});
  else
    faces.insert(faces.end(), {{a, b, d, -1}, {b, c, d, -1}});
}

int middle(int a, int b, Points& points, std::map<std::pair<int, int>, int>& known) {
  const auto [place, fresh] = known.try_emplace(std::minmax(a, b), static_cast<int>(points.size()));
  if (fresh) points.push_back((points[a] + points[b]).normalized());
  return place->second;
}

std::vector<sim::Face> cut_in_four(const std::vector<sim::Face>& faces, Points& points) {
  std::map<std::pair<int, int>, int> known;
  std::vector<sim::Face> finer;
  for (const sim::Face& f : faces) {
    const int a = middle(f[0], f[1], points, known), b = middle(f[1], f[2], points, known);
    const int c = middle(f[2], f[0], points, known);
    finer.insert(finer.end(), {{f[0], a, c, -1}, {f[1], b, a, -1}, {f[2], c, b, -1}, {a, b, c, -1}});
  }
  return finer;
}

}  // namespace

sim::Mesh sheet(Weave weave, double length, double width, int across) {
  const int along = static_cast<int>(std::lround(across * length / width));
  const double edge = width / across;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> move(-0.2 * edge, 0.2 * edge);
  Points points;
  for (int y = 0; y <= across; ++y)
    for (int x = 0; x <= along; ++x) {
      Eigen::Vector3d p(x * edge, y * edge, 0.0);
      const bool inside = x > 0 && x < along;
      if (shaken(weave) && inside) p.x() += move(random);
      if (shaken(weave) && y > 0 && y < across) p.y() += move(random);
      if (weave == Weave::offset_rows && y % 2 == 1 && inside) p.x() += 0.5 * edge;
      points.push_back(p);
    }
  std::vector<sim::Face> faces;
  for (int y = 0; y < across; ++y)
    for (int x = 0; x < along; ++x) {
      const int a = x + y * (along + 1), d = a + along + 1;
      const bool flipped =
          weave == Weave::offset_rows ? y % 2 == 1 : weave == Weave::shaken_triangles && random() % 2 == 0;
      add_square(weave, {a, a + 1, d + 1, d}, flipped, faces);
    }
  return bare_mesh(points, faces);
}

sim::Mesh sphere(int times) {
  const double t = 0.5 * (1.0 + std::sqrt(5.0));
  Points points{{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
  for (Eigen::Vector3d& p : points) p.normalize();
  std::vector<sim::Face> faces{{0, 11, 5, -1}, {0, 5, 1, -1},  {0, 1, 7, -1},   {0, 7, 10, -1}, {0, 10, 11, -1},
                               {1, 5, 9, -1},  {5, 11, 4, -1}, {11, 10, 2, -1}, {10, 7, 6, -1}, {7, 1, 8, -1},
                               {3, 9, 4, -1},  {3, 4, 2, -1},  {3, 2, 6, -1},   {3, 6, 8, -1},  {3, 8, 9, -1},
                               {4, 9, 5, -1},  {2, 4, 11, -1}, {6, 2, 10, -1},  {8, 6, 7, -1},  {9, 8, 1, -1}};
  for (int k = 0; k < times; ++k) faces = cut_in_four(faces, points);
  return bare_mesh(points, faces);
}

sim::Mesh box(const Eigen::Vector3i& size, int fineness) {
  const Eigen::Vector3i cells = fineness * size;
  std::map<std::array<int, 3>, int> known;
  Points points;
  const auto vertex = [&](const Eigen::Vector3i& p) {
    const auto [place, fresh] = known.try_emplace({p.x(), p.y(), p.z()}, static_cast<int>(points.size()));
    if (fresh) points.push_back(p.cast<double>() / fineness);
    return place->second;
  };
  std::vector<sim::Face> faces;
  for (int axis = 0; axis < 3; ++axis) {
    const int first = (axis + 1) % 3, second = (axis + 2) % 3;
    for (int i = 0; i < cells(first); ++i)
      for (int j = 0; j < cells(second); ++j)
        for (const bool far : {false, true}) {
          Eigen::Vector3i p = Eigen::Vector3i::Zero();
          p(axis) = far ? cells(axis) : 0, p(first) = i, p(second) = j;
          const Eigen::Vector3i u = Eigen::Vector3i::Unit(first), v = Eigen::Vector3i::Unit(second);
          const int a = vertex(p), b = vertex(p + u), c = vertex(p + u + v), d = vertex(p + v);
          faces.push_back(far ? sim::Face{a, b, c, d} : sim::Face{a, d, c, b});
        }
  }
  return bare_mesh(points, faces);
}

}  // namespace billow::test
