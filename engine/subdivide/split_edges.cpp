#include "cavea/subdivide/split_edges.h"

#include "cavea/base/buckets.h"
#include "cavea/base/parallel.h"

namespace cavea {
namespace {

/// The larger ends of the edges at each smaller end, once for each tet at the edge.
Buckets all_edges(const TetMesh& mesh) {
  return Buckets(mesh.tets.size(), mesh.points.size(), [&](std::size_t t, auto&& put) {
    const auto& v = mesh.tets[t];
    if (v[0] == kNone) return;
    for (const auto& e : kEdgeVertices)
      put(std::min(v[e[0]], v[e[1]]), static_cast<std::uint32_t>(std::max(v[e[0]], v[e[1]])));
  });
}

}  // namespace

SplitEdges::SplitEdges(const TetMesh& mesh, const SplitTest& split) : surface_(mesh) {
  Buckets edges = all_edges(mesh);
  offsets_.assign(mesh.points.size() + 1, 0);
  parallel_for(mesh.points.size(), [&](std::size_t a) {
    const auto ends = rising_once(edges.of(a));
    // The ends of the edges to be split come to stand first.
    const auto chosen = std::stable_partition(ends.begin(), ends.end(), [&](std::uint32_t b) {
      return split(with_triangle(mesh, VertexId(a), VertexId(b)));
    });
    offsets_[a] = static_cast<std::int32_t>(chosen - ends.begin());
  });
  ends_.resize(static_cast<std::size_t>(exclusive_scan(offsets_)));
  parallel_for(mesh.points.size(), [&](std::size_t a) {
    const std::int32_t begin = offsets_[a];
    for (std::int32_t k = begin; k < offsets_[a + 1]; ++k)
      ends_[k] = {VertexId(a), VertexId(edges.of(a)[k - begin])};
  });
}

MeshEdge SplitEdges::with_triangle(const TetMesh& mesh, VertexId a, VertexId b) const {
  MeshEdge edge{a, b};
  if (const auto uses = surface_.find(mesh, a, b); !uses.empty()) {
    const TriangleEdge first = SurfaceEdges::decode(uses[0]);
    edge.triangle = first.triangle;
    edge.side = first.local;
  }
  return edge;
}

}  // namespace cavea
