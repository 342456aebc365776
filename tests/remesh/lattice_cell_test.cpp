// Which lattices are taken for the wanted sizes.
#include "cavea/remesh/lattice_cell.h"

#include <cmath>

#include "cavea/part/seed.h"
#include "remesh/support.h"

namespace cavea::test {
namespace {

constexpr double kLargest = 0.1;

SizeLaw law_of(double smallest, const SizeField& field) {
  return {smallest, kLargest, std::numeric_limits<double>::infinity(), 1, field};
}

double cell_for(double smallest, const SizeField& field) {
  TetMesh mesh = built(kuhn_cube(8));
  for (std::size_t v = 0; v < mesh.points.size(); ++v) mesh.sizes[v] = float(field(mesh.points[v]));
  return fitting_cell(mesh, law_of(smallest, field));
}

/// Of the lattices with this cell, by powers of two, that whose zone a size is in: where in it,
/// from 0 to 1.
double place_in_zone(double cell, double size) {
  const double octaves = std::log2(kFinestCell * size / cell);
  return octaves - std::floor(octaves);
}

TEST(LatticeCell, IsThatOfAUniformSize) {
  for (const double size : {kLargest, 0.08, 0.06, 0.03}) {
    SCOPED_TRACE(size);
    const double cell = cell_for(size, [&](const Vec3&) { return size; });
    // Zones go from 0.72 to 1.44 of the sizes for which they are made.
    EXPECT_NEAR(place_in_zone(cell, size), std::log2(kFinestCell / kLatticeCell) + 1, 0.05);
  }
}

TEST(LatticeCell, BeginsItsZoneWhereSizesBeginToRise) {
  for (const double smallest : {0.01, 0.012, 0.014, 0.017}) {
    SCOPED_TRACE(smallest);
    const double cell = cell_for(smallest, [&](const Vec3& p) {
      return std::min(kLargest, smallest + 0.2 * std::abs(p.x - 0.5));
    });
    const double place = place_in_zone(cell, smallest);
    EXPECT_LT(std::min(place, 1 - place), 0.3);
  }
}

TEST(LatticeCell, DoesNotHangOnABoundThatNoSizeReaches) {
  std::vector<double> tets;
  for (const double largest : {0.13, 0.155, 0.185, 0.22}) {
    SCOPED_TRACE(largest);
    TetMesh mesh = built(kuhn_cube(8));
    Options options;
    options.hmin = 0.025, options.hmax = largest, options.hgrad.reset();
    remesh(
        mesh, [](const Vec3& p) { return 0.025 + 0.2 * std::abs(p.x - 0.5); }, options);
    expect_sound(mesh);
    EXPECT_GE(mean_quality(mesh), 0.8);
    tets.push_back(double(mesh.tets.size()));
  }
  const auto [least, most] = std::ranges::minmax(tets);
  EXPECT_LT(most, 1.1 * least);
}

}  // namespace
}  // namespace cavea::test
