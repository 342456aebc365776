#include "cavea/base/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <numeric>
#include <vector>

#include "cavea/base/buckets.h"
#include "cavea/mesh/renumber.h"
#include "cavea/mesh/union_find.h"
#include "support/meshes.h"

namespace cavea {
namespace {

constexpr int kThreads[] = {1, 2, 3, 8};
constexpr std::size_t kSizes[] = {0, 1, 7, kReduceBlock - 1, kReduceBlock, 3 * kReduceBlock + 5};

TEST(ExclusiveScan, IsTheSumOfWhatCameBefore) {
  for (const std::size_t n : kSizes)
    for (const int threads : kThreads) {
      std::vector<std::int64_t> a(n), expected(n);
      for (std::size_t i = 0; i < n; ++i) a[i] = std::int64_t(i * i % 17) - 4;
      std::exclusive_scan(a.begin(), a.end(), expected.begin(), std::int64_t{0});
      const std::int64_t sum = std::accumulate(a.begin(), a.end(), std::int64_t{0});
      run_in_arena(threads, [&] { EXPECT_EQ(exclusive_scan(a), sum); });
      EXPECT_EQ(a, expected) << n << " numbers, " << threads << " threads";
    }
}

TEST(ParallelReduce, GivesTheSameBitsForAnyNumberOfThreads) {
  const auto harmonic = [](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum += 1.0 / double(i + 1);
    return sum;
  };
  for (const std::size_t n : kSizes) {
    double alone = 0;
    run_in_arena(1, [&] { alone = parallel_reduce(n, 0.0, harmonic, std::plus<double>{}); });
    EXPECT_NEAR(alone, harmonic(0, n), 1e-11);
    for (const int threads : kThreads)
      run_in_arena(threads, [&] {
        EXPECT_EQ(parallel_reduce(n, 0.0, harmonic, std::plus<double>{}), alone);
      });
  }
}

TEST(ParallelLoops, VisitEachIndexOnce) {
  for (const std::size_t n : kSizes) {
    std::vector<int> loop(n, 0), tasks(n, 0);
    run_in_arena(3, [&] {
      parallel_for(
          n, [&](std::size_t i) { ++loop[i]; }, 10);
      parallel_tasks(n, [&](std::size_t i) { ++tasks[i]; });
    });
    EXPECT_EQ(loop, std::vector<int>(n, 1));
    EXPECT_EQ(tasks, std::vector<int>(n, 1));
  }
}

TEST(ParallelTasks, AreStartedInOrder) {
  constexpr std::size_t kTasks = 1000;
  for (const int threads : kThreads) {
    std::atomic<std::size_t> started{0};
    std::vector<std::size_t> before(kTasks);
    run_in_arena(threads, [&] {
      parallel_tasks(kTasks, [&](std::size_t i) { before[i] = started.fetch_add(1); });
    });
    // A thread may be held up after it has taken a task: all others may be ahead of that one, but
    // a task that is counted early was taken after all before it.
    for (std::size_t i = 0; i < kTasks; ++i)
      EXPECT_LT(i, before[i] + std::size_t(threads)) << threads << " threads";
  }
}

TEST(Buckets, HoldEachValueUnderItsKey) {
  constexpr std::uint64_t kSeed = 21;
  SCOPED_TRACE(testing::Message() << "seed " << kSeed);
  test::Random random(kSeed);
  std::vector<std::int32_t> key(20000);
  std::map<std::int32_t, std::vector<std::uint32_t>> expected;
  for (std::size_t i = 0; i < key.size(); ++i) {
    key[i] = random.below(1000);
    expected[key[i]].push_back(std::uint32_t(i));
  }
  run_in_arena(3, [&] {
    Buckets buckets(key.size(), 1001,
                    [&](std::size_t i, auto&& put) { put(key[i], std::uint32_t(i)); });
    EXPECT_EQ(buckets.size(), key.size());
    for (std::int32_t k = 0; k <= 1000; ++k) {
      const auto values = buckets.of(std::size_t(k));
      std::sort(values.begin(), values.end());
      EXPECT_TRUE(std::equal(values.begin(), values.end(), expected[k].begin(), expected[k].end()));
    }
  });
}

TEST(Renumbering, KeepsTheOrder) {
  const Renumbering ids(10, [](std::size_t i) { return i % 3 == 1; });
  EXPECT_EQ(ids.count, 3u);
  EXPECT_EQ(ids.new_id, (std::vector<std::int32_t>{-1, 0, -1, -1, 1, -1, -1, 2, -1, -1}));
  EXPECT_EQ(ids.kept_of(std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}),
            (std::vector<int>{1, 4, 7}));
}

TEST(UnionFind, RootsAreTheSmallestMembers) {
  constexpr std::int32_t kSets = 7, kItems = 50000;
  run_in_arena(3, [&] {
    UnionFind sets(kItems);
    // Residues modulo 7, joined from both ends.
    parallel_for(kItems - kSets, [&](std::size_t i) {
      const std::int32_t a = i % 2 ? std::int32_t(i) : kItems - kSets - 1 - std::int32_t(i);
      sets.join(a, a + kSets);
      sets.join(std::int32_t(i) + kSets, std::int32_t(i));
    });
    for (std::int32_t i = 0; i < kItems; ++i) {
      ASSERT_EQ(sets.root(i), i % kSets);
      ASSERT_EQ(sets.is_root(i), i < kSets);
    }
  });
}

}  // namespace
}  // namespace cavea
