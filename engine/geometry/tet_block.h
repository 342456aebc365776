#pragma once
#include <array>
#include <cstddef>

#include "cavea/geometry/vec3.h"

namespace cavea {

/// A few tets as arrays for wide registers. Gives the same bits on every instruction set, and as
/// one by one.
class TetBlock {
 public:
  static constexpr std::size_t kMost = 64;
  using Row = std::array<double, kMost>;

  void clear() { count_ = 0; }
  /// \pre not full
  void add(const std::array<Vec3, 4>& corners) {
    for (std::size_t k = 0; k < 4; ++k)
      x_[k][count_] = corners[k].x, y_[k][count_] = corners[k].y, z_[k][count_] = corners[k].z;
    ++count_;
  }
  std::size_t size() const { return count_; }
  bool full() const { return count_ == kMost; }
  std::array<Vec3, 4> operator[](std::size_t i) const {
    return {at(0, i), at(1, i), at(2, i), at(3, i)};
  }

  /// tet_quality() of each.
  const Row& qualities();
  /// Cosines of the dihedral angles at the edges 01, 02, 03, 12, 13 and 23 of each, from the
  /// normals of the faces: not a number where one of the two has no area.
  const std::array<Row, 6>& cosines();

 private:
  Vec3 at(std::size_t corner, std::size_t i) const {
    return {x_[corner][i], y_[corner][i], z_[corner][i]};
  }

  std::size_t count_ = 0;
  alignas(64) std::array<Row, 4> x_, y_, z_;
  alignas(64) Row quality_;
  alignas(64) std::array<Row, 6> cosine_;
};

}  // namespace cavea
