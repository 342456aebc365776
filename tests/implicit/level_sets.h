#pragma once
// Level sets that the tests of this folder share, and what is asked of their interfaces.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <vector>

#include "cavea/implicit/level_set.h"
#include "cavea/mesh/tet_mesh.h"
#include "support/meshes.h"

namespace cavea::test {

using Function = std::function<double(const Vec3&)>;

/// At the mesh's vertices.
inline std::vector<double> values_of(const TetMesh& mesh, const Function& f) {
  std::vector<double> values;
  for (const Vec3& p : mesh.points) values.push_back(f(p));
  return values;
}

inline double sphere(const Vec3& p) { return norm(p - Vec3{0.5, 0.5, 0.5}) - 0.3; }

/// A sum of four waves.
struct Waves {
  struct Wave {
    Vec3 way;
    double phase, height;
  };
  std::vector<Wave> waves;

  explicit Waves(Random& random) : waves(4) {
    for (Wave& w : waves)
      w = {{random.between(-8, 8), random.between(-8, 8), random.between(-8, 8)},
           random.between(0, 2 * std::numbers::pi),
           random.between(0.3, 1)};
  }
  double operator()(const Vec3& p) const {
    double sum = 0;
    for (const auto& [way, phase, height] : waves) sum += height * std::sin(dot(way, p) + phase);
    return sum;
  }
  Vec3 gradient(const Vec3& p) const {
    Vec3 sum;
    for (const auto& [way, phase, height] : waves)
      sum += way * (height * std::cos(dot(way, p) + phase));
    return sum;
  }
  LevelSet level_set() const {
    return {*this, [waves = *this](const Vec3& p) { return waves.gradient(p); }};
  }
};

/// Two triangles of the interface are at each of its edges, but at those on the unit cube's sides.
inline void expect_closed_manifold(const TetMesh& mesh) {
  const auto on_same_side = [](const Vec3& a, const Vec3& b) {
    constexpr double kOnSide = 1e-9;
    for (int k = 0; k < 3; ++k)
      for (const double side : {0.0, 1.0})
        if (std::abs(a[k] - side) < kOnSide && std::abs(b[k] - side) < kOnSide) return true;
    return false;
  };
  std::map<std::pair<VertexId, VertexId>, int> uses;
  for (const Triangle& s : mesh.triangles)
    if (s.ref == 10)
      for (int k = 0; k < 3; ++k) ++uses[std::minmax(s.v[k], s.v[(k + 1) % 3])];
  EXPECT_FALSE(uses.empty());
  for (const auto& [edge, count] : uses)
    if (!on_same_side(mesh.points[edge.first], mesh.points[edge.second])) {
      EXPECT_EQ(count, 2);
    }
}

}  // namespace cavea::test
