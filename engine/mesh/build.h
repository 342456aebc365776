#pragma once
#include <string>
#include <vector>

#include "cavea/mesh/mesh_data.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// What build() repaired on its way, for the warnings of the report.
struct BuildSummary {
  std::int64_t turned_tets = 0;        ///< tets of negative orientation, turned over
  std::int64_t flat_tets = 0;          ///< tets of zero volume, accepted
  std::int64_t peeled_tets = 0;        ///< flat ones taken off the boundary (peel_flat.h)
  std::int64_t unused_vertices = 0;    ///< vertices of no tet, dropped
  std::int64_t made_triangles = 0;     ///< faces of the surface that were not listed
  std::int64_t dropped_triangles = 0;  ///< listed triangles that are no surface face, or twice
  std::int64_t dropped_edges = 0;      ///< listed edges that are no edge of the mesh
  std::vector<std::string> warnings() const;
};

struct BuildOptions {
  /// Keeps listed triangles between tets of one reference as surface, and not only the required
  /// ones. They may end inside the volume; their rims are then features.
  bool keep_internal = false;
};

struct BuildResult {
  TetMesh mesh;
  BuildSummary summary;
  std::vector<std::int32_t> unused_vertices;  ///< those of the lists that were dropped, rising
};

/// Makes a mesh out of lists: adjacency, surface triangles (the exterior boundary and the faces
/// between references; the missing ones are made), their edges' tags and references, required
/// entities and corners, sizes, normals. Vertices keep their order; unused ones are dropped.
/// The long lists become those of the mesh: whoever needs them no more hands them over by move.
/// \throw InputError naming the entity: no tets, repeated vertex in a tet, coordinates not finite,
/// a face in three tets, two tets on the same side of a face, more tets than 32-bit ids can hold,
/// sizes that are no positive floats or not one a vertex.
BuildResult build(MeshData data, const BuildOptions& options = {});

/// Links all faces of mesh.tets to each other: sets links, vertex_tets and qualities; faces that no
/// second tet shares are left unset. Holes are skipped. A flat tet is linked whichever way it is
/// oriented.
/// \pre no tet is of negative volume.
/// \throw InputError as build() does, numbering the tets of `mesh` from one.
void link_faces(TetMesh& mesh);

/// Finds the faces that the surface triangles cover, by their vertices, and sets the triangles'
/// sides (of an interface the smaller reference first) and the faces' links. Turns triangles over,
/// with their edges' tags, that are not counter-clockwise from outside of sides[0]. Only v need be
/// right in a living triangle; the rest of it is kept.
/// \pre faces that triangles cover are unset or linked to a tet.
/// \throw InternalError a triangle that covers no face, more than two, two of one reference
/// although it is not tagged as internal (or two although it is), or the same as another.
void attach_triangles(TetMesh& mesh);

/// The lists of a mesh without holes, for a writer: with Ridges, Corners and required entities out
/// of the tags, and the sizes where they are known.
MeshData to_data(const TetMesh& mesh);
/// The same out of a mesh that is needed no more: the long lists are taken over.
MeshData to_data(TetMesh&& mesh);

}  // namespace cavea
