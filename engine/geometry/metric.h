#pragma once
#include <algorithm>
#include <cmath>

#include "cavea/geometry/vec3.h"

namespace cavea {

/// Length of an edge of Euclidean length `length` in the isotropic size field that goes linearly
/// from h0 to h1 along it: the integral of dl / h (paper, section 4.2).
inline double metric_length(double length, double h0, double h1) {
  const double d = h1 - h0;
  // Below this relative difference the closed form loses more digits than the series' next term.
  constexpr double kSameSize = 1e-3;
  if (std::abs(d) < kSameSize * h0) {
    const double r = d / h0;
    return length / h0 * (1 - r * (0.5 - r / 3));
  }
  return length * std::log(h1 / h0) / d;
}

/// Whether metric_length() exceeds `limit`, given the squared Euclidean length: mostly without the
/// root and the logarithm, since the size along the edge lies between those of its ends.
inline bool length_exceeds(double length2, double h0, double h1, double limit) {
  const auto [low, high] = std::minmax(h0, h1);
  if (length2 <= limit * limit * low * low) return false;
  if (length2 > limit * limit * high * high) return true;
  return metric_length(std::sqrt(length2), h0, h1) > limit;
}

/// The longest and shortest edge a mesh should have in its metric: an edge above is split, one
/// below collapsed (paper, section 4.3: a unit mesh; the bounds that peers report against).
inline constexpr double kLongEdge = 1.4142135623730951;
inline constexpr double kShortEdge = 0.7071067811865476;

}  // namespace cavea
