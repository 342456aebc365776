#include "cavea/surface/features.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "cavea/surface/edges.h"
#include "surface/shapes.h"

namespace cavea {
namespace {

using test::kuhn_cube;

/// The number of surface edges that have all of some tags.
int edges_with(const TetMesh& mesh, Tag tags) {
  int n = 0;
  for_each_edge(sorted_edge_sides(mesh.triangles), [&](const EdgeSide* side, const EdgeSide*) {
    n += (mesh.triangles[side->triangle].edge_tag[side->k] & tags) == tags;
  });
  return n;
}

std::set<VertexId> vertices_with(const TetMesh& mesh, Tag tags) {
  std::set<VertexId> found;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if ((mesh.vertex_tags[v] & tags) == tags) found.insert(VertexId(v));
  return found;
}

std::set<VertexId> box_corners(const TetMesh& mesh) {
  std::set<VertexId> found;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Vec3& p = mesh.points[v];
    const auto extreme = [](double x) { return x == 0 || x == 1; };
    if (extreme(p.x) && extreme(p.y) && extreme(p.z)) found.insert(VertexId(v));
  }
  return found;
}

std::int32_t vertex_at(const MeshData& data, const Vec3& p) {
  for (std::size_t v = 0; v < data.vertices.size(); ++v)
    if (distance(data.vertices[v], p) < 1e-9) return std::int32_t(v);
  ADD_FAILURE() << "no vertex there";
  return 0;
}

enum class Kind { kPlain, kRidge, kRequired };

/// Lists the edges of a path of points of the top face z = 1.
void list_path(MeshData& data, const std::vector<std::array<double, 2>>& path, Kind kind) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const std::int32_t e = std::int32_t(data.edges.size());
    data.edges.push_back({vertex_at(data, {path[i][0], path[i][1], 1}),
                          vertex_at(data, {path[i + 1][0], path[i + 1][1], 1})});
    data.edge_refs.push_back(7);
    if (kind == Kind::kRidge) data.ridges.push_back(e);
    if (kind == Kind::kRequired) data.required_edges.push_back(e);
  }
}

/// The corners inside the top face of a cube with these lists, as (x, y).
std::set<std::array<double, 2>> top_corners(const MeshData& data) {
  TetMesh mesh = build(data).mesh;
  classify_features(mesh, {});
  std::set<std::array<double, 2>> found;
  for (const VertexId v : vertices_with(mesh, tag::kCorner)) {
    const Vec3& p = mesh.points[v];
    if (p.z == 1 && p.x > 0 && p.x < 1 && p.y > 0 && p.y < 1) found.insert({p.x, p.y});
  }
  return found;
}

using Places = std::set<std::array<double, 2>>;

TEST(ClassifyFeatures, OfTheCube) {
  for (const int n : {1, 2, 5}) {
    TetMesh mesh = build(kuhn_cube(n)).mesh;
    EXPECT_EQ(classify_features(mesh, {}), 6);
    EXPECT_EQ(edges_with(mesh, tag::kRidge), 12 * n);
    EXPECT_EQ(vertices_with(mesh, tag::kRidge).size(), 8u + 12u * unsigned(n - 1));
    EXPECT_EQ(vertices_with(mesh, tag::kCorner), box_corners(mesh));
    EXPECT_EQ(vertices_with(mesh, tag::kSurface).size(), 6u * unsigned(n * n) + 2);
  }
}

TEST(ClassifyFeatures, PatchesAreTheFacesOfTheCube) {
  TetMesh mesh = build(kuhn_cube(3)).mesh;
  classify_features(mesh, {});
  std::set<std::pair<int, std::array<int, 3>>> faces;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 n = normalized(cross(mesh.points[t.v[1]] - mesh.points[t.v[0]],
                                    mesh.points[t.v[2]] - mesh.points[t.v[0]]));
    faces.insert({t.patch, {int(std::lround(n.x)), int(std::lround(n.y)), int(std::lround(n.z))}});
  }
  EXPECT_EQ(faces.size(), 6u);
}

TEST(ClassifyFeatures, WithoutDetectionOnlyWhatTheMeshCarries) {
  MeshData data = kuhn_cube(4);
  TetMesh plain = build(data).mesh;
  EXPECT_EQ(classify_features(plain, {45, false}), 1);
  EXPECT_EQ(edges_with(plain, tag::kRidge), 0);
  EXPECT_TRUE(vertices_with(plain, tag::kCorner).empty());

  list_path(data, {{0.25, 0.5}, {0.5, 0.5}}, Kind::kRidge);
  TetMesh carrying = build(data).mesh;
  EXPECT_EQ(classify_features(carrying, {45, false}), 1);
  EXPECT_EQ(edges_with(carrying, tag::kRidge), 1);
}

TEST(ClassifyFeatures, TheAngleDecidesWhatIsSharp) {
  TetMesh blunt = build(kuhn_cube(2)).mesh, sharp = blunt;
  EXPECT_EQ(classify_features(blunt, {91, true}), 1);
  EXPECT_EQ(classify_features(sharp, {89, true}), 6);
}

TEST(ClassifyFeatures, RidgesGoOnWhereTheyFade) {
  constexpr int kSize = 8;
  FeatureOptions options;
  const auto upright_ridges = [&] {
    TetMesh mesh = build(test::fading_column(kSize)).mesh;
    classify_features(mesh, options);
    return edges_with(mesh, tag::kRidge) - 2 * 4 * kSize;  // without those around the two ends
  };
  const int above_the_angle = upright_ridges();
  EXPECT_LT(above_the_angle, 4 * kSize);
  options.continued_above = 20;
  EXPECT_GT(upright_ridges(), above_the_angle + 4);
  EXPECT_LE(upright_ridges(), 4 * kSize);
  options.may_be_ridge = [](VertexId, VertexId) { return false; };
  EXPECT_EQ(upright_ridges(), -2 * 4 * kSize);
}

TEST(ClassifyFeatures, FoldsOfACoarseRoundShapeContinueNoRidge) {
  MeshData data = kuhn_cube(3);  // becomes a column of twelve sides, whose folds are all alike
  data.edges = {{vertex_at(data, {0, 0, 0}), vertex_at(data, {0, 0, 1.0 / 3})}};
  data.edge_refs = {7};
  data.ridges = {0};
  for (Vec3& p : data.vertices) {
    const double x = 2 * p.x - 1, y = 2 * p.y - 1;
    p = {x * std::sqrt(1 - y * y / 2), y * std::sqrt(1 - x * x / 2), p.z};
  }
  FeatureOptions options;
  options.continued_above = 20;
  TetMesh mesh = build(data).mesh;
  classify_features(mesh, options);
  EXPECT_EQ(edges_with(mesh, tag::kRidge), 2 * 12 + 1);
}

TEST(ClassifyFeatures, SliversSayNothingOfFolds) {
  // A pyramid upside down, over the diagonal of whose flat top a sliver stands upright.
  MeshData data;
  data.vertices = {{0, 0, 0},     {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.4999, 0.5001, 1e-3},
                   {0.5, 0.5, -1}};
  data.tets = {{0, 1, 2, 5}, {0, 2, 4, 5}, {0, 4, 3, 5}, {4, 2, 3, 5}};
  data.vertex_refs.assign(6, 0), data.tet_refs.assign(4, 1);
  TetMesh mesh = build(data).mesh;
  FeatureOptions options;
  classify_features(mesh, options);
  EXPECT_EQ(edges_with(mesh, tag::kRidge), 8 + 3);
  TetMesh again = build(data).mesh;
  options.sliver = 0.01;
  classify_features(again, options);
  EXPECT_EQ(edges_with(again, tag::kRidge), 8);
}

/// The body between triangles and a point below them.
MeshData under(std::vector<Vec3> points, const Vec3& apex,
               const std::vector<std::array<VertexId, 3>>& triangles) {
  MeshData data;
  const auto below = VertexId(points.size());
  points.push_back(apex);
  data.vertices = std::move(points);
  for (const auto& t : triangles) data.tets.push_back({t[0], t[1], t[2], below});
  data.vertex_refs.assign(data.vertices.size(), 0), data.tet_refs.assign(data.tets.size(), 1);
  return data;
}

TetMesh classified(const MeshData& data, double sliver) {
  TetMesh mesh = build(data).mesh;
  FeatureOptions options;
  options.sliver = sliver;
  classify_features(mesh, options);
  return mesh;
}

bool is_ridge(const TetMesh& mesh, VertexId a, VertexId b) {
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if (std::minmax(t.v[(k + 1) % 3], t.v[(k + 2) % 3]) == std::minmax(a, b))
        return (t.edge_tag[k] & tag::kRidge) != 0;
  return false;
}

TEST(ClassifyFeatures, NorDoSliversBesideEachOther) {
  // Two of them stand upright over the diagonal, the smaller one on the other.
  const MeshData data =
      under({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1e-3}, {0.25, 0.25, 1e-3}},
            {0.4, 0.6, -1}, {{0, 1, 2}, {0, 2, 4}, {0, 4, 5}, {0, 5, 3}, {5, 4, 3}, {4, 2, 3}});
  EXPECT_EQ(edges_with(classified(data, 0), tag::kRidge), 8 + 4);
  EXPECT_EQ(edges_with(classified(data, 0.01), tag::kRidge), 8);
}

TEST(ClassifyFeatures, ARidgeMakesNoDetourAroundASliver) {
  // A wall stands over half of the diagonal, and ends in a sliver.
  const MeshData data =
      under({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.3, 0.3, 1e-3}, {0.65, 0.65, 0.4}},
            {0.4, 0.6, -1}, {{0, 1, 2}, {0, 2, 4}, {0, 4, 3}, {4, 2, 5}, {4, 5, 3}, {5, 2, 3}});
  const TetMesh noisy = classified(data, 0), mesh = classified(data, 0.01);
  EXPECT_TRUE(is_ridge(noisy, 0, 2) && is_ridge(noisy, 0, 4) && !is_ridge(noisy, 2, 4));
  EXPECT_TRUE(!is_ridge(mesh, 0, 2) && !is_ridge(mesh, 0, 4) && is_ridge(mesh, 2, 4));
}

TEST(ClassifyFeatures, AnEdgeAcrossAFoldSagsAsItsNarrowerSideAllows) {
  // Heights of 1 and 0.1 over the first edge, at 0.5.
  const MeshData data =
      under({{0, 0, 0}, {0, 1, 0}, {-1, 0.5, 0}, {0.1 * std::cos(0.5), 0.5, -0.1 * std::sin(0.5)}},
            {-0.3, 0.5, -2}, {{0, 1, 2}, {1, 0, 3}});
  FeatureOptions options;
  for (const double crease : {0.05, 0.2, 0.4})
    for (const bool flat : {false, true}) {
      TetMesh mesh = build(data).mesh;
      options.crease = crease, options.flat = flat;
      classify_features(mesh, options);
      EXPECT_EQ(is_ridge(mesh, 0, 1), 0.5 * (flat ? 2. / 11 : 0.55) > crease);
    }
}

TEST(ClassifyFeatures, SliversOfAFaceKeepItsRim) {
  // A disc whose rim is cut off in ears of a height of 0.08, over a flat cone.
  constexpr int kSides = 16;
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> triangles;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    points.push_back({std::cos(angle), std::sin(angle), 0});
    if (i % 2 == 0) triangles.push_back({i, i + 1, (i + 2) % kSides});
    if (i % 2 == 0) triangles.push_back({kSides, i, (i + 2) % kSides});
  }
  points.push_back({0, 0, 0});
  const MeshData data = under(points, {0, 0, -0.3}, triangles);
  EXPECT_EQ(edges_with(classified(data, 0.1), tag::kRidge), kSides);
}

TEST(ClassifyFeatures, EndsOfADanglingRidgeAreCorners) {
  MeshData data = kuhn_cube(4);
  list_path(data, {{0.25, 0.5}, {0.5, 0.5}, {0.75, 0.5}}, Kind::kRidge);
  EXPECT_EQ(top_corners(data), (Places{{0.25, 0.5}, {0.75, 0.5}}));
}

TEST(ClassifyFeatures, ADanglingRidgePartsNoPatch) {
  MeshData data = kuhn_cube(4);
  list_path(data, {{0.25, 0.5}, {0.5, 0.5}, {0.75, 0.5}}, Kind::kRidge);
  TetMesh mesh = build(data).mesh;
  EXPECT_EQ(classify_features(mesh, {}), 6);
}

TEST(ClassifyFeatures, ASharpTurnIsACornerAndABluntOneIsNot) {
  MeshData sharp = kuhn_cube(4);
  list_path(sharp, {{0.25, 0.5}, {0.5, 0.5}, {0.5, 0.25}}, Kind::kPlain);
  EXPECT_EQ(top_corners(sharp), (Places{{0.25, 0.5}, {0.5, 0.5}, {0.5, 0.25}}));

  MeshData blunt = kuhn_cube(4);  // 45 degrees on the grid, less when the last vertex is pulled
  list_path(blunt, {{0.25, 0.25}, {0.5, 0.25}, {0.75, 0.5}}, Kind::kPlain);
  blunt.vertices[vertex_at(blunt, {0.75, 0.5, 1})].y = 0.45;
  EXPECT_EQ(top_corners(blunt), (Places{{0.25, 0.25}, {0.75, 0.45}}));
}

TEST(ClassifyFeatures, CurvesOfDifferentKindsMeetInACorner) {
  MeshData data = kuhn_cube(4);
  list_path(data, {{0.25, 0.5}, {0.5, 0.5}}, Kind::kRidge);
  list_path(data, {{0.5, 0.5}, {0.75, 0.5}}, Kind::kPlain);
  EXPECT_EQ(top_corners(data), (Places{{0.25, 0.5}, {0.5, 0.5}, {0.75, 0.5}}));
}

TEST(ClassifyFeatures, ThreeFeatureEdgesMeetInACorner) {
  MeshData data = kuhn_cube(4);
  list_path(data, {{0.25, 0.5}, {0.5, 0.5}, {0.75, 0.5}}, Kind::kRidge);
  list_path(data, {{0.5, 0.5}, {0.5, 0.25}}, Kind::kRidge);
  EXPECT_TRUE(top_corners(data).contains({0.5, 0.5}));
}

TEST(ClassifyFeatures, RequiredEdgesEndPatches) {
  MeshData data = kuhn_cube(4);
  list_path(data, {{0, 0.5}, {0.25, 0.5}, {0.5, 0.5}, {0.75, 0.5}, {1, 0.5}}, Kind::kRequired);
  TetMesh mesh = build(data).mesh;
  EXPECT_EQ(classify_features(mesh, {}), 7);
}

TEST(ClassifyFeatures, EdgesBetweenReferencesOfTriangles) {
  MeshData data = kuhn_cube(2);
  TetMesh mesh = build(data).mesh;
  for (Triangle& t : mesh.triangles) {
    const Vec3 c = (mesh.points[t.v[0]] + mesh.points[t.v[1]] + mesh.points[t.v[2]]) / 3;
    t.ref = c.z == 1 && c.x > 0.5 ? 2 : 1;
  }
  EXPECT_EQ(classify_features(mesh, {}), 7);
  // Around half of the top face: 2 edges inside it, and 2 + 1 + 1 on ridges.
  EXPECT_EQ(edges_with(mesh, tag::kReferenceEdge), 6);
  EXPECT_EQ(edges_with(mesh, tag::kReferenceEdge | tag::kRidge), 4);
}

TEST(ClassifyFeatures, AnInterfaceMeetsTheBoundaryInNonManifoldEdges) {
  MeshData data = kuhn_cube(4);
  test::set_refs(data, [](const Vec3& c) { return c.x < 0.5 ? 1 : 2; });
  TetMesh mesh = build(data).mesh;
  // Four faces of the cube are parted in two; the interface is a patch of its own.
  EXPECT_EQ(classify_features(mesh, {}), 2 + 4 * 2 + 1);
  EXPECT_EQ(edges_with(mesh, tag::kNonManifold), 4 * 4);
  std::set<VertexId> corners = box_corners(mesh);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Vec3& p = mesh.points[v];
    if (p.x == 0.5 && (p.y == 0 || p.y == 1) && (p.z == 0 || p.z == 1)) corners.insert(VertexId(v));
  }
  EXPECT_EQ(vertices_with(mesh, tag::kCorner), corners);
}

TEST(ClassifyFeatures, APinchedVertexIsACorner) {
  // Two opposite cells of the 2^3 grid touch in its middle vertex alone.
  const MeshData data = test::kuhn_grid(2, [](int i, int j, int k) { return i == j && j == k; });
  TetMesh mesh = build(data).mesh;
  EXPECT_EQ(classify_features(mesh, {91, true}), 2);
  const std::set<VertexId> corners = vertices_with(mesh, tag::kCorner);
  ASSERT_EQ(corners.size(), 1u);
  EXPECT_LT(distance(mesh.points[*corners.begin()], {0.5, 0.5, 0.5}), 1e-12);
}

/// Two cones of 16 sides and of a height over a common circle of radius 1; the tips come first.
TetMesh double_cone(double height) {
  constexpr int kSides = 16;
  MeshData data;
  data.vertices = {{0, 0, height}, {0, 0, -height}};
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    data.vertices.push_back({std::cos(angle), std::sin(angle), 0});
    data.tets.push_back({0, 1, 2 + (i + 1) % kSides, 2 + i});
    data.tet_refs.push_back(0);
  }
  return build(data).mesh;
}

TEST(ClassifyFeatures, TheTipOfASharpConeIsACorner) {
  TetMesh sharp = double_cone(1.2), blunt = double_cone(0.8), flat = double_cone(1.2), low = flat;
  FeatureOptions options;
  classify_features(sharp, options);
  EXPECT_EQ(vertices_with(sharp, tag::kCorner), (std::set<VertexId>{0, 1}));
  classify_features(blunt, options);
  EXPECT_TRUE(vertices_with(blunt, tag::kCorner).empty());
  options.sliver = 1.3;  // which says nothing of tips
  classify_features(flat, options);
  EXPECT_EQ(vertices_with(flat, tag::kCorner), (std::set<VertexId>{0, 1}));
  options.least_tip = 1.3;
  classify_features(low, options);
  EXPECT_TRUE(vertices_with(low, tag::kCorner).empty());
}

TEST(ClassifyFeatures, ABallHasNone) {
  TetMesh mesh = build(test::ball(6)).mesh;
  EXPECT_EQ(classify_features(mesh, {}), 1);
  EXPECT_EQ(edges_with(mesh, tag::kRidge), 0);
  EXPECT_TRUE(vertices_with(mesh, tag::kCorner).empty());
}

}  // namespace
}  // namespace cavea
