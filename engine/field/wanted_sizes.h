#pragma once
#include "cavea/field/size_field.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

struct SizeBounds {
  double hmin = 0, hmax = 0, hgrad = 1;
};

/// Sets mesh.sizes (paper, section 4.2): the smaller of `curvature_size` (of surface vertices, by
/// anchor) and the user's field, then the bounds, then the gradation. \pre no holes
/// \throw InputError when the user's field gives a size that is not a positive number
void set_wanted_sizes(TetMesh& mesh, const std::function<double(const Anchor&)>& curvature_size,
                      const SizeField& field, const SizeBounds& bounds);

}  // namespace cavea
