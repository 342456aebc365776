#include "cavea/remesh/lattice_cell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "cavea/part/seed.h"
#include "cavea/remesh/size_pieces.h"

namespace cavea {
namespace {

/// Levels of the unit and below whose sizes are told apart, and how finely.
constexpr int kOctaves = 40, kBinsPerOctave = 32;

/// What volume wants which sizes.
struct Demand {
  /// The smallest size times a power of two, at least `hmax`: what is measured in it does not
  /// depend on a bound that no size reaches.
  double unit;
  std::vector<double> volumes;  ///< of sizes of unit / 2^((i + 1/2) / kBinsPerOctave)
};

Demand demand_of(const TetMesh& mesh, const SizeLaw& law) {
  struct Piece {
    double volume, size;
  };
  std::vector<Piece> pieces;
  double least = law.hmax;
  for_each_size_about(mesh, law, [&](double volume, double size) {
    pieces.push_back({volume, size});
    least = std::min(least, size);
  });
  Demand demand{least * std::exp2(std::ceil(std::log2(law.hmax / least))),
                std::vector<double>(kOctaves * kBinsPerOctave, 0)};
  for (const auto& [volume, size] : pieces) {
    const double bin = std::floor(kBinsPerOctave * std::log2(demand.unit / size));
    demand.volumes[std::size_t(std::clamp(bin, 0.0, double(demand.volumes.size() - 1)))] += volume;
  }
  return demand;
}

/// How far lattices are from fitting, the one of level 0 with cells of `cell` units, in
/// squares of octaves of lengths: what sizes are away from those of their lattice, on the average
/// over the points that they ask for; and the share of points that the lattices have too many or
/// too few, summed over their zones, a third of it for lengths.
double misfit(const std::vector<double>& volumes, double cell) {
  std::array<double, kOctaves + 1> surplus{};
  double wanted = 0, off = 0;
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    if (volumes[i] == 0) continue;
    const double size = std::exp2(-(double(i) + 0.5) / kBinsPerOctave);
    const int level =
        std::clamp(int(std::floor(std::log2(cell / (kFinestCell * size)))), 0, kOctaves);
    const double made_for = std::ldexp(cell / kLatticeCell, -level);
    const double points = volumes[i] / (size * size * size);
    const double away = std::log2(made_for / size);
    surplus[std::size_t(level)] += volumes[i] / (made_for * made_for * made_for) - points;
    wanted += points;
    off += points * away * away;
  }
  double missed = 0;
  for (const double s : surplus) missed += std::abs(s);
  missed /= 3 * std::numbers::ln2 * wanted;
  return missed * missed + off / wanted;
}

}  // namespace

double fitting_cell(const TetMesh& mesh, const SizeLaw& law) {
  const Demand demand = demand_of(mesh, law);
  const int of_hmax = int(std::lround(kBinsPerOctave * std::log2(law.hmax / demand.unit)));
  const auto cell_at = [](int step) {
    return kLatticeCell * std::exp2(double(step) / kBinsPerOctave);
  };
  double best = cell_at(of_hmax), least = misfit(demand.volumes, best);
  for (int i = -kBinsPerOctave / 2; i < kBinsPerOctave / 2; ++i) {
    const double cell = cell_at(of_hmax + i);
    if (const double m = misfit(demand.volumes, cell); m < least) best = cell, least = m;
  }
  return best * demand.unit;
}

}  // namespace cavea
