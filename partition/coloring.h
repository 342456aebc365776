#pragma once
#include <cstdint>
#include <vector>

#include "cavea/partition/graph.h"

namespace cavea {

struct Coloring {
  std::vector<std::int32_t> colors;  ///< of each vertex, in [0, count)
  std::int32_t count = 0;
};

/// Gives neighbours different colours; at most one more colour than the largest degree. Greedy in
/// the order of hashed ids, in parallel (Jones and Plassmann 1993): the colours depend on the graph
/// alone. Weights are not read.
/// \pre graph is symmetric; loops are ignored
Coloring color(const Graph& graph);

}  // namespace cavea
