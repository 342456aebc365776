#pragma once
#include <cstdint>
#include <vector>

#include "cavea/mesh/tet_mesh.h"
#include "cavea/pass/cycle.h"

namespace cavea {

/// What became of the cavities that the last round's interfaces blocked.
struct ResidualResult {
  CycleResult cycle;
  std::int64_t before = 0;   ///< blocked tets that the rounds left
  std::int64_t after = 0;    ///< and that are left now
  int passes = 0;            ///< times that what was blocked then was grouped and coloured
  int colors = 0;            ///< most of one pass
  int batches = 0;           ///< run one after the other, over all passes
  std::int64_t regions = 0;  ///< run as small parts, over all batches
};

/// Tets to which an operator said kFrozen, for the interface of a part, when they were last asked.
std::int64_t count_blocked(const TetMesh& mesh);

/// Asks what the rounds' interfaces have blocked, and that alone, until nothing is. Clusters of
/// blocked tets with layers of others around them are regions; those that share no tet run at the
/// same time, as small parts, colour by colour of their conflict graph. This may block tets at the
/// rims of regions, which the next pass asks in larger ones. The result has no holes and does not
/// depend on the number of threads.
/// \param part_of_tet by tet, kept in step: what is new has the part of what it replaces
/// \pre no holes \throw Cancelled
ResidualResult run_residual(TetMesh& mesh, const SurfaceModel& surface,
                            const CycleSettings& settings, std::vector<std::int32_t>& part_of_tet);

}  // namespace cavea
