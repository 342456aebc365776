#pragma once
#include <span>

#include "cavea/field/size_regions.h"
#include "cavea/remesh/job.h"
#include "cavea/surface/distance.h"

namespace cavea {

/// A sphere around vertices that has the smallest of their sizes.
SizeSphere spot_over(const TetMesh& mesh, const Vec3& center, std::span<const VertexId> vertices);

/// How fast sizes rise from where they are lowered, as hgrad. Those that are wanted to be uniform
/// are so again after two or three edges: by 1.3 an edge a spot of an eighth has a thousand tets
/// around it whose lengths do not conform.
double steepest_growth(const ResolvedOptions& r);

/// Measures how far the mesh and the ideal surface are from each other, after the caller's last
/// touch, and makes the surface finer where that is too much: what the curvature did not tell.
/// \return the distance at the end
SurfaceDistance measure_and_repair(Job& job);

}  // namespace cavea
