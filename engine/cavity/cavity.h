#pragma once
#include <vector>

#include "cavea/mesh/new_vertex.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// A tet that refills a cavity.
struct NewTet {
  std::array<VertexId, 4> v;
  std::int32_t ref = 0;
  float quality = 0;
};

/// A local operation as a value: the tets and surface triangles that go and those that come.
/// Operators fill it and read the mesh; only MeshEditor::commit() writes.
///
/// The new tets fill exactly the hole of the removed ones; their outer faces match those of the
/// hole, except where removed triangles are replaced by new ones. New triangles need v, ref, patch,
/// tags; their sides follow.
struct Cavity {
  std::vector<TetId> removed_tets;
  std::vector<NewTet> tets;
  /// What is behind the faces of the new tets, if not empty: others of them, by their place in
  /// `tets`, but for the last face, which stands on that of a removed tet. So commit() need not
  /// find out. Only for cavities without triangles of their own.
  std::vector<std::array<FaceLink, 4>> links;
  std::vector<TriangleId> removed_triangles;
  std::vector<Triangle> triangles;
  std::vector<VertexId> removed_vertices;
  bool inserts_vertex = false;  ///< `vertex` gets the id that MeshEditor::next_vertex() told
  NewVertex vertex;

  void clear() {
    removed_tets.clear();
    tets.clear();
    links.clear();
    removed_triangles.clear();
    triangles.clear();
    removed_vertices.clear();
    inserts_vertex = false;
  }
};

}  // namespace cavea
