#include "cavea/part/clusters.h"

#include <numeric>
#include <set>

#include "part/support.h"

namespace cavea::test {
namespace {

TetMesh cube() { return build(kuhn_cube(6)).mesh; }

/// Every third tet or so.
TetList some_tets(const TetMesh& mesh, std::uint64_t seed) {
  Random random(seed);
  TetList tets;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    if (random.below(3) == 0) tets.push_back(TetId(t));
  return tets;
}

bool share_a_vertex(const TetMesh& mesh, TetId a, TetId b) {
  for (const VertexId v : mesh.tets[a])
    if (mesh.local_index(b, v) < 4) return true;
  return false;
}

TEST(Clusters, TakeEachTetOnceAndFewTogether) {
  constexpr std::uint64_t kSeed = 5;
  constexpr std::size_t kMost = 20;
  const TetMesh mesh = cube();
  const TetList tets = some_tets(mesh, kSeed);
  TetList all;
  for (const TetList& cluster : clusters_of(mesh, tets, kMost)) {
    EXPECT_LE(cluster.size(), kMost);
    all.insert(all.end(), cluster.begin(), cluster.end());
  }
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all, tets) << "seed " << kSeed;
}

TEST(Clusters, AreApartUnlessTheyAreFull) {
  const TetMesh mesh = cube();
  TetList far;  // two corners of the cube
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto [a, b, c, d] = mesh.corners(TetId(t));
    const Vec3 center = (a + b + c + d) / 4;
    if (norm(center) < 0.3 || norm(center - Vec3{1, 1, 1}) < 0.3) far.push_back(TetId(t));
  }
  const std::vector<TetList> clusters = clusters_of(mesh, far, mesh.tets.size());
  ASSERT_EQ(clusters.size(), 2u);
  for (const TetId a : clusters[0])
    for (const TetId b : clusters[1]) EXPECT_FALSE(share_a_vertex(mesh, a, b));
}

TEST(Conflicts, AreOfListsThatShareATet) {
  constexpr std::uint64_t kSeed = 7;
  constexpr int kLists = 40, kTets = 200, kMembers = 8;
  Random random(kSeed);
  std::vector<std::set<TetId>> sets(kLists);
  for (auto& set : sets)
    while (int(set.size()) < kMembers) set.insert(random.below(kTets));
  std::vector<TetList> lists;
  for (const auto& set : sets) lists.emplace_back(set.begin(), set.end());
  const Graph graph = conflicts_of(lists);
  ASSERT_EQ(graph.size(), kLists);
  for (int a = 0; a < kLists; ++a) {
    std::vector<std::int32_t> expected;
    for (int b = 0; b < kLists; ++b)
      if (b != a && std::ranges::any_of(sets[a], [&](TetId t) { return sets[b].contains(t); }))
        expected.push_back(b);
    const std::vector<std::int32_t> row(graph.neighbours.begin() + graph.offsets[a],
                                        graph.neighbours.begin() + graph.offsets[a + 1]);
    EXPECT_EQ(row, expected) << "list " << a << ", seed " << kSeed;
  }
}

}  // namespace
}  // namespace cavea::test
