#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cavea {

/// A symmetric graph without loops as compressed rows: the neighbours of vertex v are
/// neighbours[offsets[v]] to neighbours[offsets[v + 1] - 1]. Weights may be absent (empty: all 1).
struct Graph {
  std::vector<std::int32_t> offsets{0};      ///< one more than there are vertices
  std::vector<std::int32_t> neighbours;      ///< both directions of every edge
  std::vector<std::int32_t> edge_weights;    ///< beside neighbours, alike in both directions
  std::vector<std::int32_t> vertex_weights;  ///< one a vertex

  std::int32_t size() const { return static_cast<std::int32_t>(offsets.size()) - 1; }
  std::span<const std::int32_t> row(std::int32_t v) const {
    return std::span(neighbours).subspan(offsets[v], offsets[v + 1] - offsets[v]);
  }
};

}  // namespace cavea
