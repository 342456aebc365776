#include "cavea/geometry/box_tree.h"

#include <algorithm>
#include <numeric>

#include "cavea/base/parallel.h"

namespace cavea {

BoxTree::BoxTree(std::span<const Box> boxes) : order_(boxes.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (order_.empty()) return;
  while (order_.size() >> levels_ > kLeafSize) ++levels_;
  for (int level = 0; level < levels_; ++level) sort_level(level, boxes);
  set_boxes(boxes);
}

/// Parts the slots of each node of a level at the median along the longest side of the centres'
/// box.
void BoxTree::sort_level(int level, std::span<const Box> boxes) {
  parallel_for(
      std::size_t{1} << level,
      [&](std::size_t k) {
        const auto [begin, end] = range(level, k);
        const auto centre2 = [&](std::int32_t i) { return boxes[i].low + boxes[i].high; };
        Box centres;
        for (std::size_t slot = begin; slot < end; ++slot) centres.add(centre2(order_[slot]));
        const Vec3 side = centres.high - centres.low;
        const int axis = side.x >= side.y && side.x >= side.z ? 0 : side.y >= side.z ? 1 : 2;
        const auto first = order_.begin();
        std::nth_element(first + begin, first + range(level + 1, 2 * k).second, first + end,
                         [&](std::int32_t a, std::int32_t b) {
                           const double x = centre2(a)[axis], y = centre2(b)[axis];
                           return x < y || (x == y && a < b);
                         });
      },
      1);
}

void BoxTree::set_boxes(std::span<const Box> boxes) {
  nodes_.resize(2 * first_leaf() + 1);
  parallel_for(first_leaf() + 1, [&](std::size_t k) {
    const auto [begin, end] = range(levels_, k);
    for (std::size_t slot = begin; slot < end; ++slot)
      nodes_[first_leaf() + k].add(boxes[order_[slot]]);
  });
  for (std::size_t i = first_leaf(); i-- > 0;) {
    nodes_[i] = nodes_[2 * i + 1];
    nodes_[i].add(nodes_[2 * i + 2]);
  }
}

std::vector<std::int32_t> BoxTree::slots() const {
  std::vector<std::int32_t> slots(order_.size());
  parallel_for(slots.size(),
               [&](std::size_t slot) { slots[std::size_t(order_[slot])] = std::int32_t(slot); });
  return slots;
}

}  // namespace cavea
