#pragma once
#include <vector>

#include "cavea/field/size_field.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// At each vertex the mean length of its edges; 0 where there are none.
std::vector<float> mean_edge_lengths(const TetMesh& mesh);

/// The sizes that a mesh has: at each vertex the mean length of its edges, between them as
/// MeshSizeField says. A snapshot.
SizeField own_sizes(TetMesh mesh);

/// The sizes that required entities have, which no remeshing changes: at each vertex the mean
/// length of its required edges (those of required triangles and tets too, and what runs inside
/// between two such ends: it is not touched either), 0 where it has none;
/// empty if no vertex has any. \param whole_surface counts all of the surface as required
std::vector<float> required_sizes(const TetMesh& mesh, bool whole_surface = false);

}  // namespace cavea
