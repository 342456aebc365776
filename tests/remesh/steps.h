#pragma once
// Blocks with a step across their top: ridges as near to each other as the step is high.
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "support/meshes.h"

namespace cavea::test {

/// The body under a polygon in the plane of x and y, from z = 0 to 1; the polygon as triangles.
inline MeshData extruded(const std::vector<std::array<double, 2>>& polygon,
                         const std::vector<std::array<std::int32_t, 3>>& triangles) {
  MeshData data;
  const auto n = std::int32_t(polygon.size());
  for (const double z : {0.0, 1.0})
    for (const auto& p : polygon) data.vertices.push_back({p[0], p[1], z});
  data.vertex_refs.assign(data.vertices.size(), 0);
  for (std::array<std::int32_t, 3> t : triangles) {
    // Diagonals rise from the smaller number to the larger, so that prisms fit each other.
    std::ranges::sort(t);
    const auto [a, b, c] = t;
    for (const auto& tet : {std::array{a, b, c, c + n}, std::array{a, b, b + n, c + n},
                            std::array{a, a + n, b + n, c + n}})
      add_positive(data, tet);
  }
  data.tet_refs.assign(data.tets.size(), 1);
  return data;
}

/// A block with a step of a certain height across its top: two ridges so far from each other.
inline MeshData step(double height) {
  const double low = 0.5, high = 0.5 + height;
  return extruded({{0, 0}, {1, 0}, {1, low}, {0.5, low}, {0.5, high}, {0, high}},
                  {{0, 1, 2}, {0, 2, 3}, {3, 4, 5}, {0, 3, 5}});
}

/// The same, but the step rises from nothing at one end: its ridges meet in a tip there.
inline MeshData rising_step(double height) {
  MeshData data = step(height);
  std::erase_if(data.tets, [](const auto& t) { return std::ranges::find(t, 4) != t.end(); });
  data.tet_refs.resize(data.tets.size());
  data.vertices[5].y = data.vertices[3].y;
  return data;
}

}  // namespace cavea::test
