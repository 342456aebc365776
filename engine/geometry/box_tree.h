#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "cavea/geometry/box.h"

namespace cavea {

/// A static bounding-volume tree over boxes: a complete binary tree in heap order, cut at the
/// medians of the boxes' centres, so that no node needs a pointer. It depends on the boxes alone,
/// not on the number of threads that build it. Read-only after construction: many threads may ask
/// at once.
class BoxTree {
 public:
  explicit BoxTree(std::span<const Box> boxes);

  /// The boxes' numbers in the order of the tree's slots: boxes of a leaf are neighbours.
  const std::vector<std::int32_t>& order() const { return order_; }
  /// The slots of the boxes: the inverse of order().
  std::vector<std::int32_t> slots() const;

  /// The box around what is below a node.
  const Box& box_of(std::size_t node) const { return nodes_[node]; }
  /// For each node the box around what is below it, of other boxes of the same numbers.
  std::vector<Box> node_boxes(std::span<const Box> boxes) const;

  /// Calls visit(slot) for the boxes that may hold something nearer to a point or box than
  /// sqrt(bound2), near ones first; visit lowers bound2 as it finds something.
  template <class Place, class Visit>
  void visit_near(const Place& p, double& bound2, Visit&& visit) const {
    visit_near(
        p, bound2, [](std::size_t) { return true; }, visit);
  }
  /// The same without the nodes for which may(node) is false, and all below them.
  template <class Place, class May, class Visit>
  void visit_near(const Place& p, double& bound2, May&& may, Visit&& visit) const {
    if (order_.empty()) return;
    std::array<std::pair<std::size_t, double>, kMaxLevels + 2> stack;
    std::size_t depth = 0;
    stack[depth++] = {0, nodes_[0].distance2(p)};
    while (depth > 0) {
      const auto [node, near2] = stack[--depth];
      if (near2 >= bound2 || !may(node)) continue;
      if (node >= first_leaf()) {
        const auto [begin, end] = range(levels_, node - first_leaf());
        for (std::size_t slot = begin; slot < end; ++slot) visit(slot);
        continue;
      }
      std::pair<std::size_t, double> a{2 * node + 1, nodes_[2 * node + 1].distance2(p)};
      std::pair<std::size_t, double> b{2 * node + 2, nodes_[2 * node + 2].distance2(p)};
      if (a.second < b.second) std::swap(a, b);
      stack[depth++] = a;
      stack[depth++] = b;
    }
  }
  /// Calls visit(slot) for all boxes in the leaves that overlap `box`: those that overlap it and
  /// some more.
  template <class Visit>
  void visit_overlapping(const Box& box, Visit&& visit) const {
    any_overlapping(box, [&](std::size_t slot) {
      visit(slot);
      return false;
    });
  }
  /// The same until is(slot) is true. \return whether it was for one
  template <class Is>
  bool any_overlapping(const Box& box, Is&& is) const {
    if (order_.empty()) return false;
    std::array<std::size_t, kMaxLevels + 2> stack;
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const std::size_t node = stack[--depth];
      if (!nodes_[node].overlaps(box)) continue;
      if (node < first_leaf()) {
        stack[depth++] = 2 * node + 1;
        stack[depth++] = 2 * node + 2;
        continue;
      }
      const auto [begin, end] = range(levels_, node - first_leaf());
      for (std::size_t slot = begin; slot < end; ++slot)
        if (is(slot)) return true;
    }
    return false;
  }

 private:
  /// Leaves hold at least half as many boxes (unless there are fewer); more make queries slower,
  /// fewer cost memory.
  static constexpr std::size_t kLeafSize = 4;
  /// Boxes are numbered by 32 bits.
  static constexpr int kMaxLevels = 32;

  /// Of a box, by itself: looking it up by number for each comparison would take twice as long. Its
  /// place is a whole number of 2^-32 of the longest side of all centres' box.
  struct Centre {
    std::array<std::uint32_t, 3> at;
    std::int32_t box;

    /// Its place along an axis, then its box, as one number.
    std::uint64_t key(std::size_t axis) const {
      return std::uint64_t{at[axis]} << 32 | std::uint32_t(box);
    }
  };

  static std::vector<Centre> centres_of(std::span<const Box> boxes);

  std::size_t first_leaf() const { return (std::size_t{1} << levels_) - 1; }
  /// The slots below node k of a level.
  std::pair<std::size_t, std::size_t> range(int level, std::size_t k) const {
    return {order_.size() * k >> level, order_.size() * (k + 1) >> level};
  }
  /// Parts the slots of node k of a level at the median along the longest side of the centres' box.
  void part(int level, std::size_t k, std::vector<Centre>& centres) const;

  int levels_ = 0;  ///< below the root
  std::vector<Box> nodes_;
  std::vector<std::int32_t> order_;
};

}  // namespace cavea
