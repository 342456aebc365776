#pragma once
#include "cavea/mesh/tet_mesh.h"
#include "cavea/remesh/size_law.h"

namespace cavea {

/// Cells of this many wanted sizes give edges of 1.08 and 0.94 of them: one on the average.
inline constexpr double kLatticeCell = 1.08;

/// The cell of a lattice that fits the wanted sizes, where lattices of cells that double from level
/// to level fill what wants sizes of 2/3 to 4/3 of their cell: the one for which each of them has
/// about as many points as the sizes ask for, and sizes are near those that it is made for. Where
/// they are uniform that is kLatticeCell of them; where they only rise from a smallest one on, one
/// whose zone begins there, which took a sixth fewer tets than another one.
/// \return of the level that is nearest to `hmax` \pre no holes
double fitting_cell(const TetMesh& mesh, const SizeLaw& law);

}  // namespace cavea
