#include "cavea/part/clusters.h"

#include <numeric>
#include <set>
#include <span>

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

constexpr int kLists = 40, kTets = 200;

std::vector<std::set<TetId>> random_sets(std::size_t members, std::uint64_t seed) {
  Random random(seed);
  std::vector<std::set<TetId>> sets(kLists);
  for (auto& set : sets)
    while (set.size() < members) set.insert(random.below(kTets));
  return sets;
}

TEST(Conflicts, AreOfListsThatShareATet) {
  constexpr std::uint64_t kSeed = 7;
  const std::vector<std::set<TetId>> sets = random_sets(8, kSeed);
  std::vector<TetList> lists;
  for (const auto& set : sets) lists.emplace_back(set.begin(), set.end());
  const Graph graph = conflicts_of(lists);
  ASSERT_EQ(graph.size(), kLists);
  for (int a = 0; a < kLists; ++a) {
    std::vector<std::int32_t> expected;
    for (int b = 0; b < kLists; ++b)
      if (b != a && std::ranges::any_of(sets[a], [&](TetId t) { return sets[b].contains(t); }))
        expected.push_back(b);
    const std::span<const std::int32_t> row = graph.row(a);
    EXPECT_EQ(std::vector(row.begin(), row.end()), expected) << "list " << a << ", seed " << kSeed;
  }
}

TEST(Conflicts, AreGoneOnceTheirListsAreJoined) {
  constexpr std::uint64_t kSeed = 11;
  std::vector<TetList> lists;
  std::set<TetId> all;
  for (const auto& set : random_sets(2, kSeed)) {
    lists.emplace_back(set.begin(), set.end());
    all.insert(set.begin(), set.end());
  }
  const std::vector<TetList> components = joined(lists, conflicts_of(lists));
  EXPECT_GT(components.size(), 1u) << "seed " << kSeed;
  EXPECT_LT(components.size(), lists.size()) << "seed " << kSeed;
  std::set<TetId> seen;
  for (const TetList& list : components) {
    const std::set<TetId> members(list.begin(), list.end());
    for (const TetId t : members) EXPECT_TRUE(seen.insert(t).second) << "seed " << kSeed;
  }
  EXPECT_EQ(seen, all) << "seed " << kSeed;
}

}  // namespace
}  // namespace cavea::test
