#include "cavea/geometry/box_tree.h"

#include <algorithm>

#include "cavea/base/parallel.h"

namespace cavea {

BoxTree::BoxTree(std::span<const Box> boxes) : order_(boxes.size()) {
  if (order_.empty()) return;
  while (order_.size() >> levels_ > kLeafSize) ++levels_;
  std::vector<Centre> centres(boxes.size());
  parallel_for(boxes.size(), [&](std::size_t i) {
    centres[i] = {boxes[i].low + boxes[i].high, std::int32_t(i)};
  });
  for (int level = 0; level < levels_; ++level) sort_level(level, centres);
  parallel_for(order_.size(), [&](std::size_t slot) { order_[slot] = centres[slot].box; });
  nodes_ = node_boxes(boxes);
}

/// Parts the slots of each node of a level at the median along the longest side of the centres'
/// box.
void BoxTree::sort_level(int level, std::vector<Centre>& all) const {
  parallel_for(
      std::size_t{1} << level,
      [&](std::size_t k) {
        const auto [begin, end] = range(level, k);
        Box centres;
        for (std::size_t slot = begin; slot < end; ++slot) centres.add(all[slot].twice);
        const Vec3 side = centres.high - centres.low;
        const auto part = [&](double Vec3::*axis) {
          const auto at = [&](std::size_t slot) { return all.begin() + std::ptrdiff_t(slot); };
          const auto [low, high] = range(level, k);
          std::nth_element(at(low), at(range(level + 1, 2 * k).second), at(high),
                           [&](const Centre& a, const Centre& b) {
                             const double x = a.twice.*axis, y = b.twice.*axis;
                             return x < y || (x == y && a.box < b.box);
                           });
        };
        if (side.x >= side.y && side.x >= side.z)
          part(&Vec3::x);
        else if (side.y >= side.z)
          part(&Vec3::y);
        else
          part(&Vec3::z);
      },
      1);
}

std::vector<Box> BoxTree::node_boxes(std::span<const Box> boxes) const {
  std::vector<Box> nodes(2 * first_leaf() + 1);
  parallel_for(first_leaf() + 1, [&](std::size_t k) {
    const auto [begin, end] = range(levels_, k);
    for (std::size_t slot = begin; slot < end; ++slot)
      nodes[first_leaf() + k].add(boxes[order_[slot]]);
  });
  for (std::size_t i = first_leaf(); i-- > 0;) {
    nodes[i] = nodes[2 * i + 1];
    nodes[i].add(nodes[2 * i + 2]);
  }
  return nodes;
}

std::vector<std::int32_t> BoxTree::slots() const {
  std::vector<std::int32_t> slots(order_.size());
  parallel_for(slots.size(),
               [&](std::size_t slot) { slots[std::size_t(order_[slot])] = std::int32_t(slot); });
  return slots;
}

}  // namespace cavea
