#pragma once
#include <cstdint>
#include <vector>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// One part of a partitioned mesh as a mesh of its own. Its vertices that other parts have too are
/// frozen and come right after its own; faces to other parts are cuts.
struct Part {
  TetMesh mesh;
  std::size_t own_vertices = 0;  ///< local vertices [0, own_vertices) are of this part alone
  std::vector<VertexId> shared_vertices;  ///< whole-mesh ids of the next ones, ascending
  std::size_t shared_triangles = 0;       ///< local triangles [0, ...) have a side in another part
  std::vector<TriangleId> triangle_of;    ///< whole-mesh ids of those
  /// For cut k of this part: the part on its other side and the number of the cut there.
  struct Partner {
    std::int32_t part, cut;
  };
  std::vector<Partner> partners;
};

/// Takes a mesh apart by a label in [0, parts) for each tet. No holes in `mesh`. Parallel over
/// parts; the parts depend on the mesh and the labels alone.
std::vector<Part> extract_parts(const TetMesh& mesh, const std::vector<std::int32_t>& labels,
                                int parts);

/// Puts parts back together, whatever the cycle did inside them: new ids by prefix sums in part
/// order, without holes. Frees the parts. `vertices` and `triangles` are the counts of the whole
/// mesh that the parts were taken from. Vertices on interfaces are tagged kWasInterface, the others
/// not.
TetMesh stitch_parts(std::vector<Part>& parts, std::size_t vertices, std::size_t triangles);

}  // namespace cavea
