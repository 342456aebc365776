// What the mesh is of stays: volumes, interfaces, ridges, corners, required entities.
#include <numbers>

#include "cavea/surface/edges.h"
#include "remesh/support.h"

namespace cavea::test {
namespace {

struct Body {
  std::string name;
  MeshData data;
  Options options;
};

std::vector<Body> plane_bodies() {
  Options sized;
  sized.hmax = 0.12;
  sized.hmin = 0.03;
  return {{"cube", kuhn_cube(3), uniform(0.08)},    {"coarsened", kuhn_cube(9), uniform(0.3)},
          {"halves", two_halves(4), uniform(0.09)}, {"octants", octants(4), sized},
          {"frame", frame(), uniform(0.07)},        {"thin_wall", thin_wall(), uniform(0.02)}};
}

class PlaneBody : public testing::TestWithParam<std::size_t> {};

TEST_P(PlaneBody, KeepsItsDomain) {
  const Body body = plane_bodies()[GetParam()];
  SCOPED_TRACE(body.name);
  TetMesh mesh = built(body.data);
  const Report report = remesh(mesh, {}, body.options);
  expect_sound(mesh);
  expect_good(report);
  TetMesh start = built(body.data);
  classify_features(start, {});
  Shape(start).expect_polyhedron(mesh);
  EXPECT_LE(report.surface_distance, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(All, PlaneBody, testing::Range<std::size_t>(0, plane_bodies().size()),
                         [](const auto& number) { return plane_bodies()[number.param].name; });

std::int64_t count_pinched_edges(const TetMesh& mesh) {
  std::int64_t n = 0;
  for_each_edge(sorted_edge_sides(mesh.triangles), [&](const EdgeSide* side, const EdgeSide*) {
    n += bool(mesh.triangles[side->triangle].edge_tag[side->k] & tag::kPinched);
  });
  return n;
}

TEST(Domain, TouchingItselfStaysAsItIs) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const MeshData data = polycube(4, 0.5, seed);
    TetMesh mesh = built(data);
    remesh(mesh, {}, uniform(0.11));
    expect_sound(mesh);
    TetMesh start = built(data);
    classify_features(start, {});
    Shape(start).expect_polyhedron(mesh);
    EXPECT_EQ(count_pinched_edges(mesh), count_pinched_edges(start));
  }
}

TEST(Domain, OfABallIsRounderThanItsInput) {
  TetMesh mesh = built(ball(8));
  Options options;
  options.hausd = 0.005;
  const Report report = remesh(mesh, {}, options);
  expect_sound(mesh);
  // At the tolerance's edge a surface edge that is short cannot always go.
  expect_good(report, {.conform = 80});
  const double exact = 4 * std::numbers::pi / 3;
  EXPECT_NEAR(report.after.counts.volume, exact, 0.02 * exact);
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (mesh.vertex_tags[v] & tag::kSurface) {
      EXPECT_NEAR(norm(mesh.points[v]), 1, 0.02);
    }
  EXPECT_EQ(euler(mesh), (Euler{1, 2}));
}

TEST(Domain, KeepsClosedRidges) {
  TetMesh mesh = built(cylinder(8));
  Options options;
  options.hausd = 0.01;
  const Report report = remesh(mesh, {}, options);
  expect_sound(mesh);
  expect_good(report);
  EXPECT_EQ(report.after.counts.corners, 0);
  EXPECT_NEAR(feature_length(mesh), 4 * std::numbers::pi, 0.02 * 4 * std::numbers::pi);
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (mesh.vertex_tags[v] & tag::kRidge) {
      const Vec3& p = mesh.points[v];
      EXPECT_NEAR(std::abs(p.z - 1), 1, 1e-9);
      EXPECT_NEAR(std::hypot(p.x, p.y), 1, 0.02);
    }
  EXPECT_EQ(euler(mesh), (Euler{1, 2}));
}

template <class T>
bool contains(const std::vector<T>& all, const T& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

/// The corners of the listed tets, triangles or edges, as places, each in a fixed order.
template <std::size_t N>
std::vector<std::vector<std::array<double, 3>>> places(
    const MeshData& data, const std::vector<std::array<std::int32_t, N>>& all,
    const std::vector<std::int32_t>& listed) {
  std::vector<std::vector<std::array<double, 3>>> out;
  for (const std::int32_t i : listed) {
    out.emplace_back();
    for (const std::int32_t v : all[std::size_t(i)])
      out.back().push_back({data.vertices[v].x, data.vertices[v].y, data.vertices[v].z});
    std::sort(out.back().begin(), out.back().end());
  }
  std::sort(out.begin(), out.end());
  return out;
}

TEST(Domain, KeepsWhatIsRequired) {
  MeshData data = to_data(built(two_halves(4)));
  data.required_vertices = {31, 62, 93};
  data.required_tets = {100, 101, 200};
  data.required_triangles = {3, 60, 120};
  // An edge of the boundary's mesh and one inside the volume.
  data.required_edges = {std::int32_t(data.edges.size()), std::int32_t(data.edges.size()) + 1};
  data.edges.push_back({data.triangles[10][0], data.triangles[10][1]});
  data.edges.push_back({data.tets[150][0], data.tets[150][1]});
  data.edge_refs.resize(data.edges.size(), 4);
  TetMesh mesh = built(data);
  const MeshData start = to_data(mesh);
  const Report report = remesh(mesh, {}, uniform(0.12));
  expect_sound(mesh);
  EXPECT_GE(report.after.quality.worst, 0.1);
  const MeshData out = to_data(mesh);
  EXPECT_EQ(places(out, out.tets, out.required_tets), places(data, data.tets, data.required_tets));
  EXPECT_EQ(places(out, out.triangles, out.required_triangles),
            places(data, data.triangles, data.required_triangles));
  const auto edges = places(out, out.edges, out.required_edges);
  for (const auto& edge : places(start, start.edges, start.required_edges))
    EXPECT_TRUE(contains(edges, edge));
  for (const std::int32_t v : data.required_vertices)
    EXPECT_TRUE(contains(out.vertices, data.vertices[v]));
}

/// A ball of three materials: a core, and two halves around it.
MeshData ball_with_core(int n) {
  MeshData data = kuhn_cube(n);
  set_refs(data, [](const Vec3& c) {
    const double core = std::max({std::abs(c.x - 0.5), std::abs(c.y - 0.5), std::abs(c.z - 0.5)});
    return core < 0.25 ? 1 : c.x + c.z / 1000 < 0.5 ? 2 : 3;
  });
  data.vertices = ball(n).vertices;
  return data;
}

TEST(Domain, VolumesOfReferencesStayWithinTheTolerance) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const TetMesh start = built(shuffled(ball_with_core(8), seed));
    TetMesh mesh = start;
    Options options;
    options.hausd = seed % 2 ? 0.004 : 0.01;
    options.faceted = seed > 2;
    const Report report = remesh(mesh, {}, options);
    expect_sound(mesh);
    double area = 0;
    for (const auto& [ref, of_ref] : area_of_ref(start)) area += of_ref;
    const auto now = count(mesh).volume_of_ref;
    for (const auto& [ref, before] : count(start).volume_of_ref)
      EXPECT_NEAR(now.at(ref), before, (report.surface_distance + report.bulge) * area / 2)
          << "reference " << ref;
    EXPECT_EQ(euler(mesh), euler(start));
    EXPECT_LE(report.surface_distance, report.hausd);
  }
}

TEST(Domain, KeepsAllReferencesOfTriangles) {
  MeshData data = to_data(built(kuhn_cube(4)));
  for (std::size_t t = 0; t < data.triangles.size(); ++t) {
    Vec3 sum;
    for (const std::int32_t v : data.triangles[t]) sum += data.vertices[v];
    data.triangle_refs[t] = sum.x / 3 < 0.5 ? 11 : 12;
  }
  TetMesh mesh = built(data);
  const auto before = area_of_ref(mesh);
  expect_good(remesh(mesh, {}, uniform(0.1)));
  expect_sound(mesh);
  expect_near(area_of_ref(mesh), before, 1e-11);
}

}  // namespace
}  // namespace cavea::test
