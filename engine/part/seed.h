#pragma once
#include <functional>

#include "cavea/cavity/verdict.h"
#include "cavea/geometry/lattice.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// The wanted size at a point, given a bound that the vertices around it impose.
using SeedSize = std::function<double(const Vec3& point, double bound)>;

struct SeedOptions {
  Lattice lattice;
  double growth = 0;  ///< of the wanted size with the distance: log(hgrad)
  SeedSize size;      ///< called from many threads; empty: the bound
};

/// Inserts the points of one level of a body-centred cubic lattice inside the volume where the
/// wanted size asks for them, and nothing is near. Parallel: blocks of space that are apart are
/// worked on at the same time. Leaves holes of ids.
/// \return verdicts of the insertions
VerdictTable seed_level(TetMesh& mesh, const SeedOptions& options, int level, int coarsest);

}  // namespace cavea
