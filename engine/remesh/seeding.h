#pragma once
#include <atomic>

#include "cavea/cavity/verdict.h"
#include "cavea/mesh/tet_mesh.h"
#include "cavea/remesh/size_law.h"

namespace cavea {

/// Fills the volume with vertices where the wanted sizes ask for more: those of body-centred cubic
/// lattices whose cells double from level to level, inserted by the Delaunay kernel from the
/// coarsest to the finest. Away from the surface and from changes of size all tets are then alike,
/// and about the best that can be had of one kind: a quality of 0.93. Those that are too near to
/// vertices tagged kReplaceable take their place; the tags are gone after. \pre no holes
/// \return the number of vertices \throw Cancelled
std::int64_t seed_interior(TetMesh& mesh, const SizeLaw& law, const std::atomic<bool>* cancel,
                           VerdictTable& verdicts);

/// Tags the vertices inside of whose tets fewer than half are good and of conforming lengths: what
/// seeds would leave between such vertices costs more than seeds in place of them. \pre no holes
void tag_replaceable(TetMesh& mesh);

/// Good tets of conforming lengths need not be asked for anything.
void trust_good_tets(TetMesh& mesh);

}  // namespace cavea
