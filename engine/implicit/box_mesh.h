#pragma once
#include "cavea/geometry/box.h"
#include "cavea/mesh/mesh_data.h"

namespace cavea {

/// A box in about `cells` nearly cubic cells, each in six tets around its main diagonal (Kuhn).
/// Bisected at their longest edges, such tets stay of three shapes (Maubach 1995), as long as the
/// cells are cubes. All tets are of reference 1; the box's edges are ridges.
/// \throw OptionError if the box has no volume or is not finite, or the cells are more than ids
MeshData box_mesh(const Box& box, double cells = 512);

}  // namespace cavea
