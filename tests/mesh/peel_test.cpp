// Flat tets that hide vertices of the boundary are taken off it.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "cavea/mesh/build.h"
#include "cavea/mesh/check.h"
#include "cavea/mesh/peel_flat.h"
#include "support/meshes.h"

namespace cavea {
namespace {

using test::Random;
using Face = std::array<std::int32_t, 3>;

/// A cube whose boundary is covered by layers of flat tets, as Delaunay hulls have them: each turns
/// an edge of the surface, or hides a vertex that has three triangles left.
class CoveredCube {
 public:
  CoveredCube(int n, std::uint64_t seed) : data_(test::kuhn_cube(n)), random_(seed) {
    const TetMesh mesh = build(data_).mesh;
    for (const Triangle& s : mesh.triangles) surface_.push_back(s.v);
  }

  void cover(int times) {
    for (int i = 0; i < times; ++i)
      if (!hide(random_triangle()[0])) turn_at(random_triangle());
    data_.triangles = surface_;
    for (const Face& f : surface_) data_.triangle_refs.push_back(side_of(f));
    data_.tet_refs.assign(data_.tets.size(), 1);
  }

  const MeshData& data() const { return data_; }
  int hidden() const { return hidden_; }

 private:
  const Face& random_triangle() {
    return surface_[std::min(std::size_t(random_.unit() * double(surface_.size())),
                             surface_.size() - 1)];
  }

  /// One to six: the side of the cube that all vertices are on; 0 if there is none.
  int side_of(const Face& f) const {
    for (int axis = 0; axis < 3; ++axis)
      for (int end = 0; end < 2; ++end)
        if (std::ranges::all_of(f, [&](std::int32_t v) {
              const Vec3& p = data_.vertices[std::size_t(v)];
              return (axis == 0 ? p.x : axis == 1 ? p.y : p.z) == end;
            }))
          return 1 + 2 * axis + end;
    return 0;
  }

  Vec3 area(std::int32_t a, std::int32_t b, std::int32_t c) const {
    const auto& p = data_.vertices;
    return cross(p[std::size_t(b)] - p[std::size_t(a)], p[std::size_t(c)] - p[std::size_t(a)]);
  }

  /// Whether triangle abc looks as `like` does and is no needle.
  bool looks_like(std::int32_t a, std::int32_t b, std::int32_t c, const Vec3& like) const {
    return dot(area(a, b, c), like) > 1e-6;
  }

  /// Turns the edge from the first to the second vertex, if its quadrangle is convex and flat.
  void turn_at(Face f) {
    const auto other =
        std::ranges::find_if(surface_, [&](const Face& g) { return third(g, f[1], f[0]) >= 0; });
    if (other == surface_.end() || side_of(f) != side_of(*other)) return;
    const std::int32_t a = f[0], b = f[1], c = f[2], d = third(*other, b, a);
    const Vec3 up = area(a, b, c);
    if (!looks_like(a, d, c, up) || !looks_like(d, b, c, up)) return;
    surface_.erase(other);
    std::erase(surface_, f);
    surface_.push_back({a, d, c}), surface_.push_back({d, b, c});
    data_.tets.push_back({a, b, c, d});
  }

  /// The vertex after the edge ab of a triangle, or -1.
  static std::int32_t third(const Face& g, std::int32_t a, std::int32_t b) {
    for (int k = 0; k < 3; ++k)
      if (g[k] == a && g[(k + 1) % 3] == b) return g[(k + 2) % 3];
    return -1;
  }

  /// Covers the three triangles around a vertex by one.
  bool hide(std::int32_t v) {
    std::vector<Face> fan;
    for (const Face& f : surface_)
      if (std::ranges::count(f, v) > 0) fan.push_back(f);
    if (fan.size() != 3) return false;
    std::map<std::int32_t, std::int32_t> next;  // around the vertex
    for (const Face& f : fan) {
      if (side_of(f) != side_of(fan[0])) return false;
      const auto k = std::size_t(std::ranges::find(f, v) - f.begin());
      next[f[(k + 1) % 3]] = f[(k + 2) % 3];
    }
    const std::int32_t a = next.begin()->first, b = next[a], c = next[b];
    for (const Face& f : fan) std::erase(surface_, f);
    surface_.push_back({a, b, c});
    data_.tets.push_back({a, b, c, v});
    ++hidden_;
    return true;
  }

  MeshData data_;
  Random random_;
  std::vector<Face> surface_;
  int hidden_ = 0;
};

double area_of_side(const TetMesh& mesh, int ref) {
  double sum = 0;
  for (const Triangle& s : mesh.triangles)
    if (s.ref == ref)
      sum += norm(cross(mesh.points[s.v[1]] - mesh.points[s.v[0]],
                        mesh.points[s.v[2]] - mesh.points[s.v[0]])) /
             2;
  return sum;
}

TEST(Peel, GivesBackTheCubeBelowLayersOfFlatTets) {
  constexpr int kCells = 4;
  int covered = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    CoveredCube cube(kCells, seed);
    cube.cover(400);
    if (cube.hidden() == 0) continue;
    ++covered;
    const BuildResult r = build(cube.data());
    EXPECT_EQ(check(r.mesh).message(), "sound");
    EXPECT_EQ(r.mesh.tets.size(), std::size_t(6 * kCells * kCells * kCells));
    EXPECT_EQ(r.mesh.triangles.size(), std::size_t(12 * kCells * kCells));
    EXPECT_EQ(r.summary.peeled_tets, r.summary.flat_tets);
    for (int side = 1; side <= 6; ++side) EXPECT_NEAR(area_of_side(r.mesh, side), 1, 1e-12);
  }
  EXPECT_GT(covered, 10);
}

TEST(Peel, LeavesFlatTetsThatHideNothing) {
  CoveredCube cube(4, 1);
  cube.cover(10);
  ASSERT_EQ(cube.hidden(), 0);
  const BuildResult r = build(cube.data());
  EXPECT_GT(r.summary.flat_tets, 0);
  EXPECT_EQ(r.summary.peeled_tets, 0);
  EXPECT_EQ(r.mesh.tets.size(), cube.data().tets.size());
}

TEST(Peel, LeavesWhatIsRequired) {
  CoveredCube cube(4, 1);
  cube.cover(400);
  ASSERT_GT(cube.hidden(), 0);
  MeshData data = cube.data();
  data.required_triangles.resize(data.triangles.size());
  std::iota(data.required_triangles.begin(), data.required_triangles.end(), 0);
  const BuildResult r = build(data);
  EXPECT_EQ(r.summary.peeled_tets, 0);
  EXPECT_EQ(r.mesh.tets.size(), data.tets.size());
}

}  // namespace
}  // namespace cavea
