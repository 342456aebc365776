#include "cavea/surface/crossings.h"

#include <gtest/gtest.h>

#include <array>

#include "cavea/base/parallel.h"
#include "cavea/mesh/build.h"
#include "support/meshes.h"

namespace cavea::test {
namespace {

/// Two cubes side by side whose facing sides are `gap` apart; negative: they overlap.
TetMesh two_cubes(double gap) {
  MeshData data = kuhn_cube(3);
  const MeshData other = data;
  const auto shift = std::int32_t(data.vertices.size());
  // Turned and moved a little, so that no edge lies in a plane of the other cube.
  for (const Vec3& p : other.vertices)
    data.vertices.push_back({1 + gap + p.x + 0.01 * p.y, p.y + 0.013, p.z + 0.017 + 0.005 * p.x});
  data.vertex_refs.resize(data.vertices.size());
  for (auto t : other.tets) {
    for (auto& v : t) v += shift;
    data.tets.push_back(t);
  }
  data.tet_refs.resize(data.tets.size());
  return build(data).mesh;
}

TEST(Crossings, NoneWhereSheetsAreApart) {
  EXPECT_TRUE(find_crossings(two_cubes(1e-9)).empty());
  EXPECT_TRUE(find_crossings(build(kuhn_cube(4)).mesh).empty());
}

TEST(Crossings, FindsSheetsThatPassThroughEachOther) {
  const TetMesh mesh = two_cubes(-0.005);
  const auto crossings = find_crossings(mesh);
  ASSERT_FALSE(crossings.empty());
  for (const Crossing& c : crossings) {
    EXPECT_LT(c.a, c.b);
    EXPECT_GT(c.where.x, 0.5);
    EXPECT_LT(c.where.x, 1.5);
  }
}

/// A surface triangle with its corners moved.
PlacedTriangle moved(const TetMesh& mesh, TriangleId t, const Vec3& by) {
  PlacedTriangle placed{mesh.triangles[t].v, {}};
  for (std::size_t k = 0; k < 3; ++k) placed.corners[k] = mesh.points[placed.v[k]] + by;
  return placed;
}

TEST(Crossings, OfATriangleThatIsNotThereYet) {
  const TetMesh mesh = two_cubes(0.1);
  int to_the_other = 0, to_nowhere = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::array replaced = {TriangleId(t)};
    const auto crosses = [&](const Vec3& by) {
      // Of new vertices: else it only touches its own neighbours.
      PlacedTriangle placed = moved(mesh, TriangleId(t), by);
      for (VertexId& v : placed.v) v += VertexId(mesh.points.size());
      return would_cross(mesh, {&placed, 1}, replaced);
    };
    to_the_other += crosses({0.3, 0.01, 0.01});
    to_nowhere += crosses({0, 0, 100});
  }
  EXPECT_GT(to_the_other, 0);
  EXPECT_EQ(to_nowhere, 0);
}

TEST(Crossings, NotWithWhatIsReplacedButWithEachOther) {
  const TetMesh mesh = two_cubes(0.1);
  PlacedTriangle a{{1000, 1001, 1002}, {{{5, 0, 0}, {6, 0, 0}, {5, 1, 0}}}};
  PlacedTriangle b{{1003, 1004, 1005}, {{{5.2, 0.2, -1}, {5.3, 0.2, 1}, {5.2, 0.9, 1}}}};
  EXPECT_FALSE(would_cross(mesh, std::array{a}, {}));
  EXPECT_TRUE(would_cross(mesh, std::array{a, b}, {}));
  b.v[0] = a.v[0], b.v[1] = a.v[1];  // no edge of one has neither of its ends on the other
  EXPECT_FALSE(would_cross(mesh, std::array{a, b}, {}));
}

TEST(Crossings, TheSameAtAnyNumberOfThreads) {
  const TetMesh mesh = two_cubes(-0.1);
  std::vector<Crossing> first;
  for (const int threads : {1, 2, 3, 8}) {
    std::vector<Crossing> found;
    run_in_arena(threads, [&] { found = find_crossings(mesh); });
    if (threads == 1) first = found;
    ASSERT_EQ(found.size(), first.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_TRUE(found[i].a == first[i].a && found[i].b == first[i].b);
  }
}

}  // namespace
}  // namespace cavea::test
