#include "cavea/partition/blocks.h"

#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <random>

#include "cavea/base/parallel.h"
#include "partition/grid.h"

namespace cavea {
namespace {

using testing::for_each_cut;
using testing::Grid;
using testing::kuhn_grid;
using Labels = std::vector<std::int32_t>;

std::vector<double> work_of_parts(const Labels& labels, int parts,
                                  const std::vector<float>& work = {}) {
  std::vector<double> sum(parts, 0);
  for (std::size_t i = 0; i < labels.size(); ++i)
    sum[labels[i]] += work.empty() ? 1 : double(work[i]);
  return sum;
}

std::int64_t count_cut(const Grid& grid, const Labels& labels) {
  std::int64_t twice = 0;
  for_each_cut(grid, labels, [&](auto...) { ++twice; });
  return twice / 2;
}

void expect_balanced(const std::vector<double>& sums) {
  const double mean = std::accumulate(sums.begin(), sums.end(), 0.0) / double(sums.size());
  for (const double s : sums) {
    EXPECT_GT(s, 0.88 * mean);
    EXPECT_LT(s, 1.12 * mean);
  }
}

TEST(Blocks, HoldTheirShareAtMost) {
  const Grid grid = kuhn_grid(20);
  const int parts = 5;
  const Blocks blocks = make_blocks(grid.items(), parts);
  ASSERT_EQ(blocks.of_item.size(), grid.tets.size());
  std::vector<std::int64_t> counted(blocks.count(), 0);
  for (const std::int32_t b : blocks.of_item) ++counted.at(b);
  EXPECT_EQ(counted, blocks.work);
  const auto most = std::int64_t(grid.tets.size()) / (parts * kLeavesPerPart);
  for (const std::int64_t w : counted) {
    EXPECT_GT(w, 0);
    EXPECT_LE(w, most);
  }
}

TEST(Blocks, CutItemsAtOnePlace) {
  const std::vector<Vec3> same(1000, Vec3{1, 2, 3});
  const std::vector<std::array<std::int32_t, 4>> alone(1000, {-1, -1, -1, -1});
  const Blocks blocks = make_blocks({same, alone}, 2);
  for (const std::int64_t w : blocks.work) EXPECT_LE(w, 1000 / (2 * kLeavesPerPart));
  const Labels labels = partition_items({same, alone}, 2);
  expect_balanced(work_of_parts(labels, 2));
}

TEST(QuotientGraph, SumsFaceWeightsBetweenBlocks) {
  const Grid grid = kuhn_grid(9);
  Items items = grid.items();
  items.face_weight = [&](std::int32_t item, int face) {
    return 1 + (item + grid.neighbours[item][face]) % 7;
  };
  const Blocks blocks = make_blocks(items, 3);
  const Graph graph = quotient_graph(items, blocks);
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> expected, found;
  for_each_cut(grid, blocks.of_item, [&](std::int32_t item, int face, std::int32_t other) {
    expected[{blocks.of_item[item], blocks.of_item[other]}] += items.weight(item, face);
  });
  ASSERT_EQ(graph.size(), blocks.count());
  for (std::int32_t b = 0; b < graph.size(); ++b) {
    EXPECT_EQ(graph.vertex_weights[b], blocks.work[b]);
    for (std::int32_t k = graph.offsets[b]; k < graph.offsets[b + 1]; ++k)
      found[{b, graph.neighbours[k]}] += graph.edge_weights[k];
  }
  EXPECT_EQ(found, expected);
  EXPECT_EQ(graph.neighbours.size(), expected.size()) << "a neighbour is listed twice";
}

TEST(QuotientGraph, ScalesWhatWouldNotFit) {
  const Grid grid = kuhn_grid(8);
  Items items = grid.items();
  items.face_weight = [](std::int32_t, int) { return 2'000'000'000; };
  const Graph graph = quotient_graph(items, make_blocks(items, 2));
  std::int64_t sum = 0;
  for (const std::int32_t w : graph.edge_weights) {
    EXPECT_GT(w, 0);
    sum += w;
  }
  EXPECT_LT(sum, std::int64_t{1} << 31);
  expect_balanced(work_of_parts(partition_items(items, 2), 2));
}

TEST(PartitionItems, CutsFewFacesOfAGrid) {
  const Grid grid = kuhn_grid(33);  // 215 622 tets
  const int parts = 4;
  const Labels labels = partition_items(grid.items(), parts);
  expect_balanced(work_of_parts(labels, parts));
  // Four quarters by two planes cut 2 * 33^2 squares of two triangles each: 1.0% of the faces.
  const double share = double(count_cut(grid, labels)) / (2.0 * double(grid.tets.size()));
  EXPECT_GT(share, 0.008);
  EXPECT_LT(share, 0.03);
}

TEST(PartitionItems, AvoidsTheOldInterface) {
  const Grid grid = kuhn_grid(33);
  const int parts = 4;
  Items items = grid.items();
  const Labels first = partition_items(items, parts);
  std::vector<std::uint8_t> on_interface(grid.vertices, 0);
  for_each_cut(grid, first, [&](std::int32_t item, int face, std::int32_t) {
    for (int k = 0; k < 4; ++k)
      if (k != face) on_interface[grid.tets[item][k]] = 1;
  });
  items.face_weight = [&](std::int32_t item, int face) {
    std::int32_t weight = 1;
    for (int k = 0; k < 4; ++k)
      if (k != face) weight += 10 * on_interface[grid.tets[item][k]];
    return weight;
  };
  const Labels second = partition_items(items, parts);
  expect_balanced(work_of_parts(second, parts));
  std::int64_t again = 0, old = 0;
  for_each_cut(grid, first, [&](std::int32_t item, int, std::int32_t other) {
    ++old;
    again += second[item] != second[other];
  });
  EXPECT_LT(double(again), 0.15 * double(old));
}

TEST(PartitionItems, BalancesWorkAndNotCount) {
  const Grid grid = kuhn_grid(24);
  std::vector<float> work;
  for (const Vec3& c : grid.centroids) work.push_back(c.x < 6 ? 20.0f : 1.0f);
  Items items = grid.items();
  items.work = work;
  expect_balanced(work_of_parts(partition_items(items, 6), 6, work));
}

TEST(PartitionItems, BearsSenselessWork) {
  const Grid grid = kuhn_grid(10);
  std::vector<float> work(grid.tets.size(), 1.0f);
  work[0] = -5, work[1] = NAN, work[2] = INFINITY, work[3] = 1e30f, work[4] = 0;
  Items items = grid.items();
  items.work = work;
  for (const std::int32_t label : partition_items(items, 3)) {
    EXPECT_GE(label, 0);
    EXPECT_LT(label, 3);
  }
}

TEST(PartitionItems, IsTheSameAtAnyNumberOfThreads) {
  const Grid grid = kuhn_grid(22);
  std::mt19937 random(7);
  std::vector<float> work(grid.tets.size());
  for (float& w : work) w = float(random() % 100) / 10;
  Items items = grid.items();
  items.work = work;
  items.face_weight = [](std::int32_t, int face) { return 1 + face % 2; };  // not even alike
  Labels reference;
  run_in_arena(1, [&] { reference = partition_items(items, 7); });
  for (const int threads : {2, 3, 8}) {
    Labels labels;
    run_in_arena(threads, [&] { labels = partition_items(items, 7); });
    EXPECT_EQ(labels, reference) << threads << " threads";
  }
}

TEST(PartitionItems, NeedsNoPartsAndNoItems) {
  const Grid grid = kuhn_grid(2);
  EXPECT_EQ(partition_items(grid.items(), 1), Labels(grid.tets.size(), 0));
  EXPECT_TRUE(partition_items({}, 8).empty());
  const Labels many = partition_items(grid.items(), 1000);
  for (const std::int32_t label : many) EXPECT_TRUE(label >= 0 && label < 1000);
}

}  // namespace
}  // namespace cavea
