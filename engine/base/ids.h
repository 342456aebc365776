#pragma once
#include <cstdint>

namespace cavea {

/// Indices into the arrays of one TetMesh. 32 bits: a mesh holds at most kMaxTets tetrahedra.
using VertexId = std::int32_t;
using TetId = std::int32_t;
using TriangleId = std::int32_t;

inline constexpr std::int32_t kNone = -1;

/// A face code is 4 * tet + face in 31 bits, so a mesh cannot hold more tetrahedra than this.
inline constexpr std::int64_t kMaxTets = std::int64_t{1} << 29;

}  // namespace cavea
