#include "cavea/surface/crossings.h"

#include <gtest/gtest.h>

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
