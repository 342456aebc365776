#include "cavea/base/parallel.h"
#include "subdivide/support.h"

namespace cavea::test {
namespace {

bool all_certainly_positive(const TetMesh& mesh) {
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto [a, b, c, d] = mesh.corners(TetId(t));
    if (!certainly_positive(a, b, c, d)) return false;
  }
  return true;
}

int count_off_surface(const TetMesh& mesh) {
  int count = 0;
  for (const Tag tags : mesh.vertex_tags) count += (tags & tag::kOffSurface) != 0;
  return count;
}

Placement on_sphere(const TetMesh& mesh) {
  return [&mesh](const MeshEdge& e) {
    NewVertex made = straight_midpoint(mesh, e);
    if (e.triangle != kNone) made.point = normalized(made.point);
    return made;
  };
}

TEST(Settle, LetsSurfaceVerticesGoToTheirPlaces) {
  const TetMesh mesh = build(ball(4)).mesh;
  const TetMesh once = subdivide(mesh, every_edge, on_sphere(mesh));
  expect_sound(once);
  EXPECT_EQ(count_off_surface(once), 0);
  for (std::size_t v = 0; v < once.points.size(); ++v)
    if (once.vertex_tags[v] & tag::kSurface) {
      EXPECT_NEAR(norm(once.points[v]), 1, 1e-12);
    }
  const double ideal = 4 * M_PI / 3;
  EXPECT_LT(ideal - volume(once), 0.35 * (ideal - volume(mesh)));
}

TEST(Settle, DrawsBackWhatInvertsTets) {
  const std::uint64_t first = std::random_device{}() % 1000000;
  for (std::uint64_t seed = first; seed < first + 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    MeshData data = kuhn_cube(4);
    perturb_inside(data, 0.02, seed);
    const TetMesh mesh = build(shuffled(data, seed)).mesh;
    // Up to a whole edge of 0.25 away: most of these places are out of reach.
    auto wanted = [&](const MeshEdge& e) {
      Random random(seed * 7919 + std::uint64_t(e.a) * 1009 + std::uint64_t(e.b));
      const Vec3 away{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
      return (e.a + e.b) % 3 ? away * 0.25 : Vec3{};
    };
    std::vector<MeshEdge> edges;
    auto split = coin(seed, 0.7);
    run_in_arena(1, [&] {
      subdivide(mesh, split, [&](const MeshEdge& e) {
        edges.push_back(e);
        return straight_midpoint(mesh, e);
      });
    });
    const TetMesh cut = subdivide(mesh, split, [&](const MeshEdge& e) {
      NewVertex made = straight_midpoint(mesh, e);
      made.point += wanted(e);
      return made;
    });
    expect_sound(cut);
    EXPECT_TRUE(all_certainly_positive(cut));
    EXPECT_GT(count_off_surface(cut), 0);
    EXPECT_LT(count_off_surface(cut), int(edges.size()));
    std::ranges::sort(edges, {}, [](const MeshEdge& e) { return std::pair(e.a, e.b); });
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const std::size_t v = mesh.points.size() + k;
      const Vec3 middle = straight_midpoint(mesh, edges[k]).point;
      const Vec3 way = wanted(edges[k]), gone = cut.points[v] - middle;
      if (cut.vertex_tags[v] & tag::kOffSurface) {
        const double share = norm(gone) / norm(way);
        EXPECT_TRUE(share == 0 || std::abs(std::log2(share) - std::round(std::log2(share))) < 1e-9);
        EXPECT_TRUE(share == 0 || (share > 0.015 && share < 0.501)) << share;
        EXPECT_LT(norm(gone - share * way), 1e-14);
      } else {
        EXPECT_EQ(cut.points[v], middle + way);
      }
    }
  }
}

TEST(Settle, LeavesTetsAShareOfTheirVolume) {
  const TetMesh mesh = build(single_tet()).mesh;
  const VertexId a = 0, b = 1;
  const Vec3 middle = (mesh.points[a] + mesh.points[b]) * 0.5;
  const Vec3 opposite = (mesh.points[2] + mesh.points[3]) * 0.5;
  auto split = [](const MeshEdge& e) { return e.a == 0 && e.b == 1; };
  // Nearly on the opposite edge, where both halves are flat; positive but for the last percent.
  auto place = [&](const MeshEdge& e) {
    NewVertex made = straight_midpoint(mesh, e);
    made.point = middle + 0.99 * (opposite - middle);
    return made;
  };
  const TetMesh settled = subdivide(mesh, split, place);
  EXPECT_EQ(count_off_surface(settled), 1);
  EXPECT_EQ(settled.points[4], (middle + place({0, 1}).point) * 0.5);
  const TetMesh as_told = subdivide(mesh, split, place, 0);
  EXPECT_EQ(count_off_surface(as_told), 0);
  EXPECT_EQ(as_told.points[4], place({0, 1}).point);
}

TEST(Settle, DoesNotAskTooMuchOfFlatTets) {
  // The upper tet's top is sunk into the common face, so that it is flat.
  MeshData data = two_tets();
  data.vertices[4] = {0.5, 0.25, 0.25};
  const TetMesh mesh = build(data).mesh;
  const TetMesh cut = subdivide(mesh, every_edge, [&](const MeshEdge& e) {
    NewVertex made = straight_midpoint(mesh, e);
    made.point += Vec3{-0.3, -0.3, -0.3};
    return made;
  });
  expect_sound(cut, {.allow_flat_tets = true});
  ASSERT_EQ(cut.tets.size(), 16u);
  const bool first_is_flat = mesh.compute_quality(0) < 1e-9;
  for (TetId t = first_is_flat ? 8 : 0, last = t + 8; t < last; ++t) {
    const auto [a, b, c, d] = cut.corners(t);
    EXPECT_TRUE(certainly_positive(a, b, c, d)) << t;
  }
}

}  // namespace
}  // namespace cavea::test
