#pragma once
#include "cavea/operator/context.h"

namespace cavea {

/// Edge swap (paper, section 4.1.3): removes the edge and retriangulates its ring. Of all
/// triangulations of the ring the one with the largest worst quality is found by dynamic
/// programming over the ring. On the surface (a smooth edge) the ring is open and closed by the
/// edge between the third vertices of the two triangles, which becomes the new surface edge. Where
/// that edge is there inside, since one poor tet is all that is between the two triangles, the tet
/// goes. \pre context.shell is the shell of the edge.
Verdict edge_swap(OperatorContext& context, Cavity& cavity);

}  // namespace cavea
