// Tets halved in place, against the same edges divided by patterns.
#include "cavea/implicit/bisect.h"

#include <algorithm>
#include <tuple>

#include "cavea/base/parallel.h"
#include "cavea/mesh/build.h"
#include "cavea/subdivide/subdivide.h"
#include "cavea/surface/features.h"
#include "support/expect.h"
#include "support/meshes.h"
#include "support/shape.h"

namespace cavea::test {
namespace {

constexpr int kRounds = 6;

std::vector<char> coins(std::size_t n, Random& random) {
  std::vector<char> heads(n);
  for (char& head : heads) head = random.unit() < 0.3;
  return heads;
}

/// With an interface and the edges of the box as ridges.
TetMesh random_cube(int n, std::uint64_t seed) {
  MeshData data = kuhn_cube(n);
  perturb_inside(data, 0.1 / n, seed);
  set_refs(data, [](const Vec3& c) { return c.x + c.y < 0.9 ? 3 : 7; });
  return build(shuffled(data, seed)).mesh;
}

TetMesh divided_by_patterns(const TetMesh& mesh, const Bisection& bisection) {
  return subdivide(
      mesh,
      [&](const MeshEdge& e) {
        return std::ranges::binary_search(bisection.edges, std::pair(e.a, e.b));
      },
      [&](const MeshEdge& e) { return straight_midpoint(mesh, e); });
}

/// The tets with their reference and flags, in an order that does not know ids.
auto sorted_tets(const TetMesh& mesh) {
  std::vector<std::tuple<std::array<VertexId, 4>, std::int32_t, std::uint8_t>> tets;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    tets.push_back({mesh.tets[t], mesh.tet_refs[t], mesh.tet_flags[t]});
    std::ranges::sort(std::get<0>(tets.back()));
  }
  std::ranges::sort(tets);
  return tets;
}

TEST(Bisect, MakesTheTetsThatPatternsMake) {
  const std::uint64_t first = std::random_device{}() % 1000000;
  for (std::uint64_t seed = first; seed < first + 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    TetMesh mesh = random_cube(4, seed);
    for (int round = 0; round < kRounds; ++round) {
      const Bisection bisection = choose_longest_edges(mesh, coins(mesh.tets.size(), random));
      ASSERT_FALSE(bisection.edges.empty());
      const TetMesh expected = divided_by_patterns(mesh, bisection);
      bisect(mesh, bisection);
      expect_sound(mesh);
      EXPECT_TRUE(mesh.points == expected.points);
      EXPECT_TRUE(mesh.vertex_tags == expected.vertex_tags);
      EXPECT_TRUE(sorted_tets(mesh) == sorted_tets(expected));
      EXPECT_EQ(mesh.triangles.size(), expected.triangles.size());
      expect_near(area_of_ref(mesh), area_of_ref(expected), 1e-12);
      EXPECT_NEAR(feature_length(mesh), feature_length(expected), 1e-9);
    }
  }
}

TEST(Bisect, KeepsSoundWhatTouchesItself) {
  const std::uint64_t first = std::random_device{}() % 1000000;
  for (std::uint64_t seed = first; seed < first + 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    TetMesh mesh = build(shuffled(polycube(4, 0.5, seed), seed)).mesh;
    classify_features(mesh, {});
    const double before = volume(mesh);
    for (int round = 0; round < kRounds; ++round)
      bisect(mesh, choose_longest_edges(mesh, coins(mesh.tets.size(), random)));
    expect_sound(mesh);
    EXPECT_NEAR(volume(mesh), before, 1e-12 * before);
  }
}

TEST(Bisect, GivesTheSameMeshAtAnyNumberOfThreads) {
  const auto run = [](int threads) {
    TetMesh mesh = random_cube(5, 3);
    Random random(3);
    run_in_arena(threads, [&] {
      for (int round = 0; round < kRounds; ++round)
        bisect(mesh, choose_longest_edges(mesh, coins(mesh.tets.size(), random)));
    });
    return mesh;
  };
  const TetMesh expected = run(1);
  for (const int threads : {2, 3, 8}) expect_same(run(threads), expected);
}

}  // namespace
}  // namespace cavea::test
