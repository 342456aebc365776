// Where elements of the sizes asked for have no room, smaller ones are made.
#include <algorithm>
#include <cmath>
#include <numbers>

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

/// A prism over a star of twelve points, each a wedge of 19 degrees: too blunt to pass for a thin
/// wall, and too narrow for the sizes wanted.
MeshData star_prism() {
  constexpr int kSides = 24, kLayers = 4;
  MeshData data;
  for (int layer = 0; layer <= kLayers; ++layer) {
    const double z = 3.0 * layer / kLayers;
    data.vertices.push_back({0, 0, z});
    for (int i = 0; i < kSides; ++i) {
      const double r = i % 2 == 0 ? 3 : 1.2, angle = 2 * std::numbers::pi * i / kSides;
      data.vertices.push_back({r * std::cos(angle), r * std::sin(angle), z});
    }
  }
  const auto add = [&](std::array<int, 4> t) {
    const auto& x = data.vertices;
    if (dot(cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]), x[t[3]] - x[t[0]]) < 0)
      std::swap(t[0], t[1]);
    data.tets.push_back(t);
  };
  constexpr int kUp = kSides + 1;
  for (int base = 0; base < kLayers * kUp; base += kUp)
    for (int i = 0; i < kSides; ++i) {
      const int a = base + 1 + std::min(i, (i + 1) % kSides);
      const int b = base + 1 + std::max(i, (i + 1) % kSides);
      add({base, a, b, b + kUp});
      add({base, a, a + kUp, b + kUp});
      add({base, base + kUp, a + kUp, b + kUp});
    }
  data.vertex_refs.assign(data.vertices.size(), 0);
  data.tet_refs.assign(data.tets.size(), 1);
  return data;
}

TEST(Room, IsMadeInPointsOfAStar) {
  TetMesh mesh = built(star_prism());
  const Report report = remesh(mesh, {}, {});
  expect_sound(mesh);
  EXPECT_LT(report.finer, 0.512);
  EXPECT_GE(report.after.quality.mean, 0.78);
}

// A mesh that may have made room is mended first; where that finds none, other sizes are tried on
// the input, which must be whole by then.
TEST(Room, IsLookedForOnWhereMendingFindsNone) {
  TetMesh first = built(bar());
  remesh(first, {}, uniform(0.5));
  TetMesh mesh = built(to_data(first));
  const Report report = remesh(mesh, {}, {});
  expect_sound(mesh);
  EXPECT_LT(report.finer, 1);
  EXPECT_NEAR(volume(mesh), volume(first), 1e-12);
}

/// A prism whose two long sides meet at 4 degrees.
MeshData blade() {
  return mapped(half_cube(6), [](const Vec3& p) { return Vec3{p.x, p.y * 0.07, p.z / 1.5}; });
}

// Splits fill the octants of a ball, and a blade, in ways that leave elements no room, and the same
// sizes have it when they are reached from finer ones.
TEST(Room, IsFoundFromFinerSizes) {
  MeshData octants_of_ball = ball(10);
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

/// A cube with a pyramid on each side.
MeshData star() {
  MeshData data;
  data.vertices = {{-1, -1, -1}, {-1, 1, -1}, {0, 0, -4}, {1, 1, -1}, {1, -1, -1},
                   {4, 0, 0},    {1, -1, 1},  {1, 1, 1},  {0, 0, 4},  {-1, -1, 1},
                   {-1, 1, 1},   {-4, 0, 0},  {0, 4, 0},  {0, -4, 0}};
  data.tets = {{6, 13, 0, 4}, {7, 5, 6, 3},  {0, 10, 11, 9}, {10, 0, 11, 1}, {3, 0, 2, 4},
               {0, 9, 13, 6}, {8, 9, 10, 7}, {9, 8, 6, 7},   {0, 3, 2, 1},   {1, 7, 12, 10},
               {7, 1, 12, 3}, {3, 5, 6, 4},  {0, 1, 7, 3},   {0, 10, 9, 7},  {0, 1, 10, 7},
               {6, 0, 9, 7},  {7, 6, 0, 3},  {3, 6, 0, 4}};
  data.vertex_refs.assign(data.vertices.size(), 0);
  data.tet_refs.assign(data.tets.size(), 1);
  return data;
}

// Sizes of 0.8 leave it no room, but where they are reached from 0.64.
TEST(Room, IsMadeByNoFinerSizesThanItTakes) {
  TetMesh mesh = built(star());
  const Report report = remesh(mesh, {}, {});
  expect_sound(mesh);
  EXPECT_EQ(report.finer, 0.8);
  EXPECT_GE(report.after.quality.mean, 0.78);
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
