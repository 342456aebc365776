#pragma once
#include "cavea/cavity/verdict.h"
#include "cavea/field/size_field.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

struct SeedingOptions {
  double hmin = 0, hmax = 0;  ///< bounds of the wanted sizes
  double hgrad = 1;           ///< infinity for no bound
  double scale = 1;           ///< of what the field asks for
  SizeField field;
};

/// Fills the volume with vertices where the wanted sizes ask for more: those of body-centred cubic
/// lattices whose cells double from level to level, inserted by the Delaunay kernel from the
/// coarsest to the finest. Away from the surface and from changes of size all tets are then alike,
/// and about the best that can be had of one kind: a quality of 0.93. \pre no holes
/// \return the number of vertices
std::int64_t seed_interior(TetMesh& mesh, const SeedingOptions& options, VerdictTable& verdicts);

/// Good tets of conforming lengths need not be asked for anything.
void trust_good_tets(TetMesh& mesh);

}  // namespace cavea
