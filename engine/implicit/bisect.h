#pragma once
#include "cavea/implicit/longest_edges.h"

namespace cavea {

/// Cuts the tets of a set of edges in two, in place: the work goes with them, not with the mesh.
/// What is part of another stands in its place, with the smaller end of the edge; the other half is
/// new. New vertices, tets and triangles come last: in the order of the edges, of the tets halved,
/// and of these tets' faces. Halves inherit as subdivide() says.
/// \pre the bisection is choose_longest_edges() of this mesh, as refine_near() takes it
/// \throw InputError when the result has more tets than ids can name
void bisect(TetMesh& mesh, const Bisection& bisection);

}  // namespace cavea
