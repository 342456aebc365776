#include "cavea/geometry/box_tree.h"

#include <algorithm>
#include <limits>

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
  std::vector<Centre> centres = centres_of(boxes);
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

std::vector<BoxTree::Centre> BoxTree::centres_of(std::span<const Box> boxes) {
  const auto twice = [&](std::size_t i) { return boxes[i].low + boxes[i].high; };
  const Box all = parallel_reduce(
      boxes.size(), Box{},
      [&](std::size_t begin, std::size_t end) {
        Box box;
        for (std::size_t i = begin; i < end; ++i) box.add(twice(i));
        return box;
      },
      [](Box a, const Box& b) {
        a.add(b);
        return a;
      });
  const Vec3 side = all.high - all.low;
  constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
  const double scale = kMost / std::max({side.x, side.y, side.z});
  // What is no number goes to the low end, and all if they are at one place.
  const auto whole = [&](double x) {
    return x * scale > 0 ? std::uint32_t(std::min(x * scale, kMost)) : 0;
  };
  std::vector<Centre> centres(boxes.size());
  parallel_for(boxes.size(), [&](std::size_t i) {
    const Vec3 from_low = twice(i) - all.low;
    centres[i] = {{whole(from_low.x), whole(from_low.y), whole(from_low.z)}, std::int32_t(i)};
  });
  return centres;
}

void BoxTree::part(int level, std::size_t k, std::vector<Centre>& all) const {
  const auto [begin, end] = range(level, k);
  std::array<std::uint32_t, 3> low = all[begin].at, high = low;
  for (std::size_t slot = begin; slot < end; ++slot)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], all[slot].at[axis]);
      high[axis] = std::max(high[axis], all[slot].at[axis]);
    }
  std::size_t longest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
    if (high[axis] - low[axis] > high[longest] - low[longest]) longest = axis;
  const auto at = [&](std::size_t slot) { return all.begin() + std::ptrdiff_t(slot); };
  std::nth_element(
      at(begin), at(range(level + 1, 2 * k).second), at(end),
      [&](const Centre& a, const Centre& b) { return a.key(longest) < b.key(longest); });
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
