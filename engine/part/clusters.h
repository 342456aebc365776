#pragma once
#include <vector>

#include "cavea/mesh/tet_mesh.h"
#include "cavea/partition/graph.h"

namespace cavea {

using TetList = std::vector<TetId>;

/// Groups tets that hang together by vertices, at most `most` in a group.
std::vector<TetList> clusters_of(const TetMesh& mesh, const TetList& tets, std::size_t most);

/// Lists are neighbours in the graph if they share a tet. \pre none names a tet twice
Graph conflicts_of(const std::vector<TetList>& lists);

/// The lists of each connected component of their conflicts, one after the other.
std::vector<TetList> joined(std::vector<TetList> lists, const Graph& conflicts);

}  // namespace cavea
