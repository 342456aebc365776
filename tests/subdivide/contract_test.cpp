#include "cavea/subdivide/contract.h"

#include <map>

#include "cavea/base/parallel.h"
#include "subdivide/support.h"

namespace cavea::test {
namespace {

constexpr ContractionLimits kLimits{
    .short_edge = 0.6, .long_edge = 1.4, .least_quality = 0.01, .worthwhile = 0.1};

/// A cube of two references, its edges between 1 / n and 2 / n, where `wanted` is wanted.
TetMesh fine_cube(int n, double wanted, std::uint64_t seed) {
  MeshData data = kuhn_cube(n);
  perturb_inside(data, 0.15 / n, seed);
  set_refs(data, [](const Vec3& c) { return c.x + c.y < 0.9 ? 3 : 7; });
  TetMesh mesh = build(shuffled(data, seed)).mesh;
  std::ranges::fill(mesh.sizes, float(wanted));
  return mesh;
}

std::map<int, double> volumes(const TetMesh& mesh) {
  std::map<int, double> of_ref;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto [a, b, c, d] = mesh.corners(TetId(t));
    of_ref[mesh.tet_refs[t]] += volume6(a, b, c, d) / 6;
  }
  return of_ref;
}

using Corners = std::array<Vec3, 3>;
std::vector<Corners> surface(const TetMesh& mesh) {
  std::vector<Corners> all;
  for (const Triangle& s : mesh.triangles)
    all.push_back({mesh.points[s.v[0]], mesh.points[s.v[1]], mesh.points[s.v[2]]});
  return all;
}

TEST(Contract, LeavesTheSurfaceAndTheVolumesOfReferences) {
  const std::uint64_t first = std::random_device{}() % 1000000;
  for (std::uint64_t seed = first; seed < first + 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const int n = 12 + int(seed % 5);
    const TetMesh mesh = fine_cube(n, 4.0 / n, seed);
    const auto coarse = contracted(mesh, kLimits);
    ASSERT_TRUE(coarse);
    expect_sound(*coarse);
    EXPECT_LT(coarse->points.size(), 0.75 * double(mesh.points.size()));
    EXPECT_EQ(surface(*coarse), surface(mesh));
    const auto before = volumes(mesh), after = volumes(*coarse);
    for (const int ref : {3, 7}) EXPECT_NEAR(after.at(ref), before.at(ref), 1e-12);
  }
}

TEST(Contract, MakesNoTetTooPoorOrTooLong) {
  const std::uint64_t seed = std::random_device{}() % 1000000;
  SCOPED_TRACE("seed " + std::to_string(seed));
  const TetMesh mesh = fine_cube(12, 0.3, seed);
  const TetMesh coarse = *contracted(mesh, kLimits);
  for (std::size_t t = 0; t < coarse.tets.size(); ++t) {
    EXPECT_GE(coarse.qualities[t], kLimits.least_quality * (1 - 1e-6));
    const auto x = coarse.corners(TetId(t));
    for (const auto& e : kEdgeVertices)
      EXPECT_LE(distance(x[std::size_t(e[0])], x[std::size_t(e[1])]),
                kLimits.long_edge * 0.3 * (1 + 1e-6));
  }
}

TEST(Contract, LeavesWhatIsRequired) {
  TetMesh mesh = fine_cube(10, 0.5, 3);
  std::vector<Vec3> required;
  for (std::size_t v = 0; v < mesh.points.size(); v += 7) {
    mesh.vertex_tags[v] |= v % 2 ? tag::kRequired : tag::kOnRequiredEdge;
    required.push_back(mesh.points[v]);
  }
  const TetMesh coarse = *contracted(mesh, kLimits);
  expect_sound(coarse);
  std::vector<Vec3> left;
  for (std::size_t v = 0; v < coarse.points.size(); ++v)
    if (coarse.vertex_tags[v] & (tag::kRequired | tag::kOnRequiredEdge))
      left.push_back(coarse.points[v]);
  EXPECT_EQ(left, required);
}

TEST(Contract, DoesNothingWhereFewWouldGo) {
  const TetMesh mesh = fine_cube(8, 1.0 / 8, 5);
  EXPECT_FALSE(contracted(mesh, kLimits));
}

TEST(Contract, DoesNothingWhereNoneCanGo) {
  const TetMesh mesh = fine_cube(12, 0.3, 5);
  ContractionLimits limits = kLimits;
  limits.long_edge = 0.1;  // every tet that would change has a longer one
  EXPECT_FALSE(contracted(mesh, limits));
}

TEST(Contract, AsksOnlyTetsThatChange) {
  TetMesh mesh = fine_cube(12, 0.1, 11);
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (mesh.points[v].x > 0.3) mesh.sizes[v] = 0.6F;
  for (std::uint8_t& flags : mesh.tet_flags) flags = 0;
  const TetMesh coarse = *contracted(mesh, kLimits);
  bool asked = false, quiet = false;
  for (std::size_t t = 0; t < coarse.tets.size(); ++t) {
    const bool asks = coarse.tet_flags[t] & tet_flag::kAskAll;
    double right = 0;
    for (const Vec3& p : coarse.corners(TetId(t))) right = std::max(right, p.x);
    EXPECT_FALSE(asks && right < 0.2);
    (asks ? asked : quiet) = true;
  }
  EXPECT_TRUE(asked && quiet);
}

TEST(Contract, IsTheSameAtAnyNumberOfThreads) {
  const TetMesh mesh = fine_cube(20, 0.15, 7);
  TetMesh reference;
  run_in_arena(1, [&] { reference = *contracted(mesh, kLimits); });
  for (const int threads : {2, 3, 8}) {
    SCOPED_TRACE(std::to_string(threads) + " threads");
    TetMesh coarse;
    run_in_arena(threads, [&] { coarse = *contracted(mesh, kLimits); });
    expect_same(coarse, reference);
  }
}

}  // namespace
}  // namespace cavea::test
