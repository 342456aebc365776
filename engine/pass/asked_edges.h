#pragma once
#include <array>

#include "cavea/geometry/length_block.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

inline bool is_asked_for_lengths(const TetMesh& m, std::size_t t) {
  return (m.tet_flags[t] & tet_flag::kAskLength) && m.tet_alive(TetId(t));
}

/// Calls f(tet, a, b) for the edges of tets that are asked for lengths, tet by tet in ascending
/// order, but for those that `perhaps`, of a block of tets, leaves out.
template <class Perhaps, class F>
void for_each_asked_edge(const TetMesh& m, Perhaps&& perhaps, F&& f) {
  LengthBlock block;
  std::array<TetId, LengthBlock::kMost> ids;
  const auto flush = [&] {
    const LengthBlock::Edges& edges = perhaps(block);
    for (std::size_t i = 0; i < block.size(); ++i)
      for (std::size_t e = 0; edges[i] >> e; ++e)
        if (edges[i] >> e & 1) {
          const auto& v = m.tets[ids[i]];
          f(ids[i], v[kEdgeVertices[e][0]], v[kEdgeVertices[e][1]]);
        }
    block.clear();
  };
  for (std::size_t t = 0; t < m.tets.size(); ++t) {
    if (!is_asked_for_lengths(m, t)) continue;
    const auto& v = m.tets[t];
    ids[block.size()] = TetId(t);
    block.add(m.corners(TetId(t)), {m.sizes[v[0]], m.sizes[v[1]], m.sizes[v[2]], m.sizes[v[3]]});
    if (block.full()) flush();
  }
  flush();
}

}  // namespace cavea
