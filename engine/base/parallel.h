#pragma once
// The only door to oneTBB. Everything here gives the same result for any number of threads:
// loops are over disjoint data, reductions and scans have a shape fixed by the data alone.
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "cavea/base/fork_join.h"

namespace cavea {

/// Number of threads to use when the caller does not say.
int default_threads();

/// Runs f inside an arena of its own with the given number of threads (at least 1; no more than a
/// tbb::global_control of the caller allows), so that the caller's scheduler settings are neither
/// used nor changed.
template <class F>
void run_in_arena(int threads, F&& f) {
  using Control = tbb::global_control;
  constexpr auto kMost = Control::max_allowed_parallelism;
  const auto wanted = static_cast<std::size_t>(std::max(threads, 1));
  // Without it oneTBB starts no more threads than there are cores, and prints a warning.
  std::optional<Control> more;
  if (Control::active_value(kMost) < wanted) more.emplace(kMost, wanted);
  tbb::task_arena arena(static_cast<int>(std::min(wanted, Control::active_value(kMost))));
  ForkJoin fork;
  arena.execute([&] {
    const ForkJoin::Task task(fork);
    f();
  });
}

/// Calls f(begin, end) on disjoint ranges that cover [0, n).
template <class F, class Partitioner = tbb::auto_partitioner>
void parallel_ranges(std::size_t n, std::size_t grain, F&& f, const Partitioner& partitioner = {}) {
  if (n == 0) return;
  ForkJoin fork;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, std::max<std::size_t>(grain, 1)),
                    fork.body(f), partitioner);
}

/// Calls f(i) for each i in [0, n).
template <class F, class Partitioner = tbb::auto_partitioner>
void parallel_for(std::size_t n, F&& f, std::size_t grain = 1024,
                  const Partitioner& partitioner = {}) {
  parallel_ranges(
      n, grain,
      [&](std::size_t b, std::size_t e) {
        for (std::size_t i = b; i < e; ++i) f(i);
      },
      partitioner);
}

/// Calls f(i) for each i in [0, n), started in the order of i: for few large tasks.
template <class F>
void parallel_tasks(std::size_t n, F&& f) {
  // A range would be halved, and its second half begun before the end of its first.
  std::atomic<std::size_t> next{0};
  const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  parallel_for(
      std::min(n, threads),
      [&](std::size_t) {
        for (std::size_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < n;) f(i);
      },
      1, tbb::simple_partitioner{});
}

/// Calls f() and g() at the same time, if there is a thread for each: while one of them has work
/// for one thread only, the other goes on.
template <class F, class G>
void run_together(F&& f, G&& g) {
  parallel_tasks(2, [&](std::size_t i) {
    if (i == 0)
      f();
    else
      g();
  });
}

/// Blocks of this many items are reduced one after the other, whatever the number of threads.
inline constexpr std::size_t kReduceBlock = 8192;

/// Reduces map(block_begin, block_end) over fixed blocks, then combines the partial results in
/// block order.
template <class T, class Map, class Combine>
T parallel_reduce(std::size_t n, T identity, Map&& map, Combine&& combine) {
  struct Partial {  // a vector of bool would share words between tasks
    T value;
  };
  const std::size_t blocks = (n + kReduceBlock - 1) / kReduceBlock;
  std::vector<Partial> partial(blocks, Partial{identity});
  parallel_for(
      blocks,
      [&](std::size_t k) {
        partial[k].value = map(k * kReduceBlock, std::min(n, (k + 1) * kReduceBlock));
      },
      1);
  T total = identity;
  for (const Partial& p : partial) total = combine(total, p.value);
  return total;
}

/// Exclusive prefix sum in place; returns the total.
template <class T>
T exclusive_scan(std::vector<T>& a) {
  const std::size_t n = a.size();
  const std::size_t blocks = (n + kReduceBlock - 1) / kReduceBlock;
  std::vector<T> sum(blocks, T{});
  auto block_end = [&](std::size_t k) { return std::min(n, (k + 1) * kReduceBlock); };
  parallel_for(
      blocks,
      [&](std::size_t k) {
        T s{};
        for (std::size_t i = k * kReduceBlock; i < block_end(k); ++i) s += a[i];
        sum[k] = s;
      },
      1);
  T total{};
  for (T& s : sum) {
    const T here = s;
    s = total;
    total += here;
  }
  parallel_for(
      blocks,
      [&](std::size_t k) {
        T s = sum[k];
        for (std::size_t i = k * kReduceBlock; i < block_end(k); ++i) {
          const T here = a[i];
          a[i] = s;
          s += here;
        }
      },
      1);
  return total;
}

/// Sorts by a strict total order (equal elements must be indistinguishable: the sort is not
/// stable).
template <class It, class Less>
void parallel_sort(It begin, It end, Less less) {
#ifdef __SANITIZE_THREAD__
  // The order in which tbb::parallel_sort's tasks touch the elements cannot be told from outside.
  std::sort(begin, end, less);
#else
  tbb::parallel_sort(begin, end, less);
#endif
}
template <class It>
void parallel_sort(It begin, It end) {
  parallel_sort(begin, end, std::less<>{});
}

}  // namespace cavea
