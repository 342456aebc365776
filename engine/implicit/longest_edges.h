#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// A set of edges to be bisected such that each is the longest edge of all tets at it: each tet has
/// one of them at most, and is cut in two.
struct Bisection {
  std::vector<std::pair<VertexId, VertexId>> edges;  ///< (a, b), a < b, rising
  std::vector<char> of_tet;                          ///< whether the tet has one of them
};

/// The edges to bisect so that the wanted tets are divided as soon as can be: the longest edge of a
/// tet, or, where it is not that of another tet at it, the longest one of that tet, and so on
/// (Rivara 1984). Edges that are required, of a required tet, or between vertices in which the
/// volume touches itself are never among them.
Bisection choose_longest_edges(const TetMesh& mesh, std::vector<char> wanted);

/// The place in kEdgeVertices of a tet's longest edge; of equal ones that of the largest vertices.
int longest_edge(const TetMesh& mesh, TetId t);

}  // namespace cavea
