#pragma once
#include <string>
#include <vector>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Everything that is wrong with a mesh; empty when it is sound.
struct CheckResult {
  std::int64_t count = 0;  ///< of all violations
  /// The first few, each naming its entity by its id in the mesh, counted from zero.
  std::vector<std::string> examples;

  bool sound() const { return count == 0; }
  std::string message() const;
};

struct CheckOptions {
  bool allow_flat_tets = false;  ///< for an input that has not been remeshed yet
};

/// Verifies every invariant of the data structure and the mesh: links mutual and on the same three
/// vertices, orientations positive, triangles exactly the exterior boundary, the interfaces
/// between references and what is tagged as internal, sides and vertex order of triangles,
/// vertex_tets, tags of surface vertices, edge tags alike on all triangles of an edge, stored
/// qualities. Holes are skipped. In a part, faces may be cuts, each cut number used once, and what
/// depends on triangles of other parts is not asked of frozen vertices. Where an index is out of
/// range, nothing else is looked at.
CheckResult check(const TetMesh& mesh, const CheckOptions& options = {});

}  // namespace cavea
