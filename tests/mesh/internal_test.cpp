// Triangles between tets of one reference.
#include <gtest/gtest.h>

#include "cavea/mesh/build.h"
#include "cavea/mesh/compact.h"
#include "support/expect.h"
#include "support/sheets.h"

namespace cavea::test {
namespace {

constexpr BuildOptions kKeep{.keep_internal = true};

/// A square sheet that ends inside the volume on all sides.
MeshData floating() {
  MeshData data = kuhn_cube(4);
  add_plane_sheet(data,
                  [](double y, double z) { return y > 0.25 && y < 0.75 && z > 0.25 && z < 0.75; });
  return data;
}

std::vector<TriangleId> internal_triangles(const TetMesh& mesh) {
  std::vector<TriangleId> found;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (mesh.triangles[i].tags & tag::kInternal) found.push_back(TriangleId(i));
  return found;
}

TEST(Internal, AreDroppedUnlessAskedFor) {
  const BuildResult dropped = build(floating());
  EXPECT_EQ(dropped.summary.dropped_triangles, 8);
  EXPECT_TRUE(internal_triangles(dropped.mesh).empty());
  expect_sound(dropped.mesh);
}

TEST(Internal, AreKeptWhereTheyAreRequired) {
  MeshData data = floating();
  data.required_triangles = {1, 6};
  const BuildResult kept = build(data);
  EXPECT_EQ(kept.summary.dropped_triangles, 6);
  expect_sound(kept.mesh);
  const std::vector<TriangleId> sheet = internal_triangles(kept.mesh);
  ASSERT_EQ(sheet.size(), 2u);
  for (const TriangleId i : sheet) EXPECT_TRUE(kept.mesh.triangles[i].tags & tag::kRequired);
}

TEST(Internal, AreKeptWithTheirReferenceAndRim) {
  const BuildResult kept = build(floating(), kKeep);
  EXPECT_EQ(kept.summary.dropped_triangles, 0);
  EXPECT_EQ(kept.summary.made_triangles, 6 * 2 * 16);
  expect_sound(kept.mesh);
  const std::vector<TriangleId> sheet = internal_triangles(kept.mesh);
  ASSERT_EQ(sheet.size(), 8u);
  int rim = 0;
  for (const TriangleId i : sheet) {
    const Triangle& s = kept.mesh.triangles[i];
    EXPECT_EQ(s.ref, kSheetRef);
    EXPECT_TRUE(s.sides[0].is_tet() && s.sides[1].is_tet());
    for (const Tag t : s.edge_tag) rim += (t & tag::kNonManifold) != 0;
  }
  EXPECT_EQ(rim, 8);
}

TEST(Internal, OfASheetFaceTheSameWay) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    MeshData data = floating();
    Random random(seed);
    for (auto& t : data.triangles)
      if (random.unit() < 0.5) std::swap(t[1], t[2]);
    const TetMesh mesh = build(data, kKeep).mesh;
    expect_sound(mesh);
    double normal = 0;
    for (const TriangleId i : internal_triangles(mesh)) {
      const auto& v = mesh.triangles[i].v;
      normal +=
          cross(mesh.points[v[1]] - mesh.points[v[0]], mesh.points[v[2]] - mesh.points[v[0]]).x;
    }
    EXPECT_NEAR(std::abs(normal) / 2, 0.25, 1e-12);
  }
}

TEST(Internal, ComeBackFromTheLists) {
  const TetMesh mesh = build(floating(), kKeep).mesh;
  const BuildResult again = build(to_data(mesh), kKeep);
  EXPECT_EQ(again.summary.dropped_triangles, 0);
  EXPECT_EQ(again.summary.made_triangles, 0);
  expect_sound(again.mesh);
  ASSERT_EQ(again.mesh.triangles.size(), mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    EXPECT_EQ(again.mesh.triangles[i].v, mesh.triangles[i].v);
    EXPECT_EQ(again.mesh.triangles[i].tags, mesh.triangles[i].tags);
    // Listed edges come back as reference edges, too.
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(again.mesh.triangles[i].edge_tag[k] & tag::kNonManifold,
                mesh.triangles[i].edge_tag[k] & tag::kNonManifold);
  }
}

TEST(Internal, AreLinkedAnew) {
  TetMesh mesh = build(floating(), kKeep).mesh, twin = mesh;
  link_faces(mesh);
  attach_triangles(mesh);
  expect_sound(mesh);
  EXPECT_EQ(internal_triangles(mesh).size(), 8u);
}

TEST(Internal, CheckSeesATagThatIsWrong) {
  TetMesh mesh = build(floating(), kKeep).mesh;
  const TriangleId inside = internal_triangles(mesh)[0];
  mesh.triangles[inside].tags = 0;
  EXPECT_FALSE(check(mesh).sound());
  mesh.triangles[inside].tags = tag::kInternal;
  EXPECT_TRUE(check(mesh).sound());
  for (Triangle& s : mesh.triangles)
    if (s.sides[1].is_unset()) {
      s.tags |= tag::kInternal;
      break;
    }
  EXPECT_FALSE(check(mesh).sound());
}

/// Normals of two vertices, one of them twice, and of a vertex of no tet.
MeshData with_normals() {
  MeshData data = kuhn_cube(2);
  data.vertices.insert(data.vertices.begin(), Vec3{9, 9, 9});
  data.vertex_refs.push_back(0);
  for (auto& tet : data.tets)
    for (std::int32_t& v : tet) ++v;
  data.normals = {{0, 0, 3}, {1, 0, 0}, {0, 0, 0}};
  data.normal_at_vertices = {{5, 1}, {2, 0}, {5, 0}, {0, 1}, {3, 2}};
  return data;
}

TEST(GivenNormals, AreThoseOfUsedVertices) {
  TetMesh mesh = build(with_normals()).mesh;
  expect_sound(mesh);
  ASSERT_EQ(mesh.normals.size(), 2u);
  EXPECT_EQ(mesh.normals[0].vertex, 1);
  EXPECT_EQ(mesh.normals[0].normal, (Vec3{0, 0, 3}));
  EXPECT_EQ(mesh.normals[1].vertex, 4);
  EXPECT_EQ(mesh.normals[1].normal, (Vec3{1, 0, 0}));
  compact(mesh);
  const MeshData out = to_data(mesh);
  ASSERT_EQ(out.normal_at_vertices.size(), 2u);
  EXPECT_EQ(out.normal_at_vertices[1], (std::array<std::int32_t, 2>{4, 1}));
  EXPECT_EQ(out.normals[1], (Vec3{1, 0, 0}));
}

TEST(GivenNormals, AreRefusedOutOfRange) {
  MeshData data = with_normals();
  data.normal_at_vertices.push_back({1, 3});
  EXPECT_ANY_THROW(build(data));
  data.normal_at_vertices.back() = {-1, 0};
  EXPECT_ANY_THROW(build(data));
}

TEST(GivenNormals, OfAVertexThatIsNoneAreFound) {
  TetMesh mesh = build(kuhn_cube(1)).mesh;
  mesh.normals = {{8, {1, 0, 0}}};
  EXPECT_FALSE(check(mesh).sound());
}

}  // namespace
}  // namespace cavea::test
