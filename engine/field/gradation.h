#pragma once
#include <vector>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Sizes that the gradation may not change, and how those around follow them.
struct ImposedSizes {
  std::vector<float> sizes;  ///< by vertex, 0 where none is imposed; or empty
  double h_grad = 1;         ///< of edges at imposed sizes; >= 1
};

/// Lowers mesh.sizes until |h(p) - h(q)| <= |pq| log(h_grad) on every edge (paper, section 4.2):
/// the largest such sizes below the given ones, whatever the order of work. Imposed sizes are set
/// first; around them sizes are raised, too, where imposed.h_grad asks for it, and not lowered
/// again below that. Parallel. \pre no holes; h_grad >= 1, infinity for no bound
void limit_gradation(TetMesh& mesh, double h_grad, const ImposedSizes& imposed = {});

/// Lowers only what is too large for sizes that are smaller than they were `before`, or for what is
/// lowered so: the others met the bound, or nearly. No size becomes larger than before. Parallel.
void limit_gradation_of_lowered(TetMesh& mesh, double h_grad, const std::vector<float>& before,
                                const ImposedSizes& imposed = {});

}  // namespace cavea
