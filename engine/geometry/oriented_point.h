#pragma once
#include "cavea/geometry/vec3.h"

namespace cavea {

/// A point of a surface with its unit normal; the zero vector where none is known.
struct OrientedPoint {
  Vec3 place, normal;
};

}  // namespace cavea
