#include <bit>
#include <map>

#include "subdivide/support.h"

namespace cavea::test {
namespace {

/// `data` with vertex v renamed to order[v].
MeshData renamed(const MeshData& data, const std::vector<int>& order) {
  MeshData out = data;
  for (std::size_t v = 0; v < order.size(); ++v) out.vertices[order[v]] = data.vertices[v];
  for (auto& tet : out.tets)
    for (auto& v : tet) v = order[v];
  return out;
}

/// Splits the edges whose bit is set, numbered by their rank among all edges.
TetMesh split_mask(const TetMesh& mesh, unsigned mask) {
  std::map<std::pair<VertexId, VertexId>, int> rank;
  for (const auto& tet : mesh.tets)
    for (const auto& e : kEdgeVertices) rank[std::minmax({tet[e[0]], tet[e[1]]})] = 0;
  int next = 0;
  for (auto& [edge, r] : rank) r = next++;
  return subdivide(
      mesh,
      [&](const MeshEdge& e) {
        return mask >> rank.at({e.a, e.b}) & 1;
      },
      straight(mesh));
}

double smallest_volume(const TetMesh& mesh) {
  double least = INFINITY;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto [a, b, c, d] = mesh.corners(TetId(t));
    least = std::min(least, volume6(a, b, c, d) / 6);
  }
  return least;
}

int count_faces_of_kind(const TetMesh& mesh, bool surface) {
  int count = 0;
  for (const auto& links : mesh.links)
    for (const FaceLink link : links) count += surface ? link.is_triangle() : link.is_tet();
  return count;
}

TEST(Pattern, CutsOneTetByAllMasksAndOrders) {
  const double whole = volume(build(single_tet()).mesh);
  std::vector<int> order = {0, 1, 2, 3};
  do {
    const TetMesh mesh = build(renamed(single_tet(), order)).mesh;
    for (unsigned mask = 0; mask < 64; ++mask) {
      SCOPED_TRACE(::testing::Message()
                   << "mask " << mask << " order " << ::testing::PrintToString(order));
      const TetMesh cut = split_mask(mesh, mask);
      expect_sound(cut);
      EXPECT_EQ(int(cut.points.size()), 4 + std::popcount(mask));
      EXPECT_NEAR(volume(cut), whole, 1e-14);
      // All volumes are multiples of an eighth.
      EXPECT_GT(smallest_volume(cut), whole / 8 * (1 - 1e-12));
      // Each split edge makes one more triangle of each of the two faces at it.
      EXPECT_EQ(int(cut.triangles.size()), 4 + 2 * std::popcount(mask));
      EXPECT_EQ(count_faces_of_kind(cut, true), int(cut.triangles.size()));
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

/// Numbers of tets that occur, for each number of split edges.
TEST(Pattern, MakesAsManyTetsAsItMust) {
  const TetMesh mesh = build(single_tet()).mesh;
  std::map<int, std::pair<int, int>> range;  // smallest and largest
  for (unsigned mask = 0; mask < 64; ++mask) {
    const int made = int(split_mask(mesh, mask).tets.size());
    auto& [low, high] = range.try_emplace(std::popcount(mask), made, made).first->second;
    low = std::min(low, made), high = std::max(high, made);
  }
  const std::map<int, std::pair<int, int>> expected = {
      {0, {1, 1}}, {1, {2, 2}}, {2, {3, 4}}, {3, {4, 5}}, {4, {6, 6}}, {5, {7, 7}}, {6, {8, 8}}};
  EXPECT_EQ(range, expected);
}

TEST(Pattern, CutsAnOctahedronByItsShortestDiagonal) {
  MeshData data = single_tet();
  for (int longer = 0; longer < 3; ++longer) {
    data.vertices = {{0, 0, 0}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}};
    for (Vec3& p : data.vertices) (longer == 0 ? p.x : longer == 1 ? p.y : p.z) *= 0.5;
    const TetMesh mesh = build(data).mesh;
    const TetMesh cut = subdivide(mesh, every_edge, straight(mesh));
    // The midpoints of opposite edges lie on the axes; the squeezed one has the shortest diagonal.
    double longest = 0;
    for (const auto& tet : cut.tets)
      for (const auto& e : kEdgeVertices)
        if (tet[e[0]] >= 4 && tet[e[1]] >= 4)
          longest = std::max(longest, distance(cut.points[tet[e[0]]], cut.points[tet[e[1]]]));
    EXPECT_LT(longest, 0.75) << "a diagonal of length 1 is used";
  }
}

TEST(Pattern, AgreesAcrossAFace) {
  std::vector<int> order = {0, 1, 2, 3, 4};
  int turn = 0;
  do {
    const TetMesh mesh = build(renamed(two_tets(), order)).mesh;
    // Each order with an eighth of the 512 masks, so that each mask meets 15 orders.
    for (unsigned mask = unsigned(turn++ % 8); mask < 512; mask += 8) {
      const TetMesh cut = split_mask(mesh, mask);
      const CheckResult result = check(cut);
      ASSERT_TRUE(result.sound()) << result.message() << "; mask " << mask << " order "
                                  << ::testing::PrintToString(order);
      ASSERT_NEAR(volume(cut), 0.5, 1e-14);
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

}  // namespace
}  // namespace cavea::test
