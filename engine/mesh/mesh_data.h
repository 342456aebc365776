#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "cavea/geometry/vec3.h"

namespace cavea {

/// A mesh as plain lists, the way a file holds it: what readers produce and writers take. All
/// indices are zero-based. Nothing but the index ranges need be true of it; build() judges the
/// rest.
struct MeshData {
  std::vector<Vec3> vertices;
  std::vector<std::int32_t> vertex_refs;
  std::vector<std::array<std::int32_t, 4>> tets;
  std::vector<std::int32_t> tet_refs;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> triangle_refs;
  std::vector<std::array<std::int32_t, 2>> edges;
  std::vector<std::int32_t> edge_refs;

  std::vector<std::int32_t> corners;             ///< vertices
  std::vector<std::int32_t> ridges;              ///< indices into edges
  std::vector<std::int32_t> required_vertices;   ///< vertices
  std::vector<std::int32_t> required_edges;      ///< indices into edges
  std::vector<std::int32_t> required_triangles;  ///< indices into triangles
  std::vector<std::int32_t> required_tets;       ///< indices into tets

  std::vector<Vec3> normals;
  std::vector<std::array<std::int32_t, 2>> normal_at_vertices;  ///< (vertex, index into normals)
  std::vector<Vec3> tangents;
  std::vector<std::array<std::int32_t, 2>> tangent_at_vertices;  ///< (vertex, index into tangents)

  std::vector<double> sizes;  ///< wanted size at each vertex, or empty; a file of its own
  /// Per-tet part of the parallel run that made it, or empty; for display.
  std::vector<std::int32_t> parts;
};

}  // namespace cavea
