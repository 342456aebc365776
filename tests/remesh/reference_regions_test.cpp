#include "cavea/remesh/reference_regions.h"

#include "remesh/support.h"

namespace cavea::test {
namespace {

TEST(ReferenceRegions, AreLostWhereNoTriangleOfTheReferenceIsNear) {
  constexpr double kReach = 0.01;
  TetMesh mesh = built(kuhn_cube(4));
  for (Triangle& t : mesh.triangles) t.ref = mesh.points[t.v[0]].x < 0.3 ? 1 : 2;
  const ReferenceRegions regions(mesh);
  EXPECT_TRUE(regions.lost_from(mesh, kReach).empty());
  TetMesh moved = mesh;
  for (Vec3& p : moved.points) p.y += 0.9 * kReach;
  EXPECT_TRUE(regions.lost_from(moved, kReach).empty());
  for (Triangle& t : moved.triangles)
    if (moved.points[t.v[0]].x == 0) t.ref = 2;
  const std::vector<FailedPlace> lost = regions.lost_from(moved, kReach);
  ASSERT_FALSE(lost.empty());
  for (const FailedPlace& place : lost) {
    EXPECT_LT(place.center.x, 0.3);
    EXPECT_GT(place.radius, 0.25);
  }
  for (Triangle& t : moved.triangles) t.ref = 3;
  EXPECT_EQ(regions.lost_from(moved, kReach).size(), mesh.triangles.size());
}

}  // namespace
}  // namespace cavea::test
