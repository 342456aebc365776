#pragma once
#include <functional>
#include <vector>

#include "cavea/mesh/tet_mesh.h"
#include "cavea/surface/edges.h"

namespace cavea {

/// The fold at an edge of two triangles, in radians. Called from many threads.
using FoldAngle = std::function<double(TriangleId, TriangleId)>;

/// Tags the edges that go on from the ends of ridges. Where two round walls cut each other, the
/// angle between them falls along their crease, often to nothing, and a ridge that stopped where an
/// angle is passed would leave the rest to the smooth surface: round within the bound on its bulge,
/// creased beyond, and sharper the finer the mesh is. So a ridge is followed as long as the edge
/// ahead folds by more than `least_angle` (radians) and stands out from the folds around it.
/// \pre ridges are tagged at the edges \param taken says which edges may be ridges, if set
void continue_ridges(TetMesh& mesh, const std::vector<EdgeSide>& sides, const FoldAngle& fold,
                     double least_angle, const std::function<bool(VertexId, VertexId)>& taken);

}  // namespace cavea
