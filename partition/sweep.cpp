#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "cavea/base/atomic.h"
#include "cavea/base/ids_where.h"
#include "cavea/base/parallel.h"
#include "cavea/partition/blocks.h"

namespace cavea {
namespace {

/// Sweeps go by turns to higher and to lower labels: two neighbours never change places, and in
/// each sweep every move makes its neighbours' moves better, so that the cut falls although all
/// items decide on the labels of the sweep before. Two of each direction are enough (the
/// architecture page: as good as METIS on all items after 3 to 4).
constexpr int kSweeps = 4;

/// A part at more than this share of the mean work takes no items in a sweep; one at less than two
/// minus this share gives none. METIS itself allows 1.03.
constexpr double kMostShare = 1.1;

class Sweep {
 public:
  Sweep(const Items& items, std::vector<std::int32_t>& labels, std::vector<std::int64_t>& part_work)
      : items_(items), labels_(labels), part_work_(part_work), near_(labels.size()) {
    std::int64_t total = 0;
    for (const std::int64_t w : part_work) total += w;
    const double mean = double(total) / double(part_work.size());
    most_ = mean * kMostShare;
    least_ = mean * (2 - kMostShare);
    parallel_for(near_.size(), [&](std::size_t i) { near_[i] = is_at_cut(std::int32_t(i)); });
  }

  void run(const Blocks& blocks, bool upwards) {
    const std::vector<std::int64_t> before = part_work_;
    const std::vector<std::int32_t> asked =
        ids_where(near_.size(), [&](std::int32_t i) { return near_[i] != 0; });
    std::vector<std::int32_t> to(asked.size());
    parallel_for(asked.size(), [&](std::size_t k) { to[k] = choose(asked[k], upwards, before); });
    parallel_for(asked.size(), [&](std::size_t k) {
      const std::int32_t item = asked[k], from = labels_[item];
      if (to[k] == from) return;
      labels_[item] = to[k];
      const std::int64_t work = blocks.item_work(item);
      atomic_add(part_work_[from], -work);
      atomic_add(part_work_[to[k]], work);
      for (const std::int32_t j : items_.neighbours[item])
        if (j >= 0) std::atomic_ref(near_[j]).store(1, std::memory_order_relaxed);
    });
  }

 private:
  bool may_move(std::int32_t from, std::int32_t to, bool upwards,
                const std::vector<std::int64_t>& work) const {
    return (to > from) == upwards && double(work[to])<most_&& double(work[from])> least_;
  }

  bool is_at_cut(std::int32_t item) const {
    return std::ranges::any_of(items_.neighbours[item], [&](std::int32_t j) {
      return j >= 0 && labels_[j] != labels_[item];
    });
  }

  /// The part that the item goes to: its own unless another has more of its face weight.
  std::int32_t choose(std::int32_t item, bool upwards,
                      const std::vector<std::int64_t>& work) const {
    const std::int32_t own = labels_[item];
    const std::array<std::int32_t, 4>& around = items_.neighbours[item];
    std::array<std::int32_t, 4> label;
    bool inside = true;
    for (int f = 0; f < 4; ++f) {
      label[f] = around[f] < 0 ? own : labels_[around[f]];
      inside = inside && label[f] == own;
    }
    if (inside) return own;
    std::array<std::int32_t, 4> weight;
    for (int f = 0; f < 4; ++f) weight[f] = around[f] < 0 ? 0 : items_.weight(item, f);
    auto weight_of = [&](std::int32_t part) {
      std::int64_t sum = 0;
      for (int f = 0; f < 4; ++f) sum += label[f] == part ? weight[f] : 0;
      return sum;
    };
    std::int32_t best = own;
    std::int64_t best_weight = weight_of(own);
    for (const std::int32_t part : label) {
      if (part == own || !may_move(own, part, upwards, work)) continue;
      const std::int64_t w = weight_of(part);
      if (w > best_weight || (w == best_weight && best != own && part < best))
        best = part, best_weight = w;
    }
    return best;
  }

  const Items& items_;
  std::vector<std::int32_t>& labels_;
  std::vector<std::int64_t>& part_work_;
  std::vector<std::uint8_t> near_;  ///< 0 for items that have none of another part around them
  double most_ = 0, least_ = 0;
};

std::vector<std::int64_t> sum_by_part(const Blocks& blocks, int parts,
                                      const std::vector<std::int32_t>& labels) {
  std::vector<std::int64_t> work(parts, 0);
  parallel_ranges(labels.size(), kReduceBlock, [&](std::size_t begin, std::size_t end) {
    std::vector<std::int64_t> mine(parts, 0);
    for (std::size_t i = begin; i < end; ++i)
      mine[labels[i]] += blocks.item_work(static_cast<std::int32_t>(i));
    for (int p = 0; p < parts; ++p)
      if (mine[p]) atomic_add(work[p], mine[p]);
  });
  return work;
}

}  // namespace

void sweep_majority(const Items& items, const Blocks& blocks, int parts,
                    std::vector<std::int32_t>& labels) {
  std::vector<std::int64_t> part_work = sum_by_part(blocks, parts, labels);
  Sweep sweep(items, labels, part_work);
  for (int s = 0; s < kSweeps; ++s) sweep.run(blocks, s % 2 == 0);
}

}  // namespace cavea
