#include "cavea/mesh/fill_holes.h"

#include "cavea/mesh/compact.h"
#include "part/support.h"

namespace cavea::test {
namespace {

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
