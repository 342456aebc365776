// The model that stands for the surface of a run's mesh.
#include "cavea/remesh/ideal_surface.h"

#include <array>
#include <cmath>
#include <numbers>

#include "remesh/support.h"

namespace cavea::test {
namespace {

constexpr int kSectors = 24;
constexpr double kUpper = 1, kLower = 1.5, kThickness = 0.25, kHalfSide = 3;

/// A square plate with a round hole that widens downwards. Along the rims curves bulge within the
/// planes of the plate, where they are on its facets; but the chords of the sharp upper rim are
/// nowhere near.
MeshData undercut_plate() {
  MeshData data;
  for (int i = 0; i < kSectors; ++i) {
    const double a = 2 * std::numbers::pi * i / kSectors, x = std::cos(a), y = std::sin(a);
    const double side = kHalfSide / std::max(std::abs(x), std::abs(y));
    for (const double radius : {kLower, side}) data.vertices.push_back({radius * x, radius * y, 0});
    for (const double radius : {kUpper, side})
      data.vertices.push_back({radius * x, radius * y, kThickness});
  }
  data.vertex_refs.assign(data.vertices.size(), 0);
  for (int i = 0; i < kSectors; ++i) {
    // Six tets of a hexahedron: the ways from one corner to the opposite one.
    const int a = 4 * i, b = 4 * ((i + 1) % kSectors);
    const std::array<std::int32_t, 8> corner{a, a + 1, b, b + 1, a + 2, a + 3, b + 2, b + 3};
    for (const auto& way : {std::array{1, 2}, {1, 4}, {2, 1}, {2, 4}, {4, 1}, {4, 2}})
      add_positive(data, {corner[0], corner[way[0]], corner[way[0] + way[1]], corner[7]});
  }
  data.tet_refs.assign(data.tets.size(), 1);
  return data;
}

TEST(IdealSurface, IsWithinTheToleranceOfFacetsThatAreTrusted) {
  const double sagitta = kUpper * (1 - std::cos(std::numbers::pi / kSectors));
  Options options;
  options.hausd = sagitta / 1.06;
  TetMesh mesh = built(undercut_plate());
  const ResolvedOptions resolved = resolve(options, {box_diagonal(mesh), thickness(mesh)});
  IdealSurface surface(options, resolved);
  surface.take(mesh);
  EXPECT_LT(surface.bulge(), 0.9 * *options.hausd);
  EXPECT_GT(surface.distance_of(mesh).worse().worst, 1);
  surface.trust_facets(mesh);
  EXPECT_LE(surface.distance_of(mesh).worse().worst, 1);
}

}  // namespace
}  // namespace cavea::test
