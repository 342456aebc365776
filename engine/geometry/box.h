#pragma once
#include <algorithm>
#include <limits>
#include <span>

#include "cavea/geometry/vec3.h"

namespace cavea {

/// An axis-aligned box; empty (low > high) at first. A coordinate that is not a number is left out.
struct Box {
  Vec3 low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};

  bool empty() const { return !(low.x <= high.x); }
  void add(const Vec3& p) { add(Box{p, p}); }
  void add(const Box& b) {
    low = {std::min(low.x, b.low.x), std::min(low.y, b.low.y), std::min(low.z, b.low.z)};
    high = {std::max(high.x, b.high.x), std::max(high.y, b.high.y), std::max(high.z, b.high.z)};
  }
  bool contains(const Vec3& p) const {
    return low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y && low.z <= p.z &&
           p.z <= high.z;
  }
  /// Squared distance of a point from the box; 0 inside.
  double distance2(const Vec3& p) const {
    const auto outside = [](double x, double l, double h) {
      return x < l ? l - x : x > h ? x - h : 0;
    };
    const double x = outside(p.x, low.x, high.x), y = outside(p.y, low.y, high.y),
                 z = outside(p.z, low.z, high.z);
    return x * x + y * y + z * z;
  }
  /// Squared distance of two boxes; 0 where they overlap.
  double distance2(const Box& b) const {
    const auto apart = [](double l, double h, double bl, double bh) {
      return bh < l ? l - bh : bl > h ? bl - h : 0;
    };
    const double x = apart(low.x, high.x, b.low.x, b.high.x),
                 y = apart(low.y, high.y, b.low.y, b.high.y),
                 z = apart(low.z, high.z, b.low.z, b.high.z);
    return x * x + y * y + z * z;
  }
  /// What two boxes have in common.
  Box common(const Box& b) const {
    return {{std::max(low.x, b.low.x), std::max(low.y, b.low.y), std::max(low.z, b.low.z)},
            {std::min(high.x, b.high.x), std::min(high.y, b.high.y), std::min(high.z, b.high.z)}};
  }
  /// The box with room around it.
  Box widened(double by) const { return {low - Vec3{by, by, by}, high + Vec3{by, by, by}}; }
  bool overlaps(const Box& b) const {
    return low.x <= b.high.x && b.low.x <= high.x && low.y <= b.high.y && b.low.y <= high.y &&
           low.z <= b.high.z && b.low.z <= high.z;
  }

 private:
  static constexpr double kFar = std::numeric_limits<double>::max();
};

/// Around points.
inline Box box_of(std::span<const Vec3> points) {
  Box box;
  for (const Vec3& p : points) box.add(p);
  return box;
}

}  // namespace cavea
