#include "cavea/implicit/level_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "cavea/base/parallel.h"

namespace cavea {
namespace {

// Of the diagonal. The error of central differences is of second order in it, that of rounding is
// 1e-16 over it: about 1e-10 each.
constexpr double kDifferenceStep = 1e-5;

// Of an edge: beyond any tolerance, and well above the rounding of the function's values.
constexpr double kZeroShare = 1e-12;

// Every third is a bisection: enough for kZeroShare in any case.
constexpr int kZeroSteps = 120;

// They double the digits each: the first comes from a cell's middle.
constexpr int kNewtonSteps = 4;

/// A bracket of a zero, with the values at its ends.
struct Bracket {
  double low = 0, high = 1, at_low, at_high;
  int last = 0;  ///< the end that the last step replaced: -1 the low one, 1 the high one

  double middle() const { return (low + high) / 2; }
  double false_position() const {
    const double at = low + (high - low) * (at_low / (at_low - at_high));
    // A little inwards of an end that is as good as the zero, so that the bracket closes.
    constexpr double kInwards = 0.5 * kZeroShare;
    return std::clamp(at, low + kInwards, high - kInwards);
  }

  /// Illinois method: an end that stays for two steps pulls less.
  void narrow(double at, double value) {
    if ((value < 0) == (at_low < 0)) {
      low = at, at_low = value;
      if (std::exchange(last, -1) == -1) at_high /= 2;
    } else {
      high = at, at_high = value;
      if (std::exchange(last, 1) == 1) at_low /= 2;
    }
  }
};

// The square of a sine: level sets that meet at less than half a degree have no line in common to
// speak of, and the first one counts alone.
constexpr double kParallel = 1e-4;

/// The shortest step that is allowed to where all are zero, to first order: Gram-Schmidt makes of
/// each gradient the part that leaves the others' values alone.
Vec3 newton_step(std::span<const LevelSet* const> level_sets, const Vec3& at,
                 const std::function<Vec3(const Vec3&)>& allowed) {
  Vec3 step;
  std::array<Vec3, 3> done;
  int n = 0;
  for (const LevelSet* level_set : level_sets) {
    const Vec3 g = allowed(level_set->gradient(at));
    Vec3 way = g;
    for (int k = 0; k < n; ++k) way -= done[k] * (dot(done[k], g) / norm2(done[k]));
    if (n == 3 || norm2(way) <= kParallel * norm2(g)) continue;
    step -= way * ((level_set->value(at) + dot(g, step)) / norm2(way));
    done[n++] = way;
  }
  return step;
}

using Corners = std::array<double, 8>;

bool has_both_signs(const Corners& values) {
  const auto below = std::ranges::count_if(values, [](double x) { return x < 0; });
  return below != 0 && below != 8;
}

/// The cells of a lattice over a box.
struct Lattice {
  Vec3 low, cell;
  std::array<std::size_t, 3> count;

  Lattice(const Box& box, double step) : low(box.low) {
    const Vec3 side = box.high - box.low;
    for (int k = 0; k < 3; ++k) count[k] = std::size_t(std::max(1.0, std::ceil(side[k] / step)));
    cell = {side.x / double(count[0]), side.y / double(count[1]), side.z / double(count[2])};
  }
  Vec3 at(double i, double j, double k) const {
    return low + Vec3{i * cell.x, j * cell.y, k * cell.z};
  }
};

/// The values at the corners of a layer of cells.
std::vector<double> values_of_layer(const LevelSet& level_set, const Lattice& lattice,
                                    std::size_t k) {
  std::vector<double> values;
  values.reserve((lattice.count[0] + 1) * (lattice.count[1] + 1));
  for (std::size_t j = 0; j <= lattice.count[1]; ++j)
    for (std::size_t i = 0; i <= lattice.count[0]; ++i)
      values.push_back(level_set.value(lattice.at(double(i), double(j), double(k))));
  return values;
}

OrientedPoint zero_near(const LevelSet& level_set, const Vec3& from, double reach) {
  const Vec3 at = from + way_to_zero(std::array{&level_set}, from, reach,
                                     [](const Vec3& direction) { return direction; });
  const Vec3 normal = normalized(level_set.gradient(at));
  return {at, is_finite(normal) ? normal : Vec3{}};
}

std::vector<OrientedPoint> zeros_of_layer(const LevelSet& level_set, const Lattice& lattice,
                                          std::size_t k) {
  const std::vector<double> below = values_of_layer(level_set, lattice, k),
                            above = values_of_layer(level_set, lattice, k + 1);
  const std::size_t row = lattice.count[0] + 1;
  std::vector<OrientedPoint> zeros;
  for (std::size_t j = 0; j < lattice.count[1]; ++j)
    for (std::size_t i = 0; i < lattice.count[0]; ++i) {
      const std::size_t c = j * row + i;
      if (has_both_signs({below[c], below[c + 1], below[c + row], below[c + row + 1], above[c],
                          above[c + 1], above[c + row], above[c + row + 1]}))
        zeros.push_back(zero_near(level_set,
                                  lattice.at(double(i) + 0.5, double(j) + 0.5, double(k) + 0.5),
                                  norm(lattice.cell)));
    }
  return zeros;
}

}  // namespace

LevelSet with_gradient(const LevelSet& level_set, double diagonal) {
  if (level_set.gradient) return level_set;
  return {level_set.value, [f = level_set.value, h = kDifferenceStep * diagonal](const Vec3& p) {
            const auto slope = [&](const Vec3& e) { return (f(p + e) - f(p - e)) / (2 * h); };
            return Vec3{slope({h, 0, 0}), slope({0, h, 0}), slope({0, 0, h})};
          }};
}

LevelSet less(const LevelSet& level_set, double isovalue) {
  if (isovalue == 0) return level_set;
  return {[f = level_set.value, isovalue](const Vec3& p) { return f(p) - isovalue; },
          level_set.gradient};
}

double zero_on_edge(const LevelSet& level_set, const Vec3& a, const Vec3& b, double at_a,
                    double at_b) {
  if ((at_a < 0) == (at_b < 0)) return at_a == 0 ? 0 : 1;
  Bracket bracket{.at_low = at_a, .at_high = at_b};
  for (int k = 0; k < kZeroSteps && bracket.high - bracket.low > kZeroShare; ++k) {
    // The method is slow where the function is flat on one side: then bisection makes the way.
    const double at = k % 3 == 2 ? bracket.middle() : bracket.false_position();
    const double value = level_set.value(a + (b - a) * at);
    if (value == 0) return at;
    bracket.narrow(at, value);
  }
  return bracket.middle();
}

Vec3 way_to_zero(std::span<const LevelSet* const> level_sets, const Vec3& from, double reach,
                 const std::function<Vec3(const Vec3&)>& allowed) {
  Vec3 at = from;
  for (int k = 0; k < kNewtonSteps; ++k) {
    const Vec3 next = at + newton_step(level_sets, at, allowed);
    if (!is_finite(next) || distance(next, from) > reach) break;
    at = next;
  }
  return at - from;
}

std::vector<OrientedPoint> zeros_on_lattice(const LevelSet& level_set, const Box& box,
                                            double step) {
  const Lattice lattice(box, step);
  std::vector<std::vector<OrientedPoint>> layers(lattice.count[2]);
  parallel_tasks(layers.size(),
                 [&](std::size_t k) { layers[k] = zeros_of_layer(level_set, lattice, k); });
  std::vector<OrientedPoint> zeros;
  for (const auto& layer : layers) zeros.insert(zeros.end(), layer.begin(), layer.end());
  return zeros;
}

}  // namespace cavea
