#pragma once
#include "cavea/operator/context.h"
#include "cavea/operator/junction.h"

namespace cavea {

/// The very last resort for bad tets at what of the surface is nearer to each other than the
/// tolerance, which so cannot tell it apart. The tets around what meets in the junction are
/// replaced by the star of the new vertex, and so are the surface triangles there: curves join,
/// shorten or part. What edges of the surface came to the vertices, or are cut, comes to the new
/// one with all its tags; on a curve it is a corner. Accepted where that raises the worst quality
/// by enough; or, if there is one vertex less then, about keeps it and leaves fewer tets below
/// `sound`; or, if only edges are cut, keeps what mending can go on from; and where the new surface
/// stays within the tolerance (check_refit()). Refused for what is required or a given corner or
/// ridge, and where the last of a reference would go. How far curves move is for the caller to
/// bound.
Verdict surface_merge(OperatorContext& context, const Junction& junction, double sound,
                      VertexId vertex_id, Cavity& cavity);

}  // namespace cavea
