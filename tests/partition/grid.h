#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "cavea/partition/blocks.h"

namespace cavea::testing {

/// A cube of m^3 cells, each cut into six tetrahedra (Kuhn), in the partitioner's terms.
struct Grid {
  std::vector<std::array<std::int32_t, 4>> tets;
  std::vector<std::array<std::int32_t, 4>> neighbours;
  std::vector<Vec3> centroids;
  std::int32_t vertices = 0;

  Items items() const { return {centroids, neighbours}; }
};

inline Grid kuhn_grid(int m) {
  constexpr int kOrders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  Grid grid;
  grid.vertices = (m + 1) * (m + 1) * (m + 1);
  for (int cell = 0; cell < m * m * m; ++cell) {
    for (const auto& order : kOrders) {
      std::array<int, 3> at = {cell / (m * m), cell / m % m, cell % m};
      std::array<std::int32_t, 4> tet{};
      Vec3 sum;
      for (int k = 0; k < 4; ++k) {
        tet[k] = (at[0] * (m + 1) + at[1]) * (m + 1) + at[2];
        sum += Vec3{double(at[0]), double(at[1]), double(at[2])};
        if (k < 3) ++at[order[k]];
      }
      grid.tets.push_back(tet);
      grid.centroids.push_back(sum / 4);
    }
  }
  // Faces as (sorted vertices, tet, face): equal ones come to stand side by side.
  std::vector<std::array<std::int32_t, 5>> faces;
  for (std::size_t t = 0; t < grid.tets.size(); ++t) {
    for (int f = 0; f < 4; ++f) {
      const auto& v = grid.tets[t];  // Kuhn tets list their vertices in rising order
      faces.push_back({v[f == 0], v[f <= 1 ? 2 : 1], v[f <= 2 ? 3 : 2], std::int32_t(t), f});
    }
  }
  std::sort(faces.begin(), faces.end());
  grid.neighbours.assign(grid.tets.size(), {-1, -1, -1, -1});
  for (std::size_t k = 0; k + 1 < faces.size(); ++k) {
    const auto &a = faces[k], &b = faces[k + 1];
    if (!std::equal(a.begin(), a.begin() + 3, b.begin())) continue;
    grid.neighbours[a[3]][a[4]] = b[3];
    grid.neighbours[b[3]][b[4]] = a[3];
  }
  return grid;
}

/// Calls f(item, face, neighbour) for each face between items of two parts, once from each side.
template <class F>
void for_each_cut(const Grid& grid, const std::vector<std::int32_t>& labels, F&& f) {
  for (std::size_t i = 0; i < labels.size(); ++i)
    for (int face = 0; face < 4; ++face)
      if (const std::int32_t j = grid.neighbours[i][face]; j >= 0 && labels[j] != labels[i])
        f(static_cast<std::int32_t>(i), face, j);
}

}  // namespace cavea::testing
