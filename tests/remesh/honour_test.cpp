// What the input says is honoured: required entities, ridges and corners, normals, closed curves.
#include <map>
#include <set>

#include "remesh/support.h"

namespace cavea::test {
namespace {

using Place = std::array<double, 3>;
using Places = std::multiset<std::vector<Place>>;

/// The listed entities as the places of their vertices, in a fixed order.
template <std::size_t N>
Places places(const MeshData& data, const std::vector<std::array<std::int32_t, N>>& all,
              const std::vector<std::int32_t>& listed) {
  Places out;
  for (const std::int32_t i : listed) {
    std::vector<Place> corners;
    for (const std::int32_t v : all[std::size_t(i)]) {
      const Vec3& p = data.vertices[std::size_t(v)];
      corners.push_back({p.x, p.y, p.z});
    }
    std::sort(corners.begin(), corners.end());
    out.insert(corners);
  }
  return out;
}

Places vertex_places(const MeshData& data, const std::vector<std::int32_t>& listed) {
  std::vector<std::array<std::int32_t, 1>> each(data.vertices.size());
  for (std::size_t v = 0; v < each.size(); ++v) each[v][0] = std::int32_t(v);
  return places(data, each, listed);
}

void expect_within(const Places& some, const Places& all, const char* what) {
  EXPECT_TRUE(std::includes(all.begin(), all.end(), some.begin(), some.end())) << what;
}

std::vector<std::int32_t> some_of(std::size_t n, double share, Random& random) {
  std::vector<std::int32_t> chosen;
  for (std::size_t i = 0; i < n; ++i)
    if (random.unit() < share) chosen.push_back(std::int32_t(i));
  return chosen;
}

/// A body with random required entities; its lists as build() gives them back.
MeshData with_required(std::uint64_t seed) {
  Random random(seed);
  MeshData data = seed % 2 ? two_halves(4) : ball(4);
  data = to_data(built(shuffled(data, seed)));
  data.required_vertices = some_of(data.vertices.size(), 0.03, random);
  data.required_triangles = some_of(data.triangles.size(), 0.03, random);
  data.required_tets = some_of(data.tets.size(), 0.01, random);
  for (int k = 0; k < 6; ++k) {
    const auto& tet = data.tets[std::size_t(random.below(std::int32_t(data.tets.size())))];
    data.required_edges.push_back(std::int32_t(data.edges.size()));
    data.edges.push_back({tet[0], tet[1 + random.below(3)]});
  }
  data.edge_refs.assign(data.edges.size(), 0);
  return data;
}

TEST(Honour, RequiredEntitiesStayToTheBit) {
  for (std::uint64_t seed = 1; seed <= (kSanitized ? 3 : 10); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const MeshData data = with_required(seed);
    TetMesh mesh = built(data);
    Options options = seed % 3 ? uniform(seed % 3 == 1 ? 0.1 : 0.5) : Options{};
    remesh(mesh, {}, options);
    expect_sound(mesh);
    const MeshData out = to_data(mesh);
    EXPECT_EQ(places(out, out.tets, out.required_tets),
              places(data, data.tets, data.required_tets));
    EXPECT_EQ(places(out, out.triangles, out.required_triangles),
              places(data, data.triangles, data.required_triangles));
    expect_within(vertex_places(data, data.required_vertices),
                  vertex_places(out, out.required_vertices), "vertices");
    // An edge inside the volume has no list of its own in the mesh: it is an edge of tets.
    std::vector<std::array<std::int32_t, 2>> edges;
    for (const auto& tet : out.tets)
      for (const auto& e : kEdgeVertices) edges.push_back({tet[e[0]], tet[e[1]]});
    std::vector<std::int32_t> all(edges.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = std::int32_t(i);
    const Places standing = places(out, edges, all);
    for (const auto& edge : places(data, data.edges, data.required_edges))
      EXPECT_TRUE(standing.count(edge)) << "an edge is gone";
  }
}

/// The lists of a cube whose ridges and corners were found, and nothing else about them.
MeshData cube_with_features(int n) {
  TetMesh mesh = built(kuhn_cube(n));
  classify_features(mesh, {});
  return to_data(mesh);
}

Options without_detection(double size) {
  Options options = uniform(size);
  options.detect_ridges = false;
  return options;
}

TEST(Honour, RidgesAndCornersOfTheInputAreEnough) {
  for (const double size : {0.1, 0.6}) {
    SCOPED_TRACE(size);
    const MeshData data = cube_with_features(4);
    ASSERT_EQ(data.ridges.size(), 12u * 4);
    ASSERT_EQ(data.corners.size(), 8u);
    TetMesh mesh = built(data), start = mesh;
    remesh(mesh, {}, without_detection(size));
    expect_sound(mesh);
    classify_features(start, {45, false});
    Shape(start).expect_polyhedron(mesh);
    const MeshData out = to_data(mesh);
    EXPECT_EQ(vertex_places(out, out.corners), vertex_places(data, data.corners));
  }
}

TEST(Honour, CornersWithoutRidgesStayToo) {
  MeshData data = cube_with_features(4);
  data.ridges.clear(), data.edges.clear(), data.edge_refs.clear();
  data.corners = {7, 23, 40, 55, 90};
  TetMesh mesh = built(data);
  remesh(mesh, {}, without_detection(0.4));
  expect_sound(mesh);
  const MeshData out = to_data(mesh);
  expect_within(vertex_places(data, data.corners), vertex_places(out, out.corners), "corners");
  EXPECT_EQ(out.ridges.size(), 0u);
}

constexpr Vec3 kAxes{1.5, 1, 0.7};

Vec3 over_axes(const Vec3& p) { return {p.x / kAxes.x, p.y / kAxes.y, p.z / kAxes.z}; }

/// Largest distance of the surface's vertices and triangle centroids from the ellipsoid, about.
double off_ellipsoid(const TetMesh& mesh) {
  double worst = 0;
  for (const Triangle& s : mesh.triangles) {
    const Vec3 c = (mesh.points[s.v[0]] + mesh.points[s.v[1]] + mesh.points[s.v[2]]) / 3;
    for (const Vec3& p : {mesh.points[s.v[0]], c})
      worst = std::max(worst, std::abs(norm(over_axes(p)) - 1));
  }
  return worst;
}

TEST(Honour, NormalsOfTheInputMakeAnEllipsoidRounder) {
  const auto remeshed = [](bool with_normals) {
    MeshData data = ball(3);
    for (Vec3& p : data.vertices) p = {p.x * kAxes.x, p.y * kAxes.y, p.z * kAxes.z};
    if (with_normals)
      for (std::size_t v = 0; v < data.vertices.size(); ++v)
        if (const Vec3 on_ball = over_axes(data.vertices[v]); norm(on_ball) > 0.99) {
          const std::int32_t n = std::int32_t(data.normals.size());
          data.normal_at_vertices.push_back({std::int32_t(v), n});
          data.normals.push_back((n % 2 ? 2.0 : -0.5) * over_axes(on_ball));  // of any direction
        }
    TetMesh mesh = built(data);
    Options options;
    options.hausd = 0.002;
    options.max_bulge = 1;
    options.hmax = 0.15;
    options.angle = 60;
    remesh(mesh, {}, options);
    expect_sound(mesh);
    EXPECT_TRUE(mesh.normals.empty());
    return mesh;
  };
  EXPECT_LT(off_ellipsoid(remeshed(true)), 0.6 * off_ellipsoid(remeshed(false)));
}

/// The number of edges of each closed curve of feature edges whose vertices are no corners.
std::vector<int> closed_curves(const TetMesh& mesh) {
  std::map<VertexId, std::vector<VertexId>> next;
  const SurfaceEdges edges(mesh);
  for (std::size_t a = 0; a < edges.vertices(); ++a)
    edges.for_each_at(mesh, VertexId(a), [&](VertexId b, SurfaceEdges::Uses uses) {
      const auto [triangle, k] = SurfaceEdges::decode(uses[0]);
      if (!(mesh.triangles[triangle].edge_tag[k] & tag::kFeature)) return;
      next[VertexId(a)].push_back(b);
      next[b].push_back(VertexId(a));
    });
  std::vector<int> lengths;
  std::set<VertexId> seen;
  for (const auto& [start, ends] : next) {
    if (!seen.insert(start).second) continue;
    int n = 1;
    for (VertexId at = ends[0]; seen.insert(at).second; ++n) {
      const auto& on = next[at];
      EXPECT_EQ(on.size(), 2u);
      at = seen.count(on[0]) ? on[1] : on[0];
    }
    lengths.push_back(n);
  }
  return lengths;
}

TEST(Honour, ClosedCurvesKeepThreeEdges) {
  int shortest = 1000;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    MeshData data = shuffled(seed % 2 ? cylinder(3 + random.below(4)) : ball(4), seed);
    if (seed % 2 == 0) set_refs(data, [](const Vec3& c) { return c.z < 0 ? 1 : 2; });
    TetMesh mesh = built(data);
    const std::size_t curves = seed % 2 ? 2 : 1;
    Options options = uniform(random.between(1, 20));  // longer than the curves
    options.hausd = 1;
    options.max_bulge = 0.01;
    options.angle = 70;
    remesh(mesh, {}, options);
    expect_sound(mesh);
    const std::vector<int> lengths = closed_curves(mesh);
    EXPECT_EQ(lengths.size(), curves);
    for (const int n : lengths) {
      EXPECT_GE(n, 3);
      shortest = std::min(shortest, n);
    }
  }
  EXPECT_LE(shortest, 8);  // or nothing was coarse enough to try them
}

}  // namespace
}  // namespace cavea::test
