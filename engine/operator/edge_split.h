#pragma once
#include "cavea/operator/context.h"

namespace cavea {

/// Edge split (paper, section 4.1.1): a vertex in the middle of an edge, on the ideal surface where
/// the edge is on the surface, on the feature curve where it is on one. Where the place on the
/// surface cannot be reached without inverting a tet, the vertex stops half way, or stays on the
/// straight edge and is tagged kOffSurface. \pre context.shell is the shell of the edge.
Verdict edge_split(OperatorContext& context, VertexId vertex_id, Cavity& cavity);

}  // namespace cavea
