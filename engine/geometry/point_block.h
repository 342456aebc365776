#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "cavea/base/ids.h"
#include "cavea/geometry/box.h"

namespace cavea {

/// A few points as arrays for wide registers.
class PointBlock {
 public:
  static constexpr std::size_t kMost = 32;
  /// Arrays are computed on in groups of so many: what is beyond the last point counts for nothing.
  static constexpr std::size_t kGroup = 8;
  using Row = std::array<double, kMost>;

  std::size_t size() const { return count_; }
  std::size_t groups() const { return (count_ + kGroup - 1) / kGroup; }
  Vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }

  Box box() const {
    Box box;
    for (std::size_t i = 0; i < count_; ++i) box.add((*this)[i]);
    return box;
  }

  /// \param n at most kMost; the points are set through x, y and z, to the end of the last group
  void resize(std::size_t n) { count_ = n; }

  alignas(64) Row x, y, z;

 private:
  std::size_t count_ = 0;
};

/// closest_on_triangle() of each point of a block.
struct ClosestOfBlock {
  alignas(64) PointBlock::Row u, v, distance2;
};

/// What has been found nearest to each point of a block: the numbers of things and their squared
/// distances.
class NearestOfBlock {
 public:
  /// Nothing yet, of n points.
  void clear(std::size_t n) {
    groups_ = (n + PointBlock::kGroup - 1) / PointBlock::kGroup;
    largest2_ = std::numeric_limits<double>::infinity();
    distance2_.fill(largest2_);
    number_.fill(kNone);
  }
  /// Sees which points are nearer to one more thing.
  void improve(const PointBlock::Row& distance2, std::int32_t number);

  /// The largest squared distance.
  double largest2() const { return largest2_; }
  double distance2(std::size_t i) const { return distance2_[i]; }
  std::int32_t number(std::size_t i) const { return std::int32_t(number_[i]); }
  /// Whether a point may be nearer to something than to what is known, if that is nowhere nearer
  /// than `distance2` less `slack`.
  bool may_improve(const PointBlock::Row& distance2, double slack) const;

 private:
  std::size_t groups_ = 0;
  double largest2_ = std::numeric_limits<double>::infinity();
  alignas(64) PointBlock::Row distance2_;
  alignas(64) std::array<std::int64_t, PointBlock::kMost> number_;
};

/// What closest_on_triangle() says of each point, to the bit, on every instruction set.
void closest_on_triangle(const PointBlock& points, const Vec3& a, const Vec3& b, const Vec3& c,
                         ClosestOfBlock& closest);

}  // namespace cavea
