#include "cavea/part/clusters.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

#include "cavea/base/parallel.h"
#include "cavea/mesh/union_find.h"

namespace cavea {
namespace {

/// For each vertex the positions in a list of tets of those that have it.
class TetsAt {
 public:
  TetsAt(const TetMesh& m, const TetList& tets) {
    corners_.reserve(4 * tets.size());
    for (std::size_t i = 0; i < tets.size(); ++i)
      for (const VertexId v : m.tets[tets[i]]) corners_.push_back({v, i});
    parallel_sort(corners_.begin(), corners_.end(), std::less<>{});
  }

  auto of(VertexId v) const {
    return std::ranges::equal_range(corners_, v, std::less<>{},
                                    [](const auto& corner) { return corner.first; });
  }

 private:
  std::vector<std::pair<VertexId, std::size_t>> corners_;
};

using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

/// \param pairs sorted by the first
Graph graph_of(const Pairs& pairs, std::size_t vertices) {
  Graph graph;
  graph.offsets.assign(vertices + 1, 0);
  graph.neighbours.reserve(pairs.size());
  for (const auto& [from, to] : pairs) {
    ++graph.offsets[std::size_t(from) + 1];
    graph.neighbours.push_back(to);
  }
  std::partial_sum(graph.offsets.begin(), graph.offsets.end(), graph.offsets.begin());
  return graph;
}

}  // namespace

std::vector<TetList> clusters_of(const TetMesh& m, const TetList& tets, std::size_t most) {
  const TetsAt tets_at(m, tets);
  std::vector<char> taken(tets.size(), 0);
  std::vector<TetList> clusters;
  for (std::size_t first = 0; first < tets.size(); ++first) {
    if (std::exchange(taken[first], 1)) continue;
    TetList& cluster = clusters.emplace_back(TetList{tets[first]});
    for (std::size_t k = 0; k < cluster.size() && cluster.size() < most; ++k)
      for (const VertexId v : m.tets[cluster[k]])
        for (const auto& [vertex, i] : tets_at.of(v))
          if (cluster.size() < most && !std::exchange(taken[i], 1)) cluster.push_back(tets[i]);
  }
  return clusters;
}

Graph conflicts_of(const std::vector<TetList>& lists) {
  std::vector<std::pair<TetId, std::int32_t>> members;
  for (std::size_t k = 0; k < lists.size(); ++k)
    for (const TetId t : lists[k]) members.emplace_back(t, std::int32_t(k));
  parallel_sort(members.begin(), members.end(), std::less<>{});
  Pairs pairs;
  for (std::size_t i = 0; i < members.size(); ++i)
    for (std::size_t j = i + 1; j < members.size() && members[j].first == members[i].first; ++j) {
      pairs.emplace_back(members[i].second, members[j].second);
      pairs.emplace_back(members[j].second, members[i].second);
    }
  parallel_sort(pairs.begin(), pairs.end(), std::less<>{});
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return graph_of(pairs, lists.size());
}

std::vector<TetList> joined(std::vector<TetList> lists, const Graph& conflicts) {
  UnionFind sets(lists.size());
  for (std::int32_t k = 0; k < conflicts.size(); ++k)
    for (const std::int32_t other : conflicts.row(k)) sets.join(k, other);
  std::vector<TetList> result;
  std::vector<std::size_t> place(lists.size());  // of a root's list in the result
  for (std::size_t k = 0; k < lists.size(); ++k) {
    const auto root = std::size_t(sets.root(std::int32_t(k)));
    if (root == k) {  // the smallest of its set
      place[k] = result.size();
      result.push_back(std::move(lists[k]));
    } else {
      TetList& list = result[place[root]];
      list.insert(list.end(), lists[k].begin(), lists[k].end());
    }
  }
  return result;
}

}  // namespace cavea
