#pragma once
#include <functional>

#include "cavea/mesh/build.h"
#include "cavea/subdivide/subdivide.h"
#include "support/expect.h"
#include "support/meshes.h"

namespace cavea::test {

/// A coin for each edge that depends on its ends alone: heads with the given probability.
inline SplitTest coin(std::uint64_t seed, double probability) {
  return [=](const MeshEdge& e) {
    return Random(seed * 1000003 + std::uint64_t(e.a) * 65537 + std::uint64_t(e.b)).unit() <
           probability;
  };
}

inline bool every_edge(const MeshEdge&) { return true; }

inline Placement straight(const TetMesh& mesh) {
  return [&mesh](const MeshEdge& e) { return straight_midpoint(mesh, e); };
}

}  // namespace cavea::test
