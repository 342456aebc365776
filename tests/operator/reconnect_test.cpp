// Reconnection: the search on polyhedra whose best filling is known, and the operator on bad
// meshes.
#include "cavea/operator/small_polyhedron.h"
#include "operator/stage.h"
#include "support/sheets.h"

namespace cavea::test {
namespace {

double volume(const std::array<Vec3, 4>& p) {
  return dot(p[1] - p[0], cross(p[2] - p[0], p[3] - p[0])) / 6;
}

/// Two poles far from a regular ring of `n`, or near it.
std::vector<Vec3> bipyramid(int n, double height) {
  std::vector<Vec3> points = {{0, 0, -height}, {0, 0, height}};
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    points.push_back({std::cos(angle), std::sin(angle), 0});
  }
  return points;
}

/// Filled by the tets around its axis.
SmallPolyhedron around_axis(const std::vector<Vec3>& points) {
  SmallPolyhedron polyhedron;
  polyhedron.clear();
  for (const Vec3& p : points) polyhedron.add_vertex(p);
  const int n = int(points.size()) - 2;
  for (int i = 0; i < n; ++i)
    polyhedron.add_tet({0, 1, std::uint8_t(2 + i), std::uint8_t(2 + (i + 1) % n)});
  return polyhedron;
}

/// Worst quality and volume of a filling.
std::pair<double, double> measure(std::span<const SmallPolyhedron::Tet> tets,
                                  const std::vector<Vec3>& p) {
  double worst = 1, sum = 0;
  for (const auto& t : tets) {
    worst = std::min(worst, tet_quality(p[t[0]], p[t[1]], p[t[2]], p[t[3]]));
    sum += volume({p[t[0]], p[t[1]], p[t[2]], p[t[3]]});
  }
  return {worst, sum};
}

TEST(SmallPolyhedron, FlatBipyramidsLoseTheirAxisAndTallOnesKeepIt) {
  for (const auto& [height, tets] : {std::pair(1.2, 2u), std::pair(0.2, 3u)}) {
    const std::vector<Vec3> points = bipyramid(3, height);
    SmallPolyhedron polyhedron = around_axis(points);
    ASSERT_TRUE(polyhedron.search(float(kFlat), 0));
    EXPECT_EQ(polyhedron.filling().size(), tets) << height;
  }
}

TEST(SmallPolyhedron, FillingsHaveTheVolumeOfTheHoleAndBeatTheThreshold) {
  constexpr std::uint64_t kSeed = 41;
  Random random(kSeed);
  int found = 0;
  for (int n = 3; n <= 10; ++n) {
    std::vector<Vec3> points = bipyramid(n, 0.9);
    for (Vec3& p : points)
      p = p + 0.2 * Vec3{random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5};
    SmallPolyhedron polyhedron = around_axis(points);
    double hole = 0;
    for (int i = 0; i < n; ++i)
      hole += volume(
          {points[0], points[1], points[std::size_t(2 + i)], points[std::size_t(2 + (i + 1) % n)]});
    for (const double threshold : {1e-6, 0.1, 0.3}) {
      if (!polyhedron.search(float(threshold), 0)) continue;
      const auto [worst, sum] = measure(polyhedron.filling(), points);
      EXPECT_NEAR(sum, hole, 1e-12) << "seed " << kSeed << ", ring of " << n;
      EXPECT_GT(worst, threshold - 1e-7);
      EXPECT_LE(worst, polyhedron.ceiling() + 1e-6);
      ++found;
    }
  }
  EXPECT_GT(found, 10);
}

/// A tet cut in four at a vertex near one of its faces.
TEST(SmallPolyhedron, DropsAVertexInsideUnlessItIsKept) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.1, 0.1, 0.01}};
  for (const bool kept : {false, true}) {
    SmallPolyhedron polyhedron;
    polyhedron.clear();
    for (const Vec3& p : points) polyhedron.add_vertex(p);
    for (const SmallPolyhedron::Tet& t :
         {SmallPolyhedron::Tet{4, 1, 2, 3}, {0, 4, 2, 3}, {0, 1, 4, 3}, {0, 1, 2, 4}})
      polyhedron.add_tet(t);
    EXPECT_EQ(polyhedron.boundary(), 15u);
    ASSERT_TRUE(polyhedron.search(float(kFlat), kept ? 16 : 0));
    EXPECT_EQ(polyhedron.filling().size(), kept ? 4u : 1u);
  }
}

/// Asks about all tets worse than 0.6 and commits what is accepted; looks at each cavity first.
template <class Look>
int reconnect_all(Stage& stage, bool removes_vertex, Look&& look) {
  int accepted = 0;
  for (std::size_t t = 0; t < stage.mesh.tets.size(); ++t) {
    if (!stage.mesh.tet_alive(TetId(t)) || stage.mesh.qualities[t] > 0.6) continue;
    if (reconnect(stage.context, TetId(t), removes_vertex, stage.cavity) != Verdict::kAccept)
      continue;
    look(stage.cavity);
    stage.editor.commit(stage.cavity);
    ++accepted;
  }
  return accepted;
}

MeshData crumpled(int n, std::uint64_t seed) {
  MeshData data = kuhn_cube(n);
  perturb_inside(data, 0.12 / n, seed);
  return data;
}

TEST(Reconnect, RaisesTheWorstAndKeepsTheVolume) {
  for (const std::uint64_t seed : {3u, 7u, 19u}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Stage stage(crumpled(6, seed));
    const int accepted = reconnect_all(stage, true, [&](const Cavity& cavity) {
      double before = 1, after = 1, old_volume = 0, new_volume = 0;
      for (const TetId t : cavity.removed_tets) {
        before = std::min(before, double(stage.mesh.qualities[t]));
        old_volume += volume(stage.mesh.corners(t));
      }
      for (const NewTet& t : cavity.tets) {
        after = std::min(after, double(t.quality));
        const auto& p = stage.mesh.points;
        new_volume += volume({p[t.v[0]], p[t.v[1]], p[t.v[2]], p[t.v[3]]});
      }
      EXPECT_GT(after, 1.01 * before);
      EXPECT_NEAR(new_volume, old_volume, 1e-13);
      EXPECT_LE(cavity.removed_tets.size(), 32u);
    });
    EXPECT_GT(accepted, 5);
    expect_sound(stage.mesh);
  }
}

/// Halves a third of the edges, in a random order: many vertices are more than a good mesh needs.
void split_some(Stage& stage, std::uint64_t seed) {
  std::vector<Edge> edges = edges_of(stage.mesh);
  shuffle(edges, seed);
  edges.resize(edges.size() / 3);
  for (const Edge& e : edges)
    if (stage.find_edge(e[0], e[1]) && stage.split() == Verdict::kAccept)
      stage.editor.commit(stage.cavity);
}

TEST(Reconnect, RemovesVerticesOnlyWhereItMay) {
  for (const bool may : {false, true}) {
    Stage stage(crumpled(4, 29));
    split_some(stage, 31);
    int removed = 0;
    reconnect_all(stage, may, [&](const Cavity& c) { removed += !c.removed_vertices.empty(); });
    EXPECT_EQ(removed > 0, may);
    expect_sound(stage.mesh);
  }
}

TEST(Reconnect, LeavesTrianglesInsideTheVolumeAsTheyAre) {
  for (const std::uint64_t seed : {2u, 5u, 13u}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    MeshData data = crumpled(5, seed);
    Random random(seed);
    add_sheet(data, [&](const Vec3&, const Vec3&, const Vec3&) { return random.unit() < 0.05; });
    BuildOptions keep;
    keep.keep_internal = true;
    Stage stage(data, kLargeSize, keep);
    const std::size_t triangles = stage.mesh.triangles.size();
    EXPECT_GT(reconnect_all(stage, true, [](const Cavity&) {}), 0);
    expect_sound(stage.mesh);
    EXPECT_EQ(stage.mesh.triangles.size(), triangles);
  }
}

TEST(Reconnect, LeavesRequiredTetsAlone) {
  Stage stage(crumpled(3, 3));
  for (auto& flags : stage.mesh.tet_flags) flags |= tet_flag::kRequired;
  for (std::size_t t = 0; t < stage.mesh.tets.size(); ++t)
    EXPECT_EQ(reconnect(stage.context, TetId(t), true, stage.cavity), Verdict::kBreaksFeature);
}

}  // namespace
}  // namespace cavea::test
