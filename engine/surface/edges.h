#pragma once
#include <vector>

#include "cavea/base/parallel.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// One triangle's side of a surface edge: vertices a < b, and the triangle with the edge opposite
/// its local vertex k. Sorted lists of these group the triangles of each edge.
struct EdgeSide {
  VertexId a, b;
  TriangleId triangle;
  std::int32_t k;
  bool same_edge(const EdgeSide& o) const { return a == o.a && b == o.b; }
};

/// All sides of the living surface triangles, sorted by (a, b, triangle).
std::vector<EdgeSide> sorted_edge_sides(const std::vector<Triangle>& triangles);

/// Calls f(begin, end) for each group of sides of one edge.
template <class F>
void for_each_edge(const std::vector<EdgeSide>& sides, F&& f) {
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t j = i + 1;
    while (j < sides.size() && sides[j].same_edge(sides[i])) ++j;
    f(sides.data() + i, sides.data() + j);
    i = j;
  }
}

/// The same from many threads, in any order.
template <class F>
void parallel_for_each_edge(const std::vector<EdgeSide>& sides, F&& f) {
  parallel_for(sides.size(), [&](std::size_t i) {
    if (i > 0 && sides[i].same_edge(sides[i - 1])) return;
    std::size_t j = i + 1;
    while (j < sides.size() && sides[j].same_edge(sides[i])) ++j;
    f(sides.data() + i, sides.data() + j);
  });
}

}  // namespace cavea
