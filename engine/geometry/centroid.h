#pragma once
#include <array>

#include "cavea/geometry/vec3.h"

namespace cavea {

inline Vec3 centroid(const std::array<Vec3, 4>& tet) {
  return (tet[0] + tet[1] + tet[2] + tet[3]) / 4;
}

}  // namespace cavea
