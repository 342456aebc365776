#pragma once
#include <cstdint>
#include <vector>

#include "cavea/mesh/tet_mesh.h"
#include "cavea/pass/cycle.h"

namespace cavea {

/// Cavities that the interfaces of the last rounds have blocked, and what was done about them.
struct ResidualCount {
  std::int64_t before = 0;   ///< tets that waited, after the phases and after each mending
  std::int64_t after = 0;    ///< tets that still do at the end
  std::int64_t regions = 0;  ///< run as small parts
  std::int64_t changes = 0;  ///< operations accepted in them
  int colors = 0;            ///< most that a conflict graph of regions took
  int batches = 0;           ///< of regions free of conflicts, run one after the other

  /// Of a later time.
  ResidualCount& operator+=(const ResidualCount& next);
};

/// Tets to which an operator said kFrozen, for the interface of a part, when they were last asked.
std::int64_t count_blocked(const TetMesh& mesh);

/// Asks what the rounds' interfaces have blocked, and that alone, until nothing is. Clusters of
/// blocked tets with layers of others around them are regions; those that share no tet run at the
/// same time, as small parts, colour by colour of their conflict graph. This may block tets at the
/// rims of regions, which the next pass asks in larger ones; where that goes to and fro, regions
/// that conflict are joined. The result has no holes and does not depend on the number of threads.
/// \param part_of_tet by tet, kept in step: what is new has the part of what it replaces
/// \param verdicts gets those of the operators, too
/// \pre no holes \throw Cancelled
ResidualCount run_residual(TetMesh& mesh, const SurfaceModel& surface,
                           const CycleSettings& settings, std::vector<std::int32_t>& part_of_tet,
                           VerdictTable& verdicts);

}  // namespace cavea
