#pragma once
#include <optional>
#include <vector>

#include "cavea/part/extract.h"
#include "cavea/remesh/job.h"

namespace cavea {

/// A way out of a place where no single operation gains: one edge beside a poor tet is split or
/// collapsed whatever that makes of the tets there, and all around is mended. Of all edges at the
/// tet's vertices that is tried on copies of what is around, and the one that leaves the fewest
/// poor tets is taken; if none leads on, a second step is tried after each of the best. So two
/// walls that meet at a small angle come to have as many vertices along their common edge, which
/// takes a vertex more, or less, on one of them and moves of the others.
class Detour {
 public:
  /// Looks for one. \param quality that poor tets are below \pre no holes; t is not required
  Detour(Job& job, TetId t, double quality);

  /// Whether it leads to fewer poor tets.
  bool leads_on() const { return best_.has_value(); }
  /// Takes it. Ids of tets change. \pre leads_on(), the mesh is as it was
  void take() &&;

 private:
  Job& job_;
  std::vector<Part> part_;  ///< one: what is around the tet
  std::optional<TetMesh> best_;
};

}  // namespace cavea
