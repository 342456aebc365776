// Internal surface triangles stay where they are, with their reference.
#include <set>

#include "remesh/support.h"
#include "support/sheets.h"

namespace cavea::test {
namespace {

constexpr BuildOptions kKeep{.keep_internal = true};

struct Body {
  std::string name;
  MeshData data;
  Options options;
};

template <class Within>
MeshData cube_with_sheet(int n, Within&& within) {
  MeshData data = kuhn_cube(n);
  add_plane_sheet(data, within);
  return data;
}

/// Two sheets that cross in a line, and end inside.
MeshData cross_of_sheets(int n) {
  MeshData data = kuhn_cube(n);
  add_sheet(data, [](const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 m = (a + b + c) / 3;
    const bool in_x = a.x == 0.5 && b.x == 0.5 && c.x == 0.5;
    const bool in_y = a.y == 0.5 && b.y == 0.5 && c.y == 0.5;
    return (in_x || in_y) && m.z > 0.25 && m.z < 0.75;
  });
  return data;
}

std::vector<Body> bodies() {
  const auto middle = [](double y, double z) { return y > 0.2 && y < 0.8 && z > 0.2 && z < 0.8; };
  const auto half = [](double, double z) { return z < 0.5; };
  const auto all = [](double, double) { return true; };
  return {{"floating", cube_with_sheet(4, middle), uniform(0.09)},
          {"coarsened", cube_with_sheet(kSanitized ? 6 : 10, middle), uniform(0.3)},
          {"ending", cube_with_sheet(4, half), uniform(0.09)},
          {"parting", cube_with_sheet(4, all), uniform(0.09)},
          {"parts", cube_with_sheet(kSanitized ? 8 : 14, half), uniform(0.08)},
          {"cross", cross_of_sheets(4), uniform(0.1)},
          {"sized", cube_with_sheet(4, middle), {}}};
}

class PlaneSheet : public testing::TestWithParam<std::size_t> {};

TEST_P(PlaneSheet, Stays) {
  const Body body = bodies()[GetParam()];
  TetMesh mesh = build(body.data, kKeep).mesh;
  TetMesh start = mesh;
  const Report report = remesh(mesh, {}, body.options);
  expect_sound(mesh);
  expect_good(report);
  classify_features(start, {});
  Shape(start).expect_polyhedron(mesh);
  EXPECT_GT(area_of_ref(mesh)[kSheetRef], 0.2);
}

INSTANTIATE_TEST_SUITE_P(All, PlaneSheet, testing::Range<std::size_t>(0, bodies().size()),
                         [](const auto& number) { return bodies()[number.param].name; });

TEST(Internal, DiskInABallKeepsItsRimOnTheSphere) {
  MeshData data = ball(8);
  add_sheet(data, [](const Vec3& a, const Vec3& b, const Vec3& c) {
    return a.x == 0 && b.x == 0 && c.x == 0;
  });
  TetMesh mesh = build(data, kKeep).mesh;
  const Euler before = euler(mesh);
  Options options;
  options.hausd = 0.005;
  remesh(mesh, {}, options);
  expect_sound(mesh);
  EXPECT_EQ(euler(mesh), before);
  EXPECT_NEAR(area_of_ref(mesh)[kSheetRef], std::numbers::pi, 0.02 * std::numbers::pi);
  for (const Triangle& s : mesh.triangles) {
    if (!(s.tags & tag::kInternal)) continue;
    for (const VertexId v : s.v) EXPECT_NEAR(mesh.points[v].x, 0, 1e-9);
  }
}

TEST(Internal, ScatteredTrianglesStay) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    MeshData data = kuhn_cube(4);
    perturb_inside(data, 0.02, seed);
    add_sheet(data, [&](const Vec3&, const Vec3&, const Vec3&) { return random.unit() < 0.03; });
    TetMesh mesh = build(data, kKeep).mesh;
    const auto area = area_of_ref(mesh);
    const Euler before = euler(mesh);
    Options options = uniform(0.12);
    options.angle = 30;
    remesh(mesh, {}, options);
    expect_sound(mesh);
    EXPECT_EQ(euler(mesh), before);
    // Where two of them meet bluntly the model rounds the fold.
    expect_near(area_of_ref(mesh), area, 0.01);
  }
}

/// The corners of internal triangles that are required.
std::set<std::array<std::array<double, 3>, 3>> required_inside(const TetMesh& mesh) {
  std::set<std::array<std::array<double, 3>, 3>> found;
  for (const Triangle& t : mesh.triangles) {
    if (!t.alive() || !(t.tags & tag::kRequired) || !(t.tags & tag::kInternal)) continue;
    std::array<std::array<double, 3>, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = mesh.points[t.v[k]];
      corners[k] = {p.x, p.y, p.z};
    }
    std::ranges::sort(corners);
    found.insert(corners);
  }
  return found;
}

TEST(RequiredInside, StayToTheBitThoughOtherInternalTrianglesGo) {
  MeshData data = cube_with_sheet(
      4, [](double y, double z) { return y > 0.2 && y < 0.8 && z > 0.2 && z < 0.8; });
  data.required_triangles = {0, 3, 4};
  TetMesh mesh = build(data).mesh;
  const auto before = required_inside(mesh);
  ASSERT_EQ(before.size(), 3u);
  for (const double size : {0.3, 0.1}) {
    SCOPED_TRACE(size);
    expect_good(remesh(mesh, {}, uniform(size)));
    expect_sound(mesh);
    EXPECT_EQ(required_inside(mesh), before);
  }
}

}  // namespace
}  // namespace cavea::test
