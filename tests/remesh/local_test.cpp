// Parameters by reference and regions, in whole runs.
#include <algorithm>

#include "cavea/base/error.h"
#include "remesh/refused.h"
#include "remesh/support.h"

namespace cavea::test {
namespace {

using Entity = LocalParameters::Entity;

double mean_length_in(const TetMesh& mesh, const std::function<bool(const Vec3&)>& inside) {
  double sum = 0;
  int edges = 0;
  for (const auto& tet : mesh.tets)
    for (const auto& e : kEdgeVertices) {
      const Vec3 &a = mesh.points[tet[e[0]]], &b = mesh.points[tet[e[1]]];
      if (inside(a) && inside(b)) sum += distance(a, b), ++edges;
    }
  EXPECT_GT(edges, 0);
  return sum / edges;
}

TEST(Local, RegionsAreFoundHoweverCoarseTheMesh) {
  for (const std::optional<double> hgrad : {std::optional(1.3), std::optional<double>()}) {
    TetMesh mesh = built(kuhn_cube(1));
    Options options;
    options.hgrad = hgrad;
    options.hmax = 0.3;
    options.size_regions = {SizeSphere{{0.41, 0.37, 0.55}, 0.08, 0.02}};
    const Report report = remesh(mesh, {}, options);
    expect_sound(mesh);
    EXPECT_GE(report.after.quality.worst, 0.1);
    const auto inside = [](const Vec3& p) { return distance(p, {0.41, 0.37, 0.55}) < 0.08; };
    EXPECT_NEAR(mean_length_in(mesh, inside), 0.02, 0.004);
  }
}

TEST(Local, BoundsHoldWhereTheReferenceIs) {
  TetMesh mesh = built(two_halves(4));
  Options options;
  options.hmax = 0.2;
  options.hgrad = 2;
  options.local = {{Entity::kTets, 5, {}, 0.05, {}}};
  const Report report = remesh(mesh, {}, options);
  expect_sound(mesh);
  expect_good(report);
  EXPECT_NEAR(mean_length_in(mesh, [](const Vec3& p) { return p.x > 0.6; }), 0.05, 0.007);
  EXPECT_GT(mean_length_in(mesh, [](const Vec3& p) { return p.x < 0.2; }), 0.1);
}

TEST(Local, BoundsOfTrianglesHoldAtThem) {
  MeshData data = to_data(built(kuhn_cube(4)));
  for (std::size_t t = 0; t < data.triangles.size(); ++t) {
    const auto& v = data.triangles[t];
    const bool top =
        std::all_of(v.begin(), v.end(), [&](auto k) { return data.vertices[k].z == 1; });
    data.triangle_refs[t] = top ? 9 : 4;
  }
  TetMesh mesh = built(data);
  Options options;
  options.local = {{Entity::kTriangles, 9, {}, 0.04, {}}};
  const Report report = remesh(mesh, {}, options);
  expect_sound(mesh);
  expect_good(report);
  EXPECT_NEAR(mean_length_in(mesh, [](const Vec3& p) { return p.z == 1; }), 0.04, 0.006);
  EXPECT_GT(mean_length_in(mesh, [](const Vec3& p) { return p.z == 0; }), 0.1);
}

TEST(Local, TolerancesHoldAtTheirTriangles) {
  MeshData data = to_data(built(ball(8)));
  for (std::size_t t = 0; t < data.triangles.size(); ++t) {
    double z = 0;
    for (const std::int32_t v : data.triangles[t]) z += data.vertices[v].z;
    data.triangle_refs[t] = z > 0 ? 1 : 2;
  }
  TetMesh mesh = built(data);
  Options options;
  options.hausd = 0.01;
  options.local = {{Entity::kTriangles, 1, {}, {}, 0.001}};
  remesh(mesh, {}, options);
  expect_sound(mesh);
  const auto count = [&](std::int32_t ref) {
    return std::count_if(mesh.triangles.begin(), mesh.triangles.end(),
                         [&](const Triangle& t) { return t.ref == ref; });
  };
  EXPECT_GT(count(1), 3 * count(2));
}

TEST(Local, ContradictionsAreRefused) {
  const LocalParameters fine{Entity::kTriangles, 1, 0.1, 0.2, {}};
  const SizeRegion sphere = SizeSphere{{0, 0, 0}, 1, 0.1};
  expect_refused([&](Options& o) { o.local = {fine, fine}; }, "two local");
  expect_refused([&](Options& o) { o.local = {fine}, o.hsiz = 1; }, "hsiz");
  expect_refused([&](Options& o) { o.size_regions = {sphere}, o.hsiz = 1; }, "hsiz");
  expect_refused([&](Options& o) { o.size_regions = {sphere}, o.hmin = 0.2; }, "hmin");
  expect_refused([](Options& o) { o.local = {{Entity::kTets, 1, 0.2, 0.1, {}}}; }, "hmax");
  expect_refused([](Options& o) { o.local = {{Entity::kTets, 1, {}, {}, 0.1}}; }, "hausd");
  expect_refused([](Options& o) { o.local = {{Entity::kTets, 1, {}, {}, {}}}; }, "no parameter");
  expect_refused([](Options& o) { o.size_regions = {SizeBox{{0, 0, 0}, {1, 0, 1}, 1}}; }, "box");
  expect_refused([](Options& o) { o.size_regions = {SizeSphere{{0, 0, 0}, -1, 1}}; }, "radius");
}

}  // namespace
}  // namespace cavea::test
