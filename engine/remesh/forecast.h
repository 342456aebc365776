#pragma once
#include "cavea/mesh/tet_mesh.h"
#include "cavea/remesh/size_law.h"

namespace cavea {

/// About how many tets a mesh of the wanted sizes has: the volume over that of regular tets, whose
/// edges are as long as the law says at each place. Within a quarter where the mesh's vertices know
/// their sizes; what refinement will find, as curved places that no vertex stands on, is not in it.
/// \pre no holes
double forecast_tets(const TetMesh& mesh, const SizeLaw& law);

/// The same from a sample of a large mesh: its tets are taken to be as those looked at.
double forecast_about(const TetMesh& mesh, const SizeLaw& law);

/// A bound of it from above, which costs next to nothing.
double most_tets(const TetMesh& mesh, const SizeLaw& law);

/// Refuses what no mesh or no memory can hold, before it is allocated.
/// \param bytes there may be
/// \throw MemoryError with the estimate
void refuse_too_large(const TetMesh& mesh, const SizeLaw& law, std::int64_t bytes);

/// The same of a mesh that has grown beyond what was foreseen.
void refuse_too_large(const TetMesh& mesh, std::int64_t bytes);

}  // namespace cavea
