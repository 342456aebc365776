#pragma once
#include <vector>

#include "cavea/operator/surface_merge.h"

namespace cavea {

/// Where two surface vertices of tet t could meet: in the middle between them or at one of them.
std::vector<Junction> junctions_of_vertices(const TetMesh& mesh, TetId t);

/// Where what is at sharp surface triangles on two or more vertices of tet t could meet: the curves
/// along two sides of a tip run together up to a place on its bisector; the top of a flat cap and
/// the curve below it join at one of them or between.
std::vector<Junction> junctions_in_triangles(OperatorContext& context, TetId t);

/// A vertex of which something would be moved, and how far.
struct Moved {
  VertexId vertex = kNone;
  double distance = 0;
};

/// What a junction moves: its vertices, and the ends of its edges by the distance from these.
std::vector<Moved> moved_by(const TetMesh& mesh, const Junction& junction);

}  // namespace cavea
