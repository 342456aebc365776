#pragma once
#include <functional>
#include <span>
#include <vector>

#include "cavea/geometry/box.h"
#include "cavea/geometry/oriented_point.h"
#include "cavea/geometry/vec3.h"

namespace cavea {

/// A function of a point that is negative inside and zero on the interface. Called from many
/// threads at once.
struct LevelSet {
  std::function<double(const Vec3&)> value;
  std::function<Vec3(const Vec3&)> gradient;  ///< if empty: central differences
};

/// The level set with a gradient: its own or, by differences over a step that suits a domain of
/// that diagonal, one of its values.
LevelSet with_gradient(const LevelSet& level_set, double diagonal);

/// The level set of another isovalue, as that of zero.
LevelSet less(const LevelSet& level_set, double isovalue);

/// The share of edge (a, b) at which the function is zero: safe for any function that changes its
/// sign. \param at_a, at_b its values at the ends, of which one is negative, the other not
double zero_on_edge(const LevelSet& level_set, const Vec3& a, const Vec3& b, double at_a,
                    double at_b);

/// The way to a common zero by Newton steps, each the shortest one there is; nowhere farther than
/// `reach`: up to there where they lead on.
/// \param level_sets with gradients \param allowed the part of a direction in which to go
Vec3 way_to_zero(std::span<const LevelSet* const> level_sets, const Vec3& from, double reach,
                 const std::function<Vec3(const Vec3&)>& allowed);

/// A zero for each cell of a lattice in whose corners the function has both signs: what is smaller
/// than `step`, or nearer to another sheet, may be missed. \param level_set with a gradient
std::vector<OrientedPoint> zeros_on_lattice(const LevelSet& level_set, const Box& box, double step);

}  // namespace cavea
