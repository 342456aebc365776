#pragma once
#include <array>

#include "cavea/geometry/point_block.h"
#include "cavea/geometry/vec3.h"

namespace cavea {

/// Cubic Bezier curve from points[0] to points[3].
struct BezierCurve {
  std::array<Vec3, 4> points;
  Vec3 at(double t) const;
  Vec3 derivative(double t) const;
};

/// Cubic Bezier triangle (paper, section 3.2, equation (2)). Control points b_ijk of corners
/// a0 (w = 1), a1 (u = 1), a2 (v = 1):
///   corner[k] = the corners; edge[k][0], edge[k][1] = the two control points of the edge opposite
///   corner k, from corner k+1 to corner k+2; center = b_111.
struct BezierTriangle {
  std::array<Vec3, 3> corner;
  std::array<std::array<Vec3, 2>, 3> edge;
  Vec3 center;

  /// sigma(u, v).
  Vec3 at(double u, double v) const;
  /// The same of the first n places, to the bit, into the block: to the end of its last group.
  void at(std::size_t n, const PointBlock::Row& u, const PointBlock::Row& v,
          PointBlock& points) const;
  /// The derivatives of sigma by u and by v.
  std::array<Vec3, 2> derivatives(double u, double v) const;
  /// Unnormalised normal: the cross product of the derivatives.
  Vec3 normal(double u, double v) const;
  /// Sets the center as the paper does (section 3.2.3), out of the others.
  void set_center();
};

}  // namespace cavea
