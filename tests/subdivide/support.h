#pragma once
#include <gtest/gtest.h>

#include <functional>

#include "cavea/mesh/build.h"
#include "cavea/mesh/check.h"
#include "cavea/subdivide/subdivide.h"
#include "support/meshes.h"

namespace cavea::test {

/// A coin for each edge that depends on its ends alone: heads with the given probability.
inline SplitTest coin(std::uint64_t seed, double probability) {
  return [=](const MeshEdge& e) {
    return Random(seed * 1000003 + std::uint64_t(e.a) * 65537 + std::uint64_t(e.b)).unit() <
           probability;
  };
}

inline bool every_edge(const MeshEdge&) { return true; }

inline Placement straight(const TetMesh& mesh) {
  return [&mesh](const MeshEdge& e) { return straight_midpoint(mesh, e); };
}

inline double volume(const TetMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (!mesh.tet_alive(TetId(t))) continue;
    const auto [a, b, c, d] = mesh.corners(TetId(t));
    sum += volume6(a, b, c, d) / 6;
  }
  return sum;
}

inline void expect_sound(const TetMesh& mesh, const CheckOptions& options = {}) {
  const CheckResult result = check(mesh, options);
  EXPECT_TRUE(result.sound()) << result.message();
}

inline void expect_same(const TetMesh& a, const TetMesh& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.sizes, b.sizes);
  EXPECT_EQ(a.vertex_tags, b.vertex_tags);
  EXPECT_EQ(a.vertex_refs, b.vertex_refs);
  EXPECT_EQ(a.vertex_tets, b.vertex_tets);
  EXPECT_EQ(a.tets, b.tets);
  EXPECT_EQ(a.links, b.links);
  EXPECT_EQ(a.qualities, b.qualities);
  EXPECT_EQ(a.tet_refs, b.tet_refs);
  EXPECT_EQ(a.tet_flags, b.tet_flags);
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  for (std::size_t s = 0; s < a.triangles.size(); ++s) {
    const Triangle &x = a.triangles[s], &y = b.triangles[s];
    EXPECT_EQ(std::tie(x.v, x.sides, x.ref, x.patch, x.edge_tag, x.edge_ref, x.tags),
              std::tie(y.v, y.sides, y.ref, y.patch, y.edge_tag, y.edge_ref, y.tags));
  }
}

}  // namespace cavea::test
