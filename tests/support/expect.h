#pragma once
// What the tests of many floors ask of a mesh.
#include <gtest/gtest.h>

#include <cstdint>
#include <tuple>

#include "cavea/mesh/check.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea::test {

/// Sanitizers make the engine about ten times as slow: the larger meshes are then smaller.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

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

/// The same bytes: ids, places, tags, everything. Says what differs, not how: meshes are long.
inline void expect_same(const TetMesh& a, const TetMesh& b) {
  EXPECT_TRUE(a.points == b.points) << "points";
  EXPECT_TRUE(a.sizes == b.sizes) << "sizes";
  EXPECT_TRUE(a.vertex_tags == b.vertex_tags) << "vertex_tags";
  EXPECT_TRUE(a.vertex_refs == b.vertex_refs) << "vertex_refs";
  EXPECT_TRUE(a.vertex_tets == b.vertex_tets) << "vertex_tets";
  EXPECT_TRUE(a.tets == b.tets) << "tets";
  EXPECT_TRUE(a.links == b.links) << "links";
  EXPECT_TRUE(a.qualities == b.qualities) << "qualities";
  EXPECT_TRUE(a.tet_refs == b.tet_refs) << "tet_refs";
  EXPECT_TRUE(a.tet_flags == b.tet_flags) << "tet_flags";
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  for (std::size_t s = 0; s < a.triangles.size(); ++s) {
    const Triangle &x = a.triangles[s], &y = b.triangles[s];
    EXPECT_EQ(std::tie(x.v, x.sides, x.ref, x.patch, x.edge_tag, x.edge_ref, x.tags),
              std::tie(y.v, y.sides, y.ref, y.patch, y.edge_tag, y.edge_ref, y.tags));
  }
  ASSERT_EQ(a.anchors.size(), b.anchors.size());
  for (std::size_t v = 0; v < a.anchors.size(); ++v) {
    const Anchor &x = a.anchors[v], &y = b.anchors[v];
    EXPECT_EQ(std::tie(x.facet, x.u, x.v), std::tie(y.facet, y.u, y.v)) << "anchor of vertex " << v;
  }
}

}  // namespace cavea::test
