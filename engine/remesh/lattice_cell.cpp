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

/// Levels of `hmax` and below whose sizes are told apart, and how finely.
constexpr int kOctaves = 40, kBinsPerOctave = 32;

/// The volume of what wants sizes of hmax / 2^((i + 1/2) / kBinsPerOctave).
std::vector<double> volume_by_size(const TetMesh& mesh, const SizeLaw& law) {
  std::vector<double> volumes(kOctaves * kBinsPerOctave, 0);
  for_each_size_about(mesh, law, [&](double volume, double size) {
    const double bin = std::floor(kBinsPerOctave * std::log2(law.hmax / size));
    volumes[std::size_t(std::clamp(bin, 0.0, double(volumes.size() - 1)))] += volume;
  });
  return volumes;
}

/// How far lattices are from fitting, the one of level 0 with cells of `cell` times hmax, in
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
  const std::vector<double> volumes = volume_by_size(mesh, law);
  double best = kLatticeCell, least = misfit(volumes, best);
  for (int i = -kBinsPerOctave / 2; i < kBinsPerOctave / 2; ++i) {
    const double cell = kLatticeCell * std::exp2(double(i) / kBinsPerOctave);
    if (const double m = misfit(volumes, cell); m < least) best = cell, least = m;
  }
  return best * law.hmax;
}

}  // namespace cavea
