#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include "cavea/base/buckets.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// The mean length of some of the edges at each vertex, 0 where there are none; the same bits at
/// any number of threads. `edges_of(t, f)` calls f(a, b) for the edges of tet t that count, the
/// same ones each time; an edge counts once, however many tets name it.
template <class EdgesOf>
std::vector<float> mean_lengths(const TetMesh& mesh, EdgesOf&& edges_of) {
  Buckets ends(mesh.tets.size(), mesh.points.size(), [&](std::size_t t, auto&& put) {
    if (!mesh.tet_alive(TetId(t))) return;
    edges_of(TetId(t), [&](VertexId a, VertexId b) {
      put(a, std::uint32_t(b));
      put(b, std::uint32_t(a));
    });
  });
  std::vector<float> means(mesh.points.size(), 0);
  parallel_for(means.size(), [&](std::size_t v) {
    const auto others = rising_once(ends.of(v));
    double sum = 0;
    for (const std::uint32_t w : others) sum += distance(mesh.points[v], mesh.points[w]);
    if (!others.empty()) means[v] = float(sum / double(others.size()));
  });
  return means;
}

}  // namespace cavea
