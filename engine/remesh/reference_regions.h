#pragma once
#include <map>
#include <vector>

#include "cavea/remesh/attempt.h"
#include "cavea/surface/facet_tree.h"

namespace cavea {

/// What each reference covers of a surface at one time. The surface as a whole may be where it was
/// though a strip between two curves on it, wider than the tolerance, has gone to what is beside.
class ReferenceRegions {
 public:
  explicit ReferenceRegions(const TetMesh& mesh);

  /// Triangles whose middle or a corner is farther than `reach` from all of another mesh that has
  /// their reference; each with the places around it, as far as an operator reaches.
  std::vector<FailedPlace> lost_from(const TetMesh& mesh, double reach) const;

 private:
  std::map<std::int32_t, std::vector<Corners>> triangles_;
};

}  // namespace cavea
