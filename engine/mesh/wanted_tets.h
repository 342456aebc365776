#pragma once
#include <cmath>

#include "cavea/base/parallel.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Regular tets of edge length h that have a volume.
inline double regular_tets(double volume, double h) {
  constexpr double kRegularVolume = 0.11785113;  // of edge 1: 1 / (6 sqrt 2)
  return volume / (kRegularVolume * h * h * h);
}

/// The same of the wanted edge length in tet t. \pre its sizes are known
inline double wanted_tets(const TetMesh& m, TetId t) {
  const auto [a, b, c, d] = m.corners(t);
  double h = 0;
  for (VertexId v : m.tets[t]) h += m.sizes[v] / 4;
  return regular_tets(std::abs(volume6(a, b, c, d)) / 6, h);
}

/// The same of all tets. \pre no holes
inline double wanted_tets(const TetMesh& m) {
  return parallel_reduce(
      m.tets.size(), 0.0,
      [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t t = begin; t < end; ++t) sum += wanted_tets(m, TetId(t));
        return sum;
      },
      [](double a, double b) { return a + b; });
}

}  // namespace cavea
