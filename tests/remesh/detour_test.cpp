// Tets that no single operation mends: one that makes them worse first leads on.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "remesh/steps.h"
#include "remesh/support.h"

namespace cavea::test {
namespace {

/// Two walls that meet at an angle in degrees, of which their edge is so long.
MeshData wedge(double angle, double length) {
  const double slope = std::tan(angle * std::numbers::pi / 180);
  return mapped(half_cube(2), [&](const Vec3& p) { return Vec3{p.x, slope * p.y, length * p.z}; });
}

std::ptrdiff_t detours(const Report& report) { return times_of("detours", report); }

/// Both walls come to have as many vertices along the edge. Without detours, a fifth of such bodies
/// ended with a tet below 0.3.
TEST(Detour, LeadsOutBetweenWallsOfFourteenDegrees) {
  std::ptrdiff_t taken = 0;
  for (const double degrees : {14.0, 14.3, 14.6, 15.0})
    for (const double length : {0.7, 1.2}) {
      SCOPED_TRACE(testing::Message() << degrees << " degrees, " << length);
      TetMesh mesh = built(wedge(degrees, length));
      const Report report = remesh(mesh, {}, {});
      expect_sound(mesh);
      EXPECT_GE(report.after.quality.worst, 0.3);
      EXPECT_LE(report.surface_distance, 0.001 * std::hypot(1.0, 1.0, length));
      EXPECT_NEAR(report.after.counts.volume, report.before.counts.volume, 1e-9);
      taken += detours(report);
    }
  EXPECT_GT(taken, 0);
}

TEST(Detour, IsTheSameAtAnyNumberOfThreads) {
  TetMesh first = built(wedge(14, 1));
  EXPECT_GT(detours(remesh(first, {}, {})), 0);
  for (const int threads : {1, 2, 3, 8}) {
    Options options;
    options.threads = threads;
    TetMesh mesh = built(wedge(14, 1));
    remesh(mesh, {}, options);
    expect_same(mesh, first);
  }
}

TEST(Detour, LeavesReferencesAndWhatIsRequired) {
  MeshData body = wedge(14, 1);
  for (std::size_t t = 0; t < body.tets.size(); ++t) {
    double z = 0;
    for (const std::int32_t v : body.tets[t]) z += body.vertices[std::size_t(v)].z / 4;
    body.tet_refs[t] = z < 0.5 ? 1 : 2;
  }
  body.required_vertices = {0, 1, 2, 3};
  TetMesh mesh = built(body);
  const Report report = remesh(mesh, {}, {});
  expect_sound(mesh);
  for (const std::int32_t ref : {1, 2})
    EXPECT_NEAR(report.after.counts.volume_of_ref.at(ref),
                report.before.counts.volume_of_ref.at(ref), 1e-9);
  EXPECT_EQ(report.after.counts.required_vertices, 4);
  for (std::size_t v = 0; v < 4; ++v)
    EXPECT_NE(std::ranges::find(mesh.points, body.vertices[v]), mesh.points.end());
}

TEST(Detour, IsNotTakenWhereAnOperatorIsFrozen) {
  for (bool Freezes::*operation :
       {&Freezes::insert, &Freezes::collapse, &Freezes::swap, &Freezes::move}) {
    Options options;
    options.freeze.*operation = true;
    TetMesh mesh = built(wedge(14, 1));
    EXPECT_EQ(detours(remesh(mesh, {}, options)), 0);
    expect_sound(mesh);
  }
}

}  // namespace
}  // namespace cavea::test
