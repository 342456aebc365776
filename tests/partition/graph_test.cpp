#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <set>

#include "cavea/base/parallel.h"
#include "cavea/partition/coloring.h"
#include "cavea/partition/kway.h"

namespace cavea {
namespace {

Graph random_graph(unsigned seed, std::int32_t vertices, int edges) {
  std::mt19937 random(seed);
  std::vector<std::set<std::int32_t>> rows(vertices);
  for (int e = 0; e < edges; ++e) {
    const auto a = std::int32_t(random() % unsigned(vertices));
    const auto b = std::int32_t(random() % unsigned(vertices));
    if (a != b) rows[a].insert(b), rows[b].insert(a);
  }
  Graph graph;
  for (const auto& row : rows) {
    graph.neighbours.insert(graph.neighbours.end(), row.begin(), row.end());
    graph.offsets.push_back(std::int32_t(graph.neighbours.size()));
  }
  return graph;
}

std::int32_t largest_degree(const Graph& graph) {
  std::int32_t degree = 0;
  for (std::int32_t v = 0; v < graph.size(); ++v)
    degree = std::max(degree, graph.offsets[v + 1] - graph.offsets[v]);
  return degree;
}

void expect_valid(const Graph& graph, const Coloring& coloring) {
  ASSERT_EQ(std::int32_t(coloring.colors.size()), graph.size());
  std::set<std::int32_t> used;
  for (std::int32_t v = 0; v < graph.size(); ++v) {
    used.insert(coloring.colors[v]);
    for (std::int32_t k = graph.offsets[v]; k < graph.offsets[v + 1]; ++k)
      ASSERT_NE(coloring.colors[v], coloring.colors[graph.neighbours[k]]) << "at vertex " << v;
  }
  EXPECT_EQ(std::int32_t(used.size()), coloring.count) << "a colour in [0, count) is not used";
  EXPECT_EQ(*used.begin(), 0);
  EXPECT_LE(coloring.count, largest_degree(graph) + 1);
}

TEST(Coloring, SeparatesNeighboursInRandomGraphs) {
  const unsigned first = std::random_device{}() % 1000000;
  for (unsigned seed = first; seed < first + 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto vertices = std::int32_t(2 + seed * 37 % 3000);
    const Graph graph = random_graph(seed, vertices, vertices * int(1 + seed % 12));
    expect_valid(graph, color(graph));
  }
}

TEST(Coloring, GivesACliqueAsManyColoursAsVertices) {
  Graph graph;
  constexpr std::int32_t kSize = 150;  // more than fit into two words of colours
  for (std::int32_t v = 0; v < kSize; ++v) {
    for (std::int32_t u = 0; u < kSize; ++u)
      if (u != v) graph.neighbours.push_back(u);
    graph.offsets.push_back(std::int32_t(graph.neighbours.size()));
  }
  const Coloring coloring = color(graph);
  expect_valid(graph, coloring);
  EXPECT_EQ(coloring.count, kSize);
  EXPECT_EQ(color(Graph{}).count, 0);
}

TEST(Coloring, IsTheSameAtAnyNumberOfThreads) {
  const Graph graph = random_graph(11, 50000, 300000);
  Coloring reference;
  run_in_arena(1, [&] { reference = color(graph); });
  for (const int threads : {2, 3, 8}) {
    Coloring coloring;
    run_in_arena(threads, [&] { coloring = color(graph); });
    EXPECT_EQ(coloring.colors, reference.colors) << threads << " threads";
  }
}

TEST(Kway, IsAFunctionOfTheGraph) {
  const Graph graph = random_graph(5, 2000, 8000);
  const std::vector<std::int32_t> first = kway(graph, 9);
  for (const std::int32_t label : first) EXPECT_TRUE(label >= 0 && label < 9);
  for (int k = 0; k < 5; ++k) {
    std::srand(unsigned(k * 1000 + 1));  // what the host drew before must not matter
    for (int draw = 0; draw < k; ++draw) (void)std::rand();
    EXPECT_EQ(kway(graph, 9), first);
  }
  std::vector<std::vector<std::int32_t>> at_once(6);
  run_in_arena(6, [&] { parallel_tasks(6, [&](std::size_t k) { at_once[k] = kway(graph, 9); }); });
  for (const auto& labels : at_once) EXPECT_EQ(labels, first);
}

TEST(Kway, CutsTheLightEdges) {
  // All joined to all, heavily within the even and within the odd, lightly between them.
  Graph graph;
  constexpr std::int32_t kHalf = 30;
  for (std::int32_t v = 0; v < 2 * kHalf; ++v) {
    for (std::int32_t u = 0; u < 2 * kHalf; ++u) {
      if (u == v) continue;
      graph.neighbours.push_back(u);
      graph.edge_weights.push_back(u % 2 == v % 2 ? 100 : 1);
    }
    graph.offsets.push_back(std::int32_t(graph.neighbours.size()));
  }
  const std::vector<std::int32_t> labels = kway(graph, 2);
  for (std::int32_t v = 0; v < 2 * kHalf; ++v) EXPECT_EQ(labels[v], labels[v % 2]);
  EXPECT_NE(labels[0], labels[1]);
}

TEST(Kway, BalancesVertexWeights) {
  Graph graph = random_graph(3, 3000, 12000);
  for (std::int32_t v = 0; v < graph.size(); ++v) graph.vertex_weights.push_back(1 + v % 10);
  std::vector<double> sums(5, 0);
  const std::vector<std::int32_t> labels = kway(graph, 5);
  double total = 0;
  for (std::int32_t v = 0; v < graph.size(); ++v)
    sums[labels[v]] += graph.vertex_weights[v], total += graph.vertex_weights[v];
  for (const double s : sums) EXPECT_NEAR(s, total / 5, 0.05 * total / 5);
}

TEST(Kway, BearsDegenerateGraphs) {
  EXPECT_TRUE(kway(Graph{}, 4).empty());
  Graph loose;
  loose.offsets.assign(101, 0);
  EXPECT_EQ(kway(loose, 1), std::vector<std::int32_t>(100, 0));
  std::vector<int> counts(4, 0);
  for (const std::int32_t label : kway(loose, 4)) ++counts.at(label);
  for (const int c : counts) EXPECT_GT(c, 0);
  EXPECT_EQ(kway(loose, 100).back(), 99);
}

}  // namespace
}  // namespace cavea
