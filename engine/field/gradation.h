#pragma once
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Lowers mesh.sizes until |h(p) - h(q)| <= |pq| log(h_grad) on every edge (paper, section 4.2):
/// the largest such sizes below the given ones, whatever the order of work. Parallel. \pre no
/// holes; h_grad >= 1
void limit_gradation(TetMesh& mesh, double h_grad);

}  // namespace cavea
