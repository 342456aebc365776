#pragma once
#include "cavea/operator/context.h"

namespace cavea {

/// A last resort for bad tets: stars the shell of an interior edge from a new vertex, put where the
/// worst quality of the star is largest (an edge split whose vertex need not lie on the edge; the
/// smallest of the growing cavities of Marot and Remacle 2020). Accepted where that raises the
/// worst quality of the shell. \pre context.shell is the shell of the edge.
Verdict edge_star(OperatorContext& context, VertexId vertex_id, Cavity& cavity);

}  // namespace cavea
