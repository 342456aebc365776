// Lengths between lattices of different sizes are evened out, without harm to tets and surface.
#include "cavea/remesh/evening.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>
#include <vector>

#include "cavea/base/cancel.h"
#include "cavea/base/parallel.h"
#include "cavea/mesh/statistics.h"
#include "cavea/remesh/seeding.h"
#include "cavea/remesh/stubborn.h"
#include "remesh/support.h"

namespace cavea::test {
namespace {

double graded(const Vec3& p) { return 0.03 + 0.2 * std::abs(norm(p) - 0.6); }

/// The unit cube of so many bricks a side, filled with seeds of these sizes.
TetMesh seeded(const SizeField& size, int bricks = 16) {
  TetMesh mesh = built(kuhn_cube(bricks));
  classify_features(mesh, {});
  const auto set_sizes = [&] {
    for (std::size_t v = 0; v < mesh.points.size(); ++v)
      mesh.sizes[v] = float(size(mesh.points[v]));
  };
  set_sizes();
  tag_replaceable(mesh);
  const SizeLaw law{0.01, 0.2, 1.3, 1, size};
  VerdictTable verdicts;
  seed_interior(mesh, law, nullptr, verdicts);
  set_sizes();
  return mesh;
}

std::vector<std::size_t> bound_vertices(const TetMesh& mesh) {
  std::vector<std::size_t> bound;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (!tag::is_unbound(mesh.vertex_tags[v])) bound.push_back(v);
  return bound;
}

TEST(Evening, MakesMoreLengthsConformAndLeavesTetsSound) {
  TetMesh mesh = seeded(graded, 12);
  const TetMesh before = mesh;
  even_out(mesh, nullptr);
  expect_sound(mesh);
  EXPECT_GT(length_statistics(mesh).conforming_percent(),
            length_statistics(before).conforming_percent() + 1);
  EXPECT_GT(quality_statistics(mesh).mean, quality_statistics(before).mean + 0.005);
  EXPECT_EQ(mesh.tets, before.tets);
  EXPECT_EQ(mesh.sizes, before.sizes);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    EXPECT_GE(mesh.qualities[t], std::min(float(kSoundQuality), before.qualities[t]));
}

TEST(Evening, LeavesWhatIsBoundWhereItIs) {
  constexpr std::uint64_t kSeed = 5;
  SCOPED_TRACE(testing::Message() << "seed " << kSeed);
  Random random(kSeed);
  TetMesh mesh = seeded(graded);
  for (Tag& tags : mesh.vertex_tags)
    if (random.below(10) == 0) tags |= tag::kRequired;
  const TetMesh before = mesh;
  even_out(mesh, nullptr);
  EXPECT_NE(mesh.points, before.points);
  for (const std::size_t v : bound_vertices(mesh)) EXPECT_EQ(mesh.points[v], before.points[v]);
}

TEST(Evening, LeavesALatticeAsItIs) {
  constexpr double kSize = 0.05;
  TetMesh mesh = seeded([](const Vec3&) { return kSize; }, 1);
  const TetMesh before = mesh;
  even_out(mesh, nullptr);
  // A step spreads what is uneven by an edge.
  constexpr double kFar = 6 * kSize;
  int far = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Vec3& p = before.points[v];
    if (std::min({p.x, p.y, p.z, 1 - p.x, 1 - p.y, 1 - p.z}) < kFar) continue;
    ++far;
    EXPECT_LT(distance(mesh.points[v], p), 1e-6 * kSize);
  }
  EXPECT_GT(far, 500);
}

TEST(Evening, DoesNotDependOnTheNumberOfThreads) {
  const TetMesh start = seeded(graded);
  TetMesh one;
  for (const int threads : {1, 2, 3, 8}) {
    TetMesh mesh = start;
    run_in_arena(threads, [&] { even_out(mesh, nullptr); });
    if (threads == 1)
      one = std::move(mesh);
    else
      expect_same(one, mesh);
  }
}

TEST(Evening, CanBeCancelled) {
  const std::atomic<bool> cancel{true};
  TetMesh mesh = seeded(graded);
  const TetMesh before = mesh;
  EXPECT_THROW(even_out(mesh, &cancel), Cancelled);
  expect_same(mesh, before);
}

TEST(Evening, OfAResultLeavesItAsGoodAsOthers) {
  // Nearly all vertices are seeds whose sizes vary: what it is for.
  TetMesh mesh = built(kuhn_cube(4));
  const Report report = remesh(mesh, graded, {});
  expect_sound(mesh);
  expect_good(report);
  EXPECT_GE(report.after.quality.worst, 0.4);
  EXPECT_GE(report.after.quality.mean, 0.81);
  EXPECT_GE(report.after.lengths.conforming_percent(), 97);
}

}  // namespace
}  // namespace cavea::test
