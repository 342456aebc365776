#pragma once
#include <cstdint>
#include <vector>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Label of tets that are in no part and stay in the whole mesh as they are.
inline constexpr std::int32_t kIdle = -1;

/// One part of a partitioned mesh as a mesh of its own. Its vertices that others have too are
/// frozen and come right after its own; faces to other parts and to idle tets are cuts.
struct Part {
  TetMesh mesh;
  std::vector<VertexId> own_vertices;     ///< whole-mesh ids of the first local vertices
  std::vector<VertexId> shared_vertices;  ///< those of the next ones, ascending
  std::vector<TetId> tets;                ///< whole-mesh ids of the local tets
  std::vector<TriangleId> triangles;      ///< those of the local triangles
  std::size_t shared_triangles = 0;       ///< the first of them have a side outside of the part
  /// For cut k of this part: the part on its other side and the number of the cut there, or kIdle
  /// and the code of the face there.
  struct Partner {
    std::int32_t part, cut;
  };
  std::vector<Partner> partners;
};

/// Copies the labelled tets of a mesh, by a label in [0, parts) or kIdle for each, as for holes.
/// The mesh may be a part itself. Parallel over parts, which depend on the mesh and the labels
/// alone.
std::vector<Part> extract_parts(const TetMesh& mesh, const std::vector<std::int32_t>& labels,
                                int parts);

/// Puts parts back in the mesh that they were extracted from, whatever the cycle did inside them:
/// what still lives keeps its id, what is new gets ids of what is gone, part by part, then further
/// ones. Leaves holes; frees the parts. Vertices on interfaces are tagged kWasInterface, others of
/// the parts not. \param part_of_tet gets the part of each tet of a part, whatever is there for
/// others
void stitch_parts(TetMesh& mesh, std::vector<Part>& parts, std::vector<std::int32_t>& part_of_tet);

}  // namespace cavea
