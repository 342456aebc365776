#pragma once
#include <functional>

#include "cavea/mesh/new_vertex.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// An edge of a mesh, with one of the surface triangles at it.
struct MeshEdge {
  VertexId a = kNone, b = kNone;  ///< a < b
  TriangleId triangle = kNone;    ///< the smallest one; kNone for an edge inside the volume
  int side = 0;                   ///< the edge's place in edge_tag and edge_ref of the triangle
};

/// Whether to split an edge; asked once for each edge. Not to be split are edges of required tets
/// and triangles, required edges, and those of a part's cut faces.
using SplitTest = std::function<bool(const MeshEdge&)>;
/// The vertex on a split edge; asked once for each of them.
using Placement = std::function<NewVertex(const MeshEdge&)>;

/// The vertex halfway on the straight edge: the mean of the known sizes, the edge's features and,
/// on the surface, the anchor of its first end as a hint (it stands elsewhere, so place it anew).
NewVertex straight_midpoint(const TetMesh& mesh, const MeshEdge& edge);

/// The share of its volume with straight midpoints (bounded from below by an eighth of the split
/// tet's) that a tet must keep where vertices are put elsewhere: with less it is nearly flat, and
/// hard to repair.
inline constexpr double kLeastVolumeShare = 0.1;

/// The mesh with all edges split at once that `split` wants: every tet with one to six of them is
/// replaced by two to eight, by a pattern that agrees with its neighbours' on their common face.
/// Both callbacks are called from many threads, with ids of `mesh`; the result depends on what they
/// return alone.
///
/// The living vertices come first, in their order, then the new ones by (a, b); tets and surface
/// triangles stand in the place of the one that they are part of. Children inherit reference,
/// patch, tags and flags (those of split tets: and all asks), halves of surface edges their tag and
/// reference; new edges across a triangle have none. Holes are gone; links, vertex_tets and
/// qualities are set.
///
/// A vertex that `place` puts off the straight midpoint is drawn back halfway, at most six times
/// and then wholly, while a tet at it is not certainly positive or keeps less than
/// `least_volume_share` of its volume; it is then tagged kOffSurface. So the children of a tet
/// whose volume is well above the rounding error are certainly positive; those of a flat one are
/// flat or positive, up to rounding.
///
/// \param least_volume_share 0 asks for positive volumes only, as for cuts anywhere along the edges
/// \pre links and triangles are as check() wants them; tets may be flat
/// \throw InputError when the result has more tets or vertices than ids can name
/// \throw InternalError when a cut face of a part is to be split; whatever the callbacks throw
TetMesh subdivide(const TetMesh& mesh, const SplitTest& split, const Placement& place,
                  double least_volume_share = kLeastVolumeShare);

}  // namespace cavea
