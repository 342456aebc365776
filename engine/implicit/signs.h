#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// The least share of an edge between a cut and the edge's ends. Where the zero of the values is
/// nearer to a vertex, the vertex is put on the interface, or, where that would pinch it, the cut
/// is put this far from the vertex: the interface moves by a hundredth of an edge at most, less
/// than the P1 interpolation is off, and no tet of the cut mesh is flatter than by that share.
inline constexpr double kLeastCutShare = 0.01;

/// By vertex: -1 inside (negative value), 1 outside, 0 on the interface. A vertex is on the
/// interface where the level set passes nearer than kLeastCutShare of an edge, but not where the
/// inside or the outside at the vertex would then fall into pieces that no face joins.
/// \param values by vertex, finite \param split by tet, whether it is to be cut: others have no
/// say; empty: all are
std::vector<std::int8_t> cut_signs(const TetMesh& mesh, std::span<const double> values,
                                   std::span<const char> split = {});

/// The vertices that the level set passes so near to, but that would pinch it if they were on it.
std::vector<VertexId> pinching_vertices(const TetMesh& mesh, std::span<const double> values,
                                        std::span<const char> split = {});

/// The side of a tet without vertices of both signs: of its vertices off the interface, or, where
/// there are none, of the sum of its values.
int side_of_tet(const std::array<VertexId, 4>& tet, std::span<const std::int8_t> signs,
                std::span<const double> values);

}  // namespace cavea
