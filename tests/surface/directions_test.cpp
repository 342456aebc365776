// Normals and tangents for files: which vertices have them, and where they point.
#include "cavea/surface/directions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "surface/shapes.h"

namespace cavea::test {
namespace {

/// Vertex -> its vector; a failure of the test if one has two, or the vector is no unit vector.
std::map<VertexId, Vec3> at_vertices(const std::vector<Vec3>& vectors,
                                     const std::vector<std::array<std::int32_t, 2>>& pairs) {
  std::map<VertexId, Vec3> out;
  for (const auto& [v, n] : pairs) {
    EXPECT_NEAR(norm(vectors[n]), 1, 1e-14);
    EXPECT_TRUE(out.emplace(v, vectors[n]).second) << "vertex " << v << " twice";
  }
  EXPECT_EQ(vectors.size(), pairs.size());
  return out;
}

struct Directions {
  explicit Directions(const Modelled& m) : Directions(surface_directions(m.mesh, m.model)) {}
  explicit Directions(const SurfaceDirections& d)
      : normals(at_vertices(d.normals, d.normal_at_vertices)),
        tangents(at_vertices(d.tangents, d.tangent_at_vertices)) {}
  std::map<VertexId, Vec3> normals, tangents;
};

TEST(SurfaceDirections, OfABallAreItsRadii) {
  const auto ball = modelled_ball(8);
  const Directions d(ball);
  std::size_t surface = 0;
  for (const Tag tags : ball.mesh.vertex_tags) surface += (tags & tag::kSurface) != 0;
  EXPECT_EQ(d.normals.size(), surface);
  EXPECT_TRUE(d.tangents.empty());
  for (const auto& [v, n] : d.normals)
    EXPECT_GT(dot(n, ball.mesh.points[v]), std::cos(0.1)) << "vertex " << v;
}

TEST(SurfaceDirections, OfACylinderHaveTangentsAtItsRims) {
  const auto cylinder = modelled_cylinder(8);
  const Directions d(cylinder);
  for (std::size_t i = 0; i < cylinder.mesh.points.size(); ++i) {
    const auto v = VertexId(i);
    const Vec3& p = cylinder.mesh.points[v];
    const bool lid = p.z == 0 || p.z == 1, wall = std::hypot(p.x, p.y) > 1 - 1e-9;
    EXPECT_EQ(d.normals.count(v), lid != wall) << "vertex " << v;
    EXPECT_EQ(d.tangents.count(v), lid && wall) << "vertex " << v;
    if (lid && !wall) {
      EXPECT_NEAR(d.normals.at(v).z, p.z == 0 ? -1 : 1, 1e-12);
    } else if (wall && !lid) {
      EXPECT_GT(dot(d.normals.at(v), {p.x, p.y, 0}), std::cos(0.05)) << "vertex " << v;
    } else if (lid && wall) {
      EXPECT_NEAR(std::abs(dot(d.tangents.at(v), {-p.y, p.x, 0})), 1, 1e-3) << "vertex " << v;
    }
  }
}

TEST(SurfaceDirections, OfASmoothReferenceEdgeAreBoth) {
  // The upper and the lower half of a ball's surface have different references.
  MeshData data = to_data(build(ball(8)).mesh);
  for (std::size_t t = 0; t < data.triangles.size(); ++t) {
    Vec3 sum;
    for (const std::int32_t v : data.triangles[t]) sum += data.vertices[v];
    data.triangle_refs[t] = sum.z > 0 ? 1 : 2;
  }
  const auto halves = modelled(build(data).mesh);
  const Directions d(halves);
  EXPECT_EQ(d.tangents.size(), 32u);
  for (const auto& [v, t] : d.tangents) {
    const Vec3& p = halves.mesh.points[v];
    EXPECT_NEAR(p.z, 0, 1e-15);
    EXPECT_NEAR(std::abs(dot(t, {-p.y, p.x, 0})), 1, 1e-3) << "vertex " << v;
    ASSERT_TRUE(d.normals.count(v));
    EXPECT_GT(dot(d.normals.at(v), p), std::cos(0.1)) << "vertex " << v;
  }
}

TEST(SurfaceDirections, HaveNoNormalWhereAnInterfaceMeetsTheBoundary) {
  MeshData data = ball(6);
  set_refs(data, [](const Vec3& c) { return c.z + c.x / 1000 > 0 ? 1 : 2; });
  const auto halves = modelled(build(data).mesh);
  const Directions d(halves);
  int inside = 0, rim = 0;
  for (std::size_t i = 0; i < halves.mesh.points.size(); ++i) {
    const auto v = VertexId(i);
    const Vec3& p = halves.mesh.points[v];
    if (std::abs(p.z) > 1e-12) continue;
    if (norm(p) < 1 - 1e-9) {
      // Out of the smaller reference, which is on top.
      ASSERT_TRUE(d.normals.count(v));
      EXPECT_NEAR(d.normals.at(v).z, -1, 1e-12);
      ++inside;
    } else {
      EXPECT_FALSE(d.normals.count(v));
      EXPECT_TRUE(d.tangents.count(v));
      ++rim;
    }
  }
  EXPECT_GT(inside, 10);
  EXPECT_EQ(rim, 24);
}

TEST(SurfaceDirections, OfACubeSkipItsCorners) {
  const auto cube = modelled_cube(3);
  const Directions d(cube);
  EXPECT_EQ(d.normals.size(), 6u * 4);
  EXPECT_EQ(d.tangents.size(), 12u * 2);
}

}  // namespace
}  // namespace cavea::test
