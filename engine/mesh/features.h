#pragma once
#include <vector>

#include "cavea/mesh/build.h"

namespace cavea {

/// The tags that the vertices have by the surface triangles that they are on and those triangles'
/// edges; 0 for a vertex inside.
std::vector<Tag> surface_vertex_tags(const TetMesh& mesh);

/// Sets the tags of the surface's edges and of all vertices, and required tets, by the lists of
/// `data` and by the surface itself: edges between references, edges of more or fewer than two
/// triangles. Triangles hold their own tags already.
/// \param new_vertex the mesh's vertex of each vertex of data, kNone for the unused
/// \param summary counts the edges that are dropped
void tag_features(TetMesh& mesh, const MeshData& data, const std::vector<VertexId>& new_vertex,
                  BuildSummary& summary);

}  // namespace cavea
