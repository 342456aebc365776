#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "cavea/geometry/point_block.h"

namespace cavea {

/// The places of a triangle where it is sampled, as barycentric coordinates of its second and third
/// corner: a lattice of n intervals an edge, or of fewer rows from the first two corners to the
/// third, with the edge midpoints and the centroid where that misses them. The corners, midpoints
/// and centroid come first, since they are mostly the farthest.
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

  explicit Lattice(int intervals) : Lattice(intervals, intervals) {}
  /// \param rows at least 1, and no more than intervals
  Lattice(int intervals, int rows);

  /// \param places at least one, and no more than a block holds
  static Block block_of(std::span<const Place> places);

  int intervals() const { return intervals_; }
  int rows() const { return rows_; }
  const std::vector<Place>& places() const { return places_; }
  /// All places, each in one block.
  const std::vector<Block>& blocks() const { return blocks_; }

 private:
  void divide(std::vector<std::int32_t>& places, std::size_t begin, std::size_t end);

  int intervals_, rows_;
  std::vector<Place> places_;
  std::vector<Block> blocks_;
};

/// Those of kMinIntervals to kMaxIntervals, with all their rows, half of them, a quarter and so on,
/// each made when it is first asked for, by any thread.
class Lattices {
 public:
  const Lattice& coarsest() const { return (*this)[Lattice::kMinIntervals]; }
  const Lattice& operator[](int intervals) const { return get(intervals, 0); }
  /// The one with the fewest rows that are at least so many.
  const Lattice& with_rows(int intervals, int rows) const {
    int halvings = 0;
    while (halvings + 1 < kHalvings && rows_of(intervals, halvings + 1) >= std::max(rows, 2))
      ++halvings;
    return get(intervals, halvings);
  }

 private:
  static constexpr int kHalvings = 6;

  static int rows_of(int intervals, int halvings) { return intervals >> halvings; }

  const Lattice& get(int intervals, int halvings) const {
    Entry& e = all_[std::size_t(halvings)][std::size_t(intervals - Lattice::kMinIntervals)];
    std::call_once(e.once, [&] { e.lattice.emplace(intervals, rows_of(intervals, halvings)); });
    return *e.lattice;
  }

  struct Entry {
    std::once_flag once;
    std::optional<Lattice> lattice;
  };
  static constexpr std::size_t kCount = Lattice::kMaxIntervals - Lattice::kMinIntervals + 1;
  mutable std::array<std::array<Entry, kCount>, kHalvings> all_;
};

}  // namespace cavea
