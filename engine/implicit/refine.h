#pragma once
#include <span>

#include "cavea/implicit/level_set.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

struct RefineOptions {
  double tolerance = 0;  ///< how far the cut's triangles may be from the zero; positive
  double shortest = 0;   ///< tets with no longer edge are not divided; positive
};

/// Divides tets near the level set until a cut along it is as near to it as asked and misses no
/// sheet of it that the zeros tell of. Tets are bisected at their longest edges, all at once and
/// conforming: those that are in the way of another's are bisected first, so that sizes rise
/// gradually away from the level set. Edges and tets that are required stay.
/// \param level_set with a gradient \param zeros of the level set; one or more on each piece of it
/// that is to be found \pre mesh has no holes, and no edge in which it touches
/// itself unless classify_features() has tagged it \returns the number of passes
/// \throw InputError when the result has more tets or vertices than ids can name
int refine_near(TetMesh& mesh, const LevelSet& level_set, std::span<const OrientedPoint> zeros,
                const RefineOptions& options);

}  // namespace cavea
