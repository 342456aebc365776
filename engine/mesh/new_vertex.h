#pragma once
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// A vertex to insert, or the new state of one that moves.
struct NewVertex {
  Vec3 point;
  float size = 0;
  Tag tags = 0;
  std::int32_t ref = 0;
  Anchor anchor;
};

}  // namespace cavea
