#pragma once
#include <cstdint>
#include <vector>

#include "cavea/partition/graph.h"

namespace cavea {

/// A part for each vertex, in [0, parts): parts of about equal vertex weight (METIS: within 3%
/// where the weights allow it) with little edge weight between them; a part need not be connected.
/// METIS 5.1, multilevel k-way (Karypis and Kumar 1998). Where there are no more vertices than
/// parts, each vertex gets its own and METIS is not asked; nor is it for one part.
///
/// The same graph gives the same labels: the seed is fixed, and calls are serialized by a lock of
/// the process. But METIS draws from the C library's rand(), seeding it itself: it changes the
/// sequence that the host sees, and a host that calls rand() from another thread during a call can
/// change the labels (never their validity).
///
/// \pre graph is symmetric, without loops; weights are positive and their sums fit in 31 bits
/// \throw InternalError when METIS refuses the graph or has no memory
std::vector<std::int32_t> kway(const Graph& graph, int parts);

}  // namespace cavea
