#pragma once
#include <atomic>
#include <functional>
#include <limits>

#include "cavea/cavity/verdict.h"
#include "cavea/geometry/lattice.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Points are wanted where their lattice's cells are at least this many wanted sizes.
inline constexpr double kFinestCell = 0.75;

/// The wanted size at a point, given a bound that the vertices around it impose.
using SeedSize = std::function<double(const Vec3& point, double bound)>;

struct SeedOptions {
  Lattice lattice;
  double growth = 0;  ///< of the wanted size with the distance: log(hgrad)
  double largest = std::numeric_limits<double>::infinity();  ///< bounds all wanted sizes
  /// Called from many threads; empty: the bound itself, which only rises away from the vertices.
  SeedSize size;
  const std::atomic<bool>* cancel = nullptr;
};

/// Inserts the points of one level of a body-centred cubic lattice inside the volume where the
/// wanted size asks for them, and nothing is near. Parallel: blocks of space that are apart are
/// worked on at the same time. Leaves holes of ids.
/// \return verdicts of the insertions \throw Cancelled
VerdictTable seed_level(TetMesh& mesh, const SeedOptions& options, int level, int coarsest);

}  // namespace cavea
