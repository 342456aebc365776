#include "cavea/partition/blocks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "cavea/base/atomic.h"
#include "cavea/base/parallel.h"
#include "cavea/partition/curve.h"
#include "cavea/partition/kway.h"

namespace cavea {
namespace {

/// Integer work of an item of mean work: sums of integers do not depend on their order, and 10 bits
/// are finer than any prediction.
constexpr double kMeanWork = 1024;

/// Octree levels: those of the curve, then as many as an index has groups of three bits, so that
/// items at one place can still be told apart.
constexpr int kLevels = kCurveLevels + 11;

/// The sum of f(i) over [0, n), in an order fixed by n.
template <class T, class F>
T sum(std::size_t n, F&& f) {
  return parallel_reduce(
      n, T{0},
      [&](std::size_t begin, std::size_t end) {
        T partial{0};
        for (std::size_t i = begin; i < end; ++i) partial += f(i);
        return partial;
      },
      [](T a, T b) { return a + b; });
}

/// Item work as integers between 1 and what a leaf may hold.
std::vector<std::uint32_t> integer_work(const Items& items, int parts) {
  const auto n = static_cast<std::size_t>(items.size());
  auto usable = [&](std::size_t i) {
    const double w = items.work[i];
    return w > 0 && std::isfinite(w) ? w : 0.0;
  };
  const double total = sum<double>(n, usable);
  const double mean = total > 0 ? total / double(n) : 1;
  const double most = std::min(4e9, 1 + kMeanWork * double(n) / (double(parts) * kLeavesPerPart));
  std::vector<std::uint32_t> work(n);
  parallel_for(n, [&](std::size_t i) {
    work[i] = static_cast<std::uint32_t>(std::min(most, 1 + usable(i) / mean * kMeanWork));
  });
  return work;
}

/// The octree while it grows, level by level; of each level only the cells that were reached by
/// splitting are kept.
class Octree {
 public:
  Octree(std::span<const std::uint64_t> keys, Blocks& blocks) : keys_(keys), blocks_(blocks) {}

  void grow(std::int64_t most, int first_level) {
    std::vector<std::int64_t> work = start(first_level);
    for (int level = first_level; !work.empty(); ++level) {
      const std::vector<std::int32_t> next = settle(work, most);
      work = descend(next, level);
    }
  }

 private:
  // While the tree grows, of_item holds the item's leaf, or -1 - its cell of the current level.

  /// The octant of an item among the children of its cell of the given level.
  std::size_t octant(std::size_t item, int level) const {
    return level < kCurveLevels ? keys_[item] >> (3 * (kCurveLevels - 1 - level)) & 7
                                : item >> (3 * (kLevels - 1 - level)) & 7;
  }

  /// Sums the items' work into cells: cell_of(item) is the cell, or -1 for items to be left alone.
  template <class CellOf>
  std::vector<std::int64_t> sum_work(std::size_t cells, CellOf&& cell_of) {
    std::vector<std::int64_t> work(cells, 0);
    parallel_ranges(keys_.size(), kReduceBlock, [&](std::size_t begin, std::size_t end) {
      // Items next to each other often share their cell: one atomic addition a run.
      std::int64_t run = 0, cell = -1;
      for (std::size_t i = begin; i < end; ++i) {
        const std::int64_t here = cell_of(i);
        if (here < 0) continue;
        if (here != cell && run) atomic_add(work[cell], std::exchange(run, 0));
        cell = here;
        run += blocks_.item_work(static_cast<std::int32_t>(i));
        blocks_.of_item[i] = static_cast<std::int32_t>(-1 - here);
      }
      if (run) atomic_add(work[cell], run);
    });
    return work;
  }

  std::vector<std::int64_t> start(int level) {
    const int shift = 3 * (kCurveLevels - level);
    return sum_work(std::size_t{1} << (3 * level),
                    [&](std::size_t i) { return static_cast<std::int64_t>(keys_[i] >> shift); });
  }

  /// Makes leaves of the cells that hold little enough; returns the leaf of each cell, or -1 - its
  /// rank among those to be split.
  std::vector<std::int32_t> settle(const std::vector<std::int64_t>& work, std::int64_t most) {
    std::vector<std::int32_t> next(work.size());
    split_ = 0;
    for (std::size_t c = 0; c < work.size(); ++c) {
      if (work[c] == 0) continue;
      if (work[c] > most) {
        next[c] = -1 - split_++;
      } else {
        next[c] = blocks_.count();
        blocks_.work.push_back(work[c]);
      }
    }
    return next;
  }

  /// Takes every item that has no leaf yet to its leaf or its child cell; returns the work of the
  /// children, empty when all items have their leaves.
  std::vector<std::int64_t> descend(const std::vector<std::int32_t>& next, int level) {
    return sum_work(std::size_t(split_) * 8, [&](std::size_t i) -> std::int64_t {
      std::int32_t& place = blocks_.of_item[i];
      if (place >= 0) return -1;
      place = next[-1 - place];
      if (place >= 0) return -1;
      return std::int64_t{-1 - place} * 8 + static_cast<std::int64_t>(octant(i, level));
    });
  }

  std::span<const std::uint64_t> keys_;
  Blocks& blocks_;
  std::int32_t split_ = 0;
};

}  // namespace

Blocks make_blocks(const Items& items, int parts) {
  Blocks blocks;
  if (!items.work.empty()) blocks.of_work = integer_work(items, parts);
  const auto n = static_cast<std::size_t>(items.size());
  blocks.of_item.resize(n);
  const auto total = sum<std::int64_t>(
      n, [&](std::size_t i) { return blocks.item_work(static_cast<std::int32_t>(i)); });
  const std::int64_t leaves = std::int64_t{parts} * kLeavesPerPart;
  const std::vector<std::uint64_t> keys = curve_keys(items.positions);
  // A level above the one that would do if the items filled the cube: what is coarser is surely
  // split, and need not be looked at.
  const int first_level = std::max(0, (int(std::bit_width(std::uint64_t(leaves))) - 1) / 3 - 1);
  // An item that is heavier than a leaf's share of what is left after capping must still find a
  // leaf.
  const std::int64_t heaviest =
      blocks.of_work.empty() ? 1 : *std::ranges::max_element(blocks.of_work);
  Octree(keys, blocks).grow(std::max(heaviest, total / leaves), first_level);
  return blocks;
}

std::vector<std::int32_t> partition_items(const Items& items, int parts) {
  std::vector<std::int32_t> labels(items.size(), 0);
  if (parts <= 1 || labels.empty()) return labels;
  const Blocks blocks = make_blocks(items, parts);
  const std::vector<std::int32_t> part_of_block = kway(quotient_graph(items, blocks), parts);
  parallel_for(labels.size(), [&](std::size_t i) { labels[i] = part_of_block[blocks.of_item[i]]; });
  sweep_majority(items, blocks, parts, labels);
  return labels;
}

}  // namespace cavea
