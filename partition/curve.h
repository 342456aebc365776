#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "cavea/geometry/vec3.h"

namespace cavea {

/// Levels of the octree under the curve: 21 bits an axis, 63 bits a key.
inline constexpr int kCurveLevels = 21;

/// The key of each point on the Morton curve (z-order) of the smallest cube around all of them,
/// in 63 bits. The first 3 k bits of a key name the octree cell of level k that holds the point.
/// A coordinate that is not a number counts as the lower end of the cube.
std::vector<std::uint64_t> curve_keys(std::span<const Vec3> points);

}  // namespace cavea
