#pragma once
#include <atomic>
#include <optional>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

struct ContractionLimits {
  /// Vertices go along edges that are shorter, in the metric of the wanted sizes.
  double short_edge = 0;
  /// No tet that changes has a longer edge afterwards,
  double long_edge = 0;
  /// nor a lower quality; at least kFlat, so that it is certainly positive.
  double least_quality = 0;
  /// Of the vertices at least this share must go, or it is not worth while; positive.
  double worthwhile = 0;
};

/// The mesh with many of the vertices inside its volume contracted at once, each into another one
/// at an edge; nothing if it is not worth while. The surface stays as it is, and so does what is
/// required.
///
/// What stays is a maximal independent set of the vertices at short edges (by random ranks: Luby
/// 1986), each other one is to go to the nearest of those beside it. Where a tet would come out too
/// poor or too long, one of its vertices goes to the next nearest, and stays in the end, until all
/// tets are sound.
///
/// No test for overlaps is needed, though neighbours go at the same time: a map of the vertices
/// that leaves the surface in place maps the mesh to a chain of tets with the same boundary; if
/// none of them is inverted, they cover the volume exactly once. An edge between two vertices
/// inside lies in one reference, so this holds for each.
///
/// Living entities keep their order; tets that change ask all. Holes are gone; links, vertex_tets
/// and qualities are set.
///
/// \pre links and triangles are as check() wants them, sizes are known
/// \throw Cancelled when the caller raises `cancel`, which may be none
std::optional<TetMesh> contracted(const TetMesh& mesh, const ContractionLimits& limits,
                                  const std::atomic<bool>* cancel = nullptr);

}  // namespace cavea
