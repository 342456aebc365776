#pragma once
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// A copy that many threads make: most of the time goes into memory that is touched first.
TetMesh copy_of(const TetMesh& mesh);

/// The structure of a mesh is where its vertices are, its tets and how they are linked, with their
/// references and qualities: nine tenths of it. The rest are labels: what an analysis of the
/// surface, of wanted sizes and of what is to be asked finds.
void copy_structure(const TetMesh& from, TetMesh& to);
void move_structure(TetMesh& from, TetMesh& to);
void copy_labels(const TetMesh& from, TetMesh& to);

}  // namespace cavea
