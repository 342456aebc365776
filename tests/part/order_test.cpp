#include "cavea/part/order.h"

#include <algorithm>
#include <cstdlib>

#include "part/support.h"

namespace cavea::test {
namespace {

/// A number for each tet that only its place decides.
std::int32_t mark_of(const TetMesh& mesh, std::size_t t) {
  const auto [a, b, c, d] = mesh.corners(TetId(t));
  const Vec3 s = a + b + c + d;
  return std::int32_t(1000 * s.x) + 7 * std::int32_t(1000 * s.y) + 31 * std::int32_t(1000 * s.z);
}

Labels marks_of(const TetMesh& mesh) {
  Labels marks(mesh.tets.size(), kNone);
  for (std::size_t t = 0; t < marks.size(); ++t)
    if (mesh.tet_alive(TetId(t))) marks[t] = mark_of(mesh, t);
  return marks;
}

/// How far apart the numbers of a tet's vertices are, and those of tets behind its faces, on the
/// average.
std::array<double, 2> spreads(const TetMesh& mesh) {
  double vertices = 0, neighbors = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto [low, high] = std::ranges::minmax(mesh.tets[t]);
    vertices += high - low;
    for (const FaceLink link : mesh.links[t])
      if (link.is_tet()) neighbors += std::abs(link.tet() - TetId(t)) / 4.0;
  }
  return {vertices / double(mesh.tets.size()), neighbors / double(mesh.tets.size())};
}

TEST(Order, ChangesNothingButNumbersAndClosesHoles) {
  constexpr std::uint64_t kSeed = 3;
  for (const NamedMesh& named : meshes_to_cut()) {
    SCOPED_TRACE(testing::Message() << named.name << ", seed " << kSeed);
    TetMesh mesh = with_holes(named.data, kSeed);
    const Canonical before(mesh);
    Labels marks = marks_of(mesh);
    sort_along_curve(mesh, &marks);
    expect_sound(mesh);
    EXPECT_FALSE(has_holes(mesh));
    EXPECT_TRUE(Canonical(mesh) == before);
    EXPECT_EQ(marks, marks_of(mesh));
  }
}

TEST(Order, PutsNearWhatIsNear) {
  constexpr std::uint64_t kSeed = 5;
  SCOPED_TRACE(testing::Message() << "seed " << kSeed);
  TetMesh mesh = build(shuffled(kuhn_cube(16), kSeed)).mesh;
  const auto [vertices, tets] = spreads(mesh);
  sort_along_curve(mesh);
  const auto [sorted_vertices, sorted_tets] = spreads(mesh);
  EXPECT_LT(sorted_vertices, vertices / 4);
  EXPECT_LT(sorted_tets, tets / 4);
}

}  // namespace
}  // namespace cavea::test
