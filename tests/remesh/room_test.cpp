// Where elements of the sizes asked for have no room, smaller ones are made.
#include "remesh/support.h"

namespace cavea::test {
namespace {

/// A bar of square section, 6 times as long as wide, whose section is one cell.
MeshData bar() {
  MeshData data = kuhn_grid(6, [](int, int j, int k) { return j == 0 && k == 0; });
  for (Vec3& p : data.vertices) p = {p.x, p.y * 0.9, p.z * 0.6};
  return data;
}

TEST(Room, IsMadeInNarrowBodies) {
  TetMesh mesh = built(bar());
  const Report report = remesh(mesh, {}, {});
  expect_sound(mesh);
  EXPECT_LT(report.finer, 1);
  EXPECT_GE(report.finer, 0.5);
  EXPECT_GE(report.after.quality.mean, 0.78);
  EXPECT_TRUE(report.targets_met());
}

TEST(Room, IsNotMadeWhereThereIsSome) {
  TetMesh mesh = built(kuhn_cube(4));
  EXPECT_EQ(remesh(mesh, {}, {}).finer, 1);
}

TEST(Room, IsNotMadeAgainstTheSizesOfTheUser) {
  Options uniform_sizes = uniform(0.3), budget;
  budget.max_tets = 60;
  for (const Options& options : {uniform_sizes, budget}) {
    TetMesh mesh = built(bar());
    EXPECT_EQ(remesh(mesh, {}, options).finer, 1);
    expect_sound(mesh);
  }
  TetMesh mesh = built(bar());
  EXPECT_EQ(remesh(mesh, [](const Vec3&) { return 0.3; }, {}).finer, 1);
}

TEST(Room, StaysWithinTheSmallestSizeOfTheUser) {
  TetMesh mesh = built(bar());
  Options options;
  options.hmin = 0.12;
  remesh(mesh, {}, options);
  for (const float size : mesh.sizes) EXPECT_GE(size, 0.12f);
}

TEST(Room, ThatTheInputHasIsKept) {
  TetMesh mesh = built(bar());
  remesh(mesh, {}, {});
  TetMesh again = built(to_data(mesh));
  remesh(again, {}, {});
  EXPECT_NEAR(double(again.tets.size()), double(mesh.tets.size()), 0.02 * double(mesh.tets.size()));
}

}  // namespace
}  // namespace cavea::test
