#pragma once
#include "cavea/operator/context.h"

namespace cavea {

/// What is known of an edge on the surface.
struct EdgeOnSurface {
  TriangleId triangle = kNone;  ///< one of those at it; kNone for an edge inside the volume
  int side = 0;                 ///< opposite this corner of it
  Tag tags = 0;
  std::int32_t ref = 0;
};

/// Whether a vertex may come onto the edge of context.shell; `edge` is what is known of it then.
Verdict may_split(const OperatorContext& context, EdgeOnSurface& edge);

/// Edge split (paper, section 4.1.1): a vertex in the middle of an edge, on the ideal surface where
/// the edge is on the surface, on the feature curve where it is on one. Where the place on the
/// surface cannot be reached without inverting a tet, the vertex stops half way, or stays on the
/// straight edge and is tagged kOffSurface. \pre context.shell is the shell of the edge.
/// \param for_fit the edge is too far from the surface, whatever its length
Verdict edge_split(OperatorContext& context, VertexId vertex_id, Cavity& cavity,
                   bool for_fit = false);

}  // namespace cavea
