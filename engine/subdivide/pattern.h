#pragma once
#include <array>
#include <cstdint>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// A tet with the vertices on its split edges. Local ids: 0 to 3 the corners, 4 + e the vertex on
/// edge e (of kEdgeVertices).
struct SplitTet {
  std::array<VertexId, 10> vertices{};
  unsigned mask = 0;  ///< bit e: edge e is split
};

/// The tets that a split tet falls into, in its local ids and with its orientation.
struct TetPattern {
  int count = 0;
  std::array<std::array<std::uint8_t, 4>, 8> tets{};
};

/// The pattern of a split tet. A face with two split edges has the diagonal at the smaller of the
/// ends of its third edge, a face with three is cut into four like triangles; so that tets on both
/// sides of a face agree. Diagonals inside the tet are the shortest.
/// \param points of the mesh that the vertices are of; read where five or six edges are split
TetPattern tet_pattern(const SplitTet& tet, const std::vector<Vec3>& points);

/// The local ids (as bits) on each face of a tet: three corners and the vertices on three edges.
std::array<unsigned, 4> face_masks();

/// A triangle with the vertices on its split edges. Local ids: 0 to 2 the corners, 3 + i the vertex
/// on the edge opposite corner i.
struct SplitTriangle {
  std::array<VertexId, 6> vertices{};
  unsigned mask = 0;  ///< bit i: the edge opposite corner i is split
};

struct TrianglePattern {
  int count = 0;
  std::array<std::array<std::uint8_t, 3>, 4> triangles{};
};

/// The triangles that a split triangle falls into, as tet_pattern() cuts the face of a tet.
TrianglePattern triangle_pattern(const SplitTriangle& triangle);

}  // namespace cavea
