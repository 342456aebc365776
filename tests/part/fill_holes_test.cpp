#include "cavea/mesh/fill_holes.h"

#include "cavea/mesh/compact.h"
#include "cavea/pass/cycle.h"
#include "part/support.h"

namespace cavea::test {
namespace {

/// A mesh after a cycle in place, which has left holes of all kinds.
TetMesh with_holes(const MeshData& data, std::uint64_t seed) {
  TetMesh mesh = classified(data);
  const SurfaceModel surface{mesh, {0.01, 0.03, 0.01, 1}};
  Random random(seed);
  for (float& size : mesh.sizes) size = float(random.between(0.2, 0.8));
  for (std::uint8_t& flags : mesh.tet_flags) flags |= tet_flag::kAskAll;
  run_cycle(mesh, surface, {});
  return mesh;
}

TEST(FillHoles, LeavesTheMeshThatCompactLeaves) {
  bool had_holes = false;
  for (const NamedMesh& named : meshes_to_cut())
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      SCOPED_TRACE(testing::Message() << named.name << ", seed " << seed);
      TetMesh filled = with_holes(named.data, seed), compacted = filled;
      std::vector<std::int32_t> alive;
      for (const auto& tet : filled.tets) alive.push_back(tet[0] != kNone);
      const std::size_t before = filled.tets.size();
      fill_holes(filled, &alive);
      compact(compacted);
      had_holes |= filled.tets.size() < before;
      expect_sound(filled);
      const Canonical left(filled), expected(compacted);
      EXPECT_EQ(left.vertices, expected.vertices);
      EXPECT_EQ(left.tets, expected.tets);
      EXPECT_EQ(left.triangles, expected.triangles);
      EXPECT_EQ(filled.points.size(), compacted.points.size());
      EXPECT_EQ(alive, std::vector<std::int32_t>(compacted.tets.size(), 1));
    }
  EXPECT_TRUE(had_holes);
}

}  // namespace
}  // namespace cavea::test
