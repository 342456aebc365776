#pragma once
#include <functional>
#include <limits>

#include "cavea/geometry/vec3.h"

namespace cavea {

/// The user's wish: the edge length wanted at a point, called from many threads at once. An empty
/// function asks for nothing.
using SizeField = std::function<double(const Vec3&)>;

}  // namespace cavea
