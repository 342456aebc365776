#pragma once
#include <string>
#include <vector>

#include "cavea/mesh/mesh_data.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// What build() repaired on its way, for the warnings of the report.
struct BuildSummary {
  std::int64_t turned_tets = 0;      ///< tets of negative orientation, turned over
  std::int64_t flat_tets = 0;        ///< tets of zero volume, accepted
  std::int64_t unused_vertices = 0;  ///< vertices of no tet, dropped
  std::int64_t made_triangles = 0;   ///< faces of the surface that were not listed
  std::int64_t dropped_triangles = 0;  ///< listed triangles that are no surface face, or twice
  std::int64_t dropped_edges = 0;      ///< listed edges that are no edge of the mesh
  std::vector<std::string> warnings() const;
};

struct BuildResult {
  TetMesh mesh;
  BuildSummary summary;
};

/// Makes a mesh out of lists: adjacency, surface triangles (the exterior boundary and the faces
/// between references; the missing ones are made), their edges' tags and references, required
/// entities and corners. Vertices keep their order; unused ones are dropped.
/// \throw InputError naming the entity: no tets, repeated vertex in a tet, coordinates not finite, a
/// face in three tets, two tets on the same side of a face, more tets than 32-bit ids can hold.
BuildResult build(const MeshData& data);

/// Links all faces of mesh.tets to each other: sets links, vertex_tets and qualities; faces that no
/// second tet shares are left unset. \throw InputError as build() does.
void link_faces(TetMesh& mesh);

/// The lists of a mesh without holes, for a writer: with Ridges, Corners and required entities out of
/// the tags, and the sizes where they are known.
MeshData to_data(const TetMesh& mesh);

}  // namespace cavea
