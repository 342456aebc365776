// Where elements of the sizes asked for have no room, smaller ones are made.
#include <algorithm>

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

/// A prism whose two long sides meet at 5 degrees.
MeshData blade() {
  MeshData data = kuhn_cube(6);
  std::erase_if(data.tets, [&](const auto& t) {
    double x_less_y = 0;
    for (const int v : t) x_less_y += data.vertices[v].x - data.vertices[v].y;
    return x_less_y < 0;
  });
  data.tet_refs.resize(data.tets.size());
  for (Vec3& p : data.vertices) p = {p.x, p.y * 0.087, p.z / 2};
  return data;
}

// Splits fill the octants of a ball, and a blade, in ways that leave elements no room, and the same
// sizes have it when they are reached from finer ones.
TEST(Room, IsFoundFromFinerSizes) {
  MeshData octants_of_ball = ball(8);
  set_refs(octants_of_ball,
           [](const Vec3& c) { return 1 + (c.x > 0) + 2 * (c.y > 0) + 4 * (c.z > 0); });
  for (const MeshData& body : {octants_of_ball, blade()}) {
    TetMesh mesh = built(body);
    const Report report = remesh(mesh, {}, {});
    expect_sound(mesh);
    EXPECT_EQ(report.finer, 1);
    EXPECT_GE(report.after.quality.mean, 0.78);
    const auto of_distance = [](const Target& t) { return t.name == "surface distance"; };
    EXPECT_EQ(std::ranges::count_if(report.targets, of_distance), 1);
  }
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
