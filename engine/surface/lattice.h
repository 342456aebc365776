#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cavea/geometry/point_block.h"

namespace cavea {

/// The places of a triangle where it is sampled, as barycentric coordinates of its second and third
/// corner: a lattice of n intervals an edge, with the edge midpoints and the centroid where that
/// misses them. The corners, midpoints and centroid come first, since they are mostly the farthest.
class Lattice {
 public:
  /// Corners and edge midpoints.
  static constexpr int kMinIntervals = 2;
  /// 2,145 places; a triangle that needs more at the caller's step is far larger than the rest.
  static constexpr int kMaxIntervals = 64;

  struct Place {
    double u = 0, v = 0;
  };
  /// Places near each other.
  struct Block {
    std::size_t count = 0;
    alignas(64) PointBlock::Row u, v;                   ///< to the end of the last group
    std::array<std::int32_t, PointBlock::kMost> place;  ///< numbers of the places
  };

  explicit Lattice(int intervals);

  /// \param places at least one, and no more than a block holds
  static Block block_of(std::span<const Place> places);

  int intervals() const { return intervals_; }
  const std::vector<Place>& places() const { return places_; }
  /// All places, each in one block.
  const std::vector<Block>& blocks() const { return blocks_; }

 private:
  void divide(std::vector<std::int32_t>& places, std::size_t begin, std::size_t end);

  int intervals_;
  std::vector<Place> places_;
  std::vector<Block> blocks_;
};

/// Those of kMinIntervals to kMaxIntervals.
class Lattices {
 public:
  Lattices();
  const Lattice& coarsest() const { return all_.front(); }
  const Lattice& operator[](int intervals) const {
    return all_[std::size_t(intervals - Lattice::kMinIntervals)];
  }

 private:
  std::vector<Lattice> all_;
};

}  // namespace cavea
