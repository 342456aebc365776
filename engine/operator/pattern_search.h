#pragma once
#include "cavea/geometry/vec3.h"

namespace cavea {

/// Climbs from `x` to a place where value(place) is larger: steps along the axes, halved where none
/// helps (Hooke and Jeeves 1961). `best` is value(x) before and after. The worst quality of a ball
/// is not smooth, so there is no gradient to follow.
template <class Value>
Vec3 pattern_search(Vec3 x, double step, double& best, Value&& value) {
  constexpr int kHalvings = 5, kClimbs = 4;
  const Vec3 axes[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int h = 0; h < kHalvings; ++h, step /= 2)
    for (int climb = 0; climb < kClimbs; ++climb) {
      bool higher = false;
      for (const Vec3& axis : axes) {
        const Vec3 y = x + step * axis;
        if (const double v = value(y, best); v > best) x = y, best = v, higher = true;
      }
      if (!higher) break;
    }
  return x;
}

}  // namespace cavea
