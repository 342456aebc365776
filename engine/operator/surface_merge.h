#pragma once
#include <vector>

#include "cavea/operator/context.h"

namespace cavea {

/// Side k of a surface triangle: the one opposite corner k.
struct SurfaceSide {
  TriangleId triangle = kNone;
  std::size_t k = 0;
};

/// Where parts of the surface are to meet: a new vertex takes the place of some of its vertices,
/// and cuts some of its feature edges.
struct Junction {
  std::vector<VertexId> vertices;
  std::vector<SurfaceSide> edges;
  Vec3 place;
};

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
