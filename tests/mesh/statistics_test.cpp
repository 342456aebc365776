#include "cavea/mesh/statistics.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>
#include <utility>

#include "cavea/base/parallel.h"
#include "cavea/geometry/dihedral.h"
#include "cavea/geometry/metric.h"
#include "cavea/mesh/build.h"
#include "support/meshes.h"

namespace cavea {
namespace {

template <std::size_t N>
std::int64_t total(const std::array<std::int64_t, N>& histogram) {
  return std::accumulate(histogram.begin(), histogram.end(), std::int64_t{0});
}

TEST(QualityStatistics, OfTheRegularTet) {
  const QualityStatistics q = quality_statistics(build(test::single_tet()).mesh);
  EXPECT_NEAR(q.worst, 1, 1e-14);
  EXPECT_NEAR(q.mean, 1, 1e-14);
  EXPECT_EQ(q.worst_tet, 0);
  EXPECT_NEAR(distance(q.worst_place, {0.5, 0.5, 0.5}), 0, 1e-15);
  EXPECT_EQ(q.histogram[9], 1);
  EXPECT_NEAR(q.smallest_dihedral, std::acos(1.0 / 3) * 180 / M_PI, 1e-12);
  EXPECT_NEAR(q.largest_dihedral, q.smallest_dihedral, 1e-12);
  EXPECT_EQ(q.dihedral_histogram[7], 6);
}

TEST(QualityStatistics, OfTheCube) {
  const TetMesh mesh = build(test::kuhn_cube(3)).mesh;
  const QualityStatistics q = quality_statistics(mesh);
  EXPECT_NEAR(q.worst, 0.657267, 1e-6);
  EXPECT_NEAR(q.mean, 0.657267, 1e-6);
  EXPECT_EQ(q.histogram[6], std::int64_t(mesh.tets.size()));
  EXPECT_NEAR(q.smallest_dihedral, 45, 1e-12);
  EXPECT_NEAR(q.largest_dihedral, 90, 1e-12);
  EXPECT_EQ(total(q.dihedral_histogram), std::int64_t(6 * mesh.tets.size()));
}

TEST(QualityStatistics, CountAnglesAsTheArcTangentDoes) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    test::Random random(seed);
    TetMesh mesh = build(test::kuhn_cube(4)).mesh;
    // From shaken to as good as flat in one direction.
    const double flat = std::pow(10, -random.between(0, 9));
    for (Vec3& p : mesh.points) {
      for (double* x : {&p.x, &p.y, &p.z}) *x += random.between(-0.05, 0.05);
      p.z *= flat;
    }
    QualityStatistics expected;
    expected.smallest_dihedral = 180;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      const auto p = mesh.corners(TetId(t));
      for (const auto& e : kEdgeVertices) {
        const double angle = dihedral(p[e[0]], p[e[1]], p[e[2]], p[e[3]]);
        expected.smallest_dihedral = std::min(expected.smallest_dihedral, angle);
        expected.largest_dihedral = std::max(expected.largest_dihedral, angle);
        ++expected.dihedral_histogram[std::min<std::size_t>(17, std::size_t(angle / 10))];
      }
    }
    const QualityStatistics q = quality_statistics(mesh);
    EXPECT_EQ(q.dihedral_histogram, expected.dihedral_histogram);
    EXPECT_DOUBLE_EQ(q.smallest_dihedral, expected.smallest_dihedral);
    EXPECT_DOUBLE_EQ(q.largest_dihedral, expected.largest_dihedral);
  }
}

TEST(QualityStatistics, FindTheWorstTetAndSkipHoles) {
  TetMesh mesh = build(test::two_tets()).mesh;
  mesh.points[4] = {0.4, 0.4, 0.4};
  QualityStatistics q = quality_statistics(mesh);
  EXPECT_EQ(q.worst_tet, 1);
  EXPECT_EQ(q.worst, mesh.compute_quality(1));
  EXPECT_GT(q.largest_dihedral, 150);
  mesh.tets[1][0] = kNone;
  q = quality_statistics(mesh);
  EXPECT_EQ(q.worst_tet, 0);
  EXPECT_EQ(total(q.histogram), 1);
  mesh.tets[0][0] = kNone;
  EXPECT_EQ(quality_statistics(mesh).worst_tet, kNone);
}

TEST(MeanQuality, IsThatOfTheLivingTets) {
  TetMesh mesh = build(test::kuhn_cube(3)).mesh;
  mesh.qualities[5] = 0.25f;
  double sum = 0;
  for (const float q : mesh.qualities) sum += q;
  const double tets = double(mesh.tets.size());
  EXPECT_NEAR(mean_quality(mesh), sum / tets, 1e-12);
  mesh.tets[5] = {kNone, kNone, kNone, kNone};
  EXPECT_NEAR(mean_quality(mesh), (sum - 0.25) / (tets - 1), 1e-12);
  EXPECT_EQ(mean_quality({}), 0);
}

TEST(QualityStatistics, NameEveryFlatTet) {
  const MeshData data = test::cube_with_flat_tets(5, true);
  const TetMesh mesh = build(data).mesh;
  const QualityStatistics q = quality_statistics(mesh);
  ASSERT_EQ(q.flat.size(), 16u);
  for (std::size_t i = 0; i < q.flat.size(); ++i) {
    EXPECT_EQ(q.flat[i].tet, data.required_tets[i]);
    const auto p = mesh.corners(q.flat[i].tet);
    EXPECT_NEAR(distance(q.flat[i].place, (p[0] + p[1] + p[2] + p[3]) / 4), 0, 1e-15);
  }
  EXPECT_TRUE(quality_statistics(build(test::kuhn_cube(5)).mesh).flat.empty());
}

TEST(LengthStatistics, CountEachEdgeOnce) {
  MeshData data = test::polycube(4, 0.6, 17);
  TetMesh mesh = build(test::shuffled(data, 17)).mesh;
  test::Random random(17);
  for (float& h : mesh.sizes) h = float(random.between(0.1, 1.2));
  std::set<std::pair<VertexId, VertexId>> edges;
  for (const auto& tet : mesh.tets)
    for (const auto& e : kEdgeVertices) edges.insert(std::minmax(tet[e[0]], tet[e[1]]));
  double sum = 0, longest = 0, shortest = 1e9;
  std::int64_t conforming = 0, very_short = 0;
  for (const auto& [a, b] : edges) {
    const double length = metric_length(distance(mesh.points[a], mesh.points[b]),
                                        double(mesh.sizes[a]), double(mesh.sizes[b]));
    sum += length;
    longest = std::max(longest, length);
    shortest = std::min(shortest, length);
    conforming += length >= kShortEdge && length <= kLongEdge;
    very_short += length < 0.3;
  }
  const LengthStatistics s = length_statistics(mesh);
  EXPECT_EQ(s.edges, std::int64_t(edges.size()));
  EXPECT_EQ(total(s.histogram), s.edges);
  EXPECT_NEAR(s.mean, sum / double(edges.size()), 1e-12);
  EXPECT_EQ(s.longest, longest);
  EXPECT_EQ(s.shortest, shortest);
  EXPECT_EQ(s.conforming, conforming);
  EXPECT_EQ(s.histogram[0], very_short);
}

TEST(LengthStatistics, SkipHolesAndNameThePlace) {
  TetMesh mesh = build(test::two_tets()).mesh;
  mesh.sizes.assign(5, 1.0f);
  mesh.tets[1][0] = kNone;
  const LengthStatistics s = length_statistics(mesh);
  EXPECT_EQ(s.edges, 6);
  EXPECT_EQ(s.conforming, 6);
  EXPECT_EQ(s.conforming_percent(), 100);
  EXPECT_EQ(s.longest, std::sqrt(2.0));
  EXPECT_EQ(s.longest_place, (Vec3{0.5, 0.5, 0}));
}

TEST(Counts, OfACubeOfTwoReferences) {
  MeshData data = test::kuhn_cube(4);
  test::set_refs(data, [](const Vec3& p) { return p.z > 0.25 ? 1 : 2; });
  data.edges = {{0, 1}};
  data.edge_refs = {1};
  data.ridges = {0};
  data.corners = {0, 1};
  data.required_vertices = {4};
  const Counts c = count(build(data).mesh);
  EXPECT_EQ(c.vertices, 125);
  EXPECT_EQ(c.tets, 384);
  EXPECT_EQ(c.triangles, 192 + 32);
  EXPECT_EQ(c.ridges, 1);
  EXPECT_EQ(c.corners, 2);
  EXPECT_EQ(c.required_vertices, 1);
  EXPECT_EQ(c.components, 1);
  EXPECT_EQ(c.boundary_components, 1);
  EXPECT_EQ(c.tets_of_ref, (std::map<std::int32_t, std::int64_t>{{1, 288}, {2, 96}}));
  EXPECT_NEAR(c.volume_of_ref.at(1), 0.75, 1e-14);
  EXPECT_NEAR(c.volume_of_ref.at(2), 0.25, 1e-14);
  EXPECT_NEAR(c.volume, 1, 1e-14);
  EXPECT_NEAR(c.box_diagonal(), std::sqrt(3.0), 1e-15);
}

TEST(Counts, ComponentsOfVolumeAndBoundary) {
  // A shell around a hole, and one cell in the middle of the hole.
  const MeshData data = test::kuhn_grid(5, [](int i, int j, int k) {
    const auto end = [](int x) { return x == 0 || x == 4; };
    return end(i) || end(j) || end(k) || (i == 2 && j == 2 && k == 2);
  });
  const Counts c = count(build(data).mesh);
  EXPECT_EQ(c.components, 2);
  EXPECT_EQ(c.boundary_components, 3);
  EXPECT_NEAR(c.volume, (125 - 27 + 1) / 125.0, 1e-14);
}

TEST(Counts, ThicknessIsOfTheExteriorBoundaryAlone) {
  MeshData data = test::kuhn_cube(4);
  test::set_refs(data, [](const Vec3& p) { return p.x > 0.5 ? 1 : 2; });
  EXPECT_NEAR(thickness(build(data).mesh), 1, 1e-14);
  constexpr double kThin = 1e-3, kFar = 1e4;  // a sheet far from the origin
  for (Vec3& p : data.vertices) p = {p.x + kFar, p.y - kFar, kThin * p.z};
  EXPECT_NEAR(thickness(build(data).mesh), 6 * kThin / (2 + 4 * kThin), 1e-9 * kThin);
  EXPECT_NEAR(thickness(build(test::ball(24)).mesh), 2, 0.02);
}

TEST(Statistics, HaveTheSameBitsAtAnyNumberOfThreads) {
  MeshData data = test::shuffled(test::ball(14), 5);
  test::set_refs(data, [](const Vec3& p) { return p.x > 0.1 ? 1 : p.y > 0 ? 2 : 3; });
  TetMesh mesh = build(data).mesh;
  ASSERT_GT(mesh.tets.size(), kReduceBlock) << "more than one block, or it proves nothing";
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    mesh.sizes[v] = float(0.1 + 0.02 * norm(mesh.points[v]));
  const auto measure = [&](int threads) {
    std::vector<double> out;
    run_in_arena(threads, [&] {
      const QualityStatistics q = quality_statistics(mesh);
      const LengthStatistics l = length_statistics(mesh);
      const Counts c = count(mesh);
      out = {q.mean,           q.worst,  q.smallest_dihedral,   l.mean,
             l.shortest,       c.volume, c.volume_of_ref.at(2), double(q.worst_tet),
             l.longest_place.x};
    });
    return out;
  };
  const std::vector<double> alone = measure(1);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(measure(threads), alone);
}

}  // namespace
}  // namespace cavea
