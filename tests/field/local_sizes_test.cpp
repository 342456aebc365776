// Bounds by reference, and sizes in boxes and spheres.
#include <cmath>
#include <limits>

#include "cavea/field/local_bounds.h"
#include "cavea/field/size_regions.h"
#include "cavea/mesh/build.h"
#include "support/expect.h"
#include "support/meshes.h"

namespace cavea::test {
namespace {

using Entity = LocalParameters::Entity;

TEST(LocalBounds, AreThoseOfTheReferencesThatAVertexTouches) {
  MeshData data = kuhn_cube(4);
  set_refs(data, [](const Vec3& c) { return c.x < 0.5 ? 2 : 5; });
  const TetMesh mesh = build(data).mesh;
  // Its triangles have the smaller reference of their two sides: all at x <= 0.5 have 2.
  const std::vector<LocalParameters> local = {{Entity::kTets, 5, 0.01, 0.2, {}},
                                              {Entity::kTriangles, 2, {}, 0.1, {}},
                                              {Entity::kTets, 77, 1e-9, 1e-9, {}},
                                              {Entity::kTriangles, 5, {}, {}, 0.001}};
  const VertexBounds bounds = bounds_of_vertices(mesh, 0.05, 0.4, local);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Vec3& p = mesh.points[v];
    const bool on_surface = p.x == 0 || p.y == 0 || p.y == 1 || p.z == 0 || p.z == 1;
    const bool on_2 = p.x == 0.5 || (p.x < 0.5 && on_surface);
    EXPECT_EQ(bounds.hmin[v], p.x >= 0.5 ? 0.01f : 0.05f);
    EXPECT_EQ(bounds.hmax[v], on_2 ? 0.1f : p.x >= 0.5 ? 0.2f : 0.4f);
  }
}

TEST(LocalBounds, GiveWayFromBelow) {
  const TetMesh mesh = build(kuhn_cube(1)).mesh;
  const std::vector<LocalParameters> local = {{Entity::kTets, 1, {}, 0.1, {}}};
  const VertexBounds bounds = bounds_of_vertices(mesh, 0.2, 0.4, local);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    EXPECT_EQ(bounds.hmin[v], 0.1f);
    EXPECT_EQ(bounds.hmax[v], 0.1f);
  }
}

TEST(SizeRegions, HoldInsideAndRiseOutside) {
  const std::vector<SizeRegion> regions = {SizeBox{{0, 0, 0}, {1, 2, 3}, 0.1},
                                           SizeSphere{{10, 0, 0}, 2, 0.05}};
  const SizeField field = with_regions({}, regions, 1.3);
  const double slope = std::log(1.3);
  EXPECT_EQ(field({0.5, 2, 1}), 0.1);
  EXPECT_DOUBLE_EQ(field({1, 5, 7}), 0.1 + 5 * slope);
  EXPECT_EQ(field({10, 1, 1}), 0.05);
  EXPECT_DOUBLE_EQ(field({13, 4, 0}), 0.05 + 3 * slope);
}

TEST(SizeRegions, OnlyLowerTheField) {
  const auto wish = [](const Vec3& p) { return p.x; };
  const SizeField field = with_regions(wish, {SizeSphere{{1, 0, 0}, 0.5, 0.2}}, 1.3);
  EXPECT_EQ(field({1, 0, 0}), 0.2);
  EXPECT_EQ(field({0.1, 0, 0}), 0.1);
  EXPECT_TRUE(std::isnan(field({std::nan(""), 0, 0}))) << "left to be refused";
}

TEST(SizeRegions, RiseWithoutGradationToo) {
  const SizeField field =
      with_regions({}, {SizeSphere{{0, 0, 0}, 1, 0.1}}, std::numeric_limits<double>::infinity());
  EXPECT_DOUBLE_EQ(field({3, 0, 0}), 2.1);
  EXPECT_EQ(field({1, 0, 0}), 0.1);
}

}  // namespace
}  // namespace cavea::test
