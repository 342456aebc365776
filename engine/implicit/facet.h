#pragma once
#include <array>

#include "cavea/implicit/level_set.h"

namespace cavea {

/// Whether a tet is cut: values at its corners are of both signs.
bool is_crossed(const std::array<double, 4>& values);

/// Whether the plane triangle or quadrangle in which a tet is cut is farther than the tolerance
/// from the level set, by its value over its slope at the edges' middles and in the middle, or the
/// smooth surface over it is, in the middles of its edges: a flat triangle bulges where one of its
/// corners is at a crease and has another face's normal.
/// \param corners of the tet \param values at them, of both signs \param level_set with a gradient
bool is_cut_off_by(double tolerance, const LevelSet& level_set, const std::array<Vec3, 4>& corners,
                   const std::array<double, 4>& values);

/// Whether the level set is not what the values at a tet's corners tell: of a plane through a zero,
/// a corner is farther than `reach` on the side that its value is not of.
bool is_beyond(const OrientedPoint& zero, double reach, const std::array<Vec3, 4>& corners,
               const std::array<double, 4>& values);

}  // namespace cavea
