#pragma once
#include "cavea/mesh/tet_mesh.h"
#include "cavea/part/region.h"
#include "cavea/pass/cycle.h"

namespace cavea {

/// What parts are cut from, and how large they are.
struct PartSize {
  std::int64_t tets_per_part = 0;  ///< what a part is to have; 0: what suits the mesh
  /// A mesh of fewer tets is one part: the interfaces would be most of it. Not asked where the
  /// tets of a part are given.
  std::int64_t one_part = 12000;
  /// Whether the mesh is cut into few parts, each large: what touches a vertex of the interface is
  /// not mended, and hubs of needles have hundreds of tets.
  bool few = false;
  /// Of tets around those that are asked, which are in the parts, too.
  int layers = kLayers;
};

/// Number of parts for a mesh of so many tets: never a function of the threads.
int part_count(std::int64_t tets, const PartSize& size = {});

struct RoundResult {
  CycleResult cycle;
  int parts = 1;
};

/// One parallel round: partitions the tets that are asked something and those around them, runs the
/// cycle on every part with its interface frozen, and stitches the parts; the rest is idle. Faces
/// that were interface in the round before are spared by the cut, so that what was frozen moves
/// into the interior. `settings.most_tets` is per part. The result has no holes and does not depend
/// on the number of threads. \param part_of_tet if not null, the part that each tet of the result
/// came from, kIdle for those of none. \throw Cancelled
RoundResult run_round(TetMesh& mesh, const SurfaceModel& surface, const CycleSettings& settings,
                      std::vector<std::int32_t>* part_of_tet = nullptr, const PartSize& size = {});

}  // namespace cavea
