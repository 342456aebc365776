#include "cavea/part/seed.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "cavea/base/error.h"
#include "cavea/base/parallel.h"
#include "cavea/mesh/build.h"
#include "cavea/mesh/compact.h"
#include "cavea/mesh/statistics.h"
#include "support/expect.h"
#include "support/meshes.h"
#include "support/shape.h"

namespace cavea::test {
namespace {

const Box kUnit{{0, 0, 0}, {1, 1, 1}};

/// All points of a level in the unit cube, from the tets of a mesh of it.
std::vector<std::array<double, 3>> points_of(const TetMesh& mesh, const Lattice& lattice, int level,
                                             int coarsest) {
  std::vector<std::array<double, 3>> points;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    lattice.for_each_inside(mesh.corners(TetId(t)), kUnit, level, coarsest, [&](const Vec3& p) {
      points.push_back({p.x, p.y, p.z});
    });
  std::sort(points.begin(), points.end());
  return points;
}

TEST(Lattice, HasEachPointInOneTet) {
  constexpr std::uint64_t kSeed = 7;
  MeshData perturbed = kuhn_cube(6);
  perturb_inside(perturbed, 0.015, kSeed);
  const Lattice lattice{0.0371};
  for (const MeshData& data : {kuhn_cube(5), perturbed}) {
    const TetMesh mesh = build(data).mesh;
    std::set<std::array<double, 3>> finer;
    for (int level = 2; level >= 0; --level) {
      SCOPED_TRACE(testing::Message() << "level " << level << ", seed " << kSeed);
      const auto points = points_of(mesh, lattice, level, 2);
      EXPECT_TRUE(std::adjacent_find(points.begin(), points.end()) == points.end()) << "twice";
      for (const auto& p : points) EXPECT_TRUE(finer.insert(p).second) << "of a coarser level";
      // Those of all levels so far are those of this one alone.
      const auto all = points_of(mesh, lattice, level, level);
      EXPECT_EQ(all.size(), finer.size());
      const double cell = lattice.cell_at(level);
      EXPECT_NEAR(double(all.size()) * cell * cell * cell, 2, 12 * cell);
    }
  }
}

TetMesh cube(int n, double size) {
  TetMesh mesh = build(kuhn_cube(n)).mesh;
  std::fill(mesh.sizes.begin(), mesh.sizes.end(), float(size));
  return mesh;
}

SeedOptions seeds_of(double cell) {
  SeedOptions options;
  options.lattice.cell = cell;
  return options;
}

VerdictTable seed_all(TetMesh& mesh, const SeedOptions& options, int coarsest) {
  VerdictTable verdicts;
  for (int level = coarsest; level >= 0; --level) {
    verdicts += seed_level(mesh, options, level, coarsest);
    expect_sound(mesh);
    compact(mesh);
  }
  return verdicts;
}

TEST(Seeds, AroundASmallSizeAreThoseOfALookAtAllPoints) {
  // Levels down to a hundredth of the tets, in which few points are wanted.
  SeedOptions near = seeds_of(0.01);
  near.growth = std::log(1.3);
  SeedOptions all = near;
  all.size = [](const Vec3&, double bound) { return bound; };
  std::vector<std::vector<Vec3>> results;
  for (const SeedOptions& options : {near, all}) {
    TetMesh mesh = cube(1, 0.5);
    mesh.sizes[0] = mesh.sizes[7] = 0.01f;
    seed_all(mesh, options, 5);
    std::ranges::sort(mesh.points, [](const Vec3& a, const Vec3& b) {
      return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    });
    results.push_back(mesh.points);
  }
  EXPECT_GT(results[0].size(), 100u);
  EXPECT_EQ(results[0], results[1]);
}

TEST(Seeds, CanBeCancelled) {
  std::atomic<bool> cancel = true;
  SeedOptions options = seeds_of(0.05);
  options.cancel = &cancel;
  TetMesh mesh = cube(1, 0.05);
  EXPECT_THROW(seed_level(mesh, options, 0, 0), Cancelled);
}

TEST(Seeds, FillTheVolumeWithTheLattice) {
  constexpr double kSize = 0.05;
  TetMesh mesh = cube(1, kSize);
  const Euler before = euler(mesh);
  seed_all(mesh, seeds_of(1.08 * kSize), 3);
  EXPECT_EQ(euler(mesh), before);
  EXPECT_NEAR(volume(mesh), 1, 1e-12);
  // Two cells from the boundary the mesh is the lattice's own.
  std::int64_t inside = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto corners = mesh.corners(TetId(t));
    if (!std::ranges::all_of(corners, [&](const Vec3& p) {
          return std::min({p.x, p.y, p.z, 1 - p.x, 1 - p.y, 1 - p.z}) > 4 * kSize;
        }))
      continue;
    ++inside;
    EXPECT_NEAR(mesh.qualities[t], 0.93, 0.01);
  }
  EXPECT_GT(inside, 10000);
}

TEST(Seeds, AreAddedWhereNothingIsNear) {
  TetMesh mesh = cube(4, 0.05);
  const auto first = seed_all(mesh, seeds_of(0.054), 2).accepted(Operator::kVertexInsert);
  EXPECT_GT(first, 5000);
  EXPECT_LT(seed_all(mesh, seeds_of(0.054), 2).accepted(Operator::kVertexInsert), first / 200);
  TetMesh fine = cube(16, 0.12);
  EXPECT_EQ(seed_all(fine, seeds_of(0.1296), 2).accepted(Operator::kVertexInsert), 0);
}

void make_replaceable(TetMesh& mesh) {
  for (Tag& tags : mesh.vertex_tags)
    if (tags == 0) tags |= tag::kReplaceable;
}

TEST(Seeds, TakeThePlaceOfWhatIsReplaceable) {
  constexpr int kCells = 16;
  TetMesh mesh = cube(kCells, 1.0 / kCells);
  const Euler before = euler(mesh);
  make_replaceable(mesh);
  const auto replaceable = std::ranges::count_if(
      mesh.vertex_tags, [](Tag tags) { return (tags & tag::kReplaceable) != 0; });
  EXPECT_EQ(replaceable, (kCells - 1) * (kCells - 1) * (kCells - 1));
  seed_all(mesh, seeds_of(1.08 / kCells), 2);
  EXPECT_EQ(euler(mesh), before);
  EXPECT_NEAR(volume(mesh), 1, 1e-12);
  const auto left = std::ranges::count_if(mesh.vertex_tags,
                                          [](Tag tags) { return (tags & tag::kReplaceable) != 0; });
  EXPECT_LT(left, replaceable / 3);                // beside the boundary
  EXPECT_GT(quality_statistics(mesh).mean, 0.74);  // 0.657 before
}

TEST(Seeds, FollowTheSizes) {
  TetMesh mesh = cube(4, 0.25);
  SeedOptions options = seeds_of(0.02);
  options.growth = std::log(1.3);
  const auto wanted = [](const Vec3& p) { return 0.02 + 0.2 * p.x; };
  options.size = [&](const Vec3& p, double bound) { return std::min(bound, wanted(p)); };
  seed_all(mesh, options, 4);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Vec3& p = mesh.points[v];
    if (mesh.vertex_tags[v] & tag::kSurface) continue;
    EXPECT_LE(mesh.sizes[v], wanted(p) * 1.0001 + 0.25 * (mesh.sizes[v] == 0.25F));
  }
  const auto in_slab = [&](double low, double high) {
    return std::ranges::count_if(mesh.points,
                                 [&](const Vec3& p) { return low <= p.x && p.x < high; });
  };
  EXPECT_GT(in_slab(0, 0.2), 10 * in_slab(0.6, 0.8));
}

TEST(Seeds, AreTheSameAtAnyNumberOfThreads) {
  TetMesh one;
  for (const int threads : {1, 2, 3, 8}) {
    TetMesh mesh = cube(5, kSanitized ? 0.06 : 0.03);
    run_in_arena(threads, [&] { seed_all(mesh, seeds_of(kSanitized ? 0.065 : 0.0324), 3); });
    if (threads == 1)
      one = std::move(mesh);
    else
      expect_same(one, mesh);
  }
}

TEST(Seeds, TakeTheSamePlacesAtAnyNumberOfThreads) {
  constexpr int kCells = kSanitized ? 12 : 28;
  TetMesh one;
  for (const int threads : {1, 2, 3, 8}) {
    TetMesh mesh = cube(kCells, 1.0 / kCells);
    make_replaceable(mesh);
    run_in_arena(threads, [&] { seed_all(mesh, seeds_of(1.08 / kCells), 2); });
    if (threads == 1)
      one = std::move(mesh);
    else
      expect_same(one, mesh);
  }
}

}  // namespace
}  // namespace cavea::test
