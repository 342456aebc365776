#pragma once

namespace cavea {

/// Sheets nearer to each other than this share of the largest coordinate touch: vertices on a plane
/// lie within some rounding of it.
inline constexpr double kTouching = 1e-12;

}  // namespace cavea
