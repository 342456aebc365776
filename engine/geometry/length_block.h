#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "cavea/geometry/vec3.h"

namespace cavea {

/// Tells the edges of a few tets apart by their lengths in the metric, on wide registers: bounds by
/// the sizes at both ends, without roots and logarithms, so that few edges are left for
/// length_exceeds(), which decides. The same bits on every instruction set.
class LengthBlock {
 public:
  static constexpr std::size_t kMost = 64;
  using Row = std::array<double, kMost>;
  /// A bit for each edge of each tet: bit k for edge k in the order 01, 02, 03, 12, 13, 23.
  using Edges = std::array<std::uint8_t, kMost>;

  void clear() { count_ = 0; }
  /// \pre not full; the sizes are positive
  void add(const std::array<Vec3, 4>& corners, const std::array<double, 4>& sizes) {
    for (std::size_t k = 0; k < 4; ++k) {
      x_[k][count_] = corners[k].x, y_[k][count_] = corners[k].y, z_[k][count_] = corners[k].z;
      size_[k][count_] = sizes[k];
    }
    ++count_;
  }
  std::size_t size() const { return count_; }
  bool full() const { return count_ == kMost; }

  /// All edges whose length exceeds the limit, and some that do not.
  const Edges& perhaps_above(double limit);
  /// All edges whose length does not exceed the limit, and some that do.
  const Edges& perhaps_below(double limit);

 private:
  const Edges& pack();

  std::size_t count_ = 0;
  alignas(64) std::array<Row, 4> x_, y_, z_, size_;
  alignas(64) std::array<std::int64_t, kMost> bits_;
  Edges edges_;
};

}  // namespace cavea
