#include "cavea/geometry/box_tree.h"

#include <algorithm>

#include "cavea/base/parallel.h"

namespace cavea {

namespace {

/// Levels that all threads work on, node by node; what is below a node of the last one fits a cache
/// and is parted to the end by one thread.
constexpr int kCommonLevels = 6;

}  // namespace

BoxTree::BoxTree(std::span<const Box> boxes) : order_(boxes.size()) {
  if (order_.empty()) return;
  while (order_.size() >> levels_ > kLeafSize) ++levels_;
  std::vector<Centre> centres(boxes.size());
  parallel_for(boxes.size(), [&](std::size_t i) {
    centres[i] = {boxes[i].low + boxes[i].high, std::int32_t(i)};
  });
  const auto for_nodes = [&](int level, auto&& work) {
    parallel_for(std::size_t{1} << level, work, 1);
  };
  const int common = std::min(levels_, kCommonLevels);
  for (int level = 0; level < common; ++level)
    for_nodes(level, [&](std::size_t k) { part(level, k, centres); });
  for_nodes(common, [&](std::size_t k) {
    for (int level = common; level < levels_; ++level) {
      const std::size_t nodes = std::size_t{1} << (level - common);
      for (std::size_t i = 0; i < nodes; ++i) part(level, k * nodes + i, centres);
    }
  });
  parallel_for(order_.size(), [&](std::size_t slot) { order_[slot] = centres[slot].box; });
  nodes_ = node_boxes(boxes);
}

void BoxTree::part(int level, std::size_t k, std::vector<Centre>& all) const {
  const auto [begin, end] = range(level, k);
  Box centres;
  for (std::size_t slot = begin; slot < end; ++slot) centres.add(all[slot].twice);
  const Vec3 side = centres.high - centres.low;
  const auto at = [&](std::size_t slot) { return all.begin() + std::ptrdiff_t(slot); };
  const auto part_along = [&, low = begin, high = end](double Vec3::*axis) {
    std::nth_element(at(low), at(range(level + 1, 2 * k).second), at(high),
                     [&](const Centre& a, const Centre& b) {
                       const double x = a.twice.*axis, y = b.twice.*axis;
                       return x < y || (x == y && a.box < b.box);
                     });
  };
  if (side.x >= side.y && side.x >= side.z)
    part_along(&Vec3::x);
  else if (side.y >= side.z)
    part_along(&Vec3::y);
  else
    part_along(&Vec3::z);
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
