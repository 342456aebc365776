#include "cavea/surface/bezier.h"

#include "cavea/base/wide.h"

namespace cavea {
namespace {

using In = const double* __restrict;
using Out = double* __restrict;

/// BezierTriangle::at(), in the same order.
CAVEA_WIDE void places(std::size_t groups, const BezierTriangle& patch, In u, In v, Out x, Out y,
                       Out z) {
  const auto [a0, a1, a2] = patch.corner;
  const auto [b0, b1] = patch.edge[0];
  const auto [c0, c1] = patch.edge[1];
  const auto [d0, d1] = patch.edge[2];
  const Vec3 m = patch.center;
  for (std::size_t i = 0; i < groups * PointBlock::kGroup; ++i) {
    const double s = u[i], t = v[i], w = 1 - s - t;
    const Vec3 p = w * w * w * a0 + s * s * s * a1 + t * t * t * a2 + 3 * s * s * t * b0 +
                   3 * s * t * t * b1 + 3 * t * t * w * c0 + 3 * t * w * w * c1 +
                   3 * w * w * s * d0 + 3 * w * s * s * d1 + 6 * s * t * w * m;
    x[i] = p.x, y[i] = p.y, z[i] = p.z;
  }
}

}  // namespace

Vec3 BezierCurve::at(double t) const {
  const double s = 1 - t;
  return s * s * s * points[0] + 3 * s * s * t * points[1] + 3 * s * t * t * points[2] +
         t * t * t * points[3];
}

Vec3 BezierCurve::derivative(double t) const {
  const double s = 1 - t;
  return 3 * (s * s * (points[1] - points[0]) + 2 * s * t * (points[2] - points[1]) +
              t * t * (points[3] - points[2]));
}

Vec3 BezierTriangle::at(double u, double v) const {
  const double w = 1 - u - v;
  // Edge 0 runs from a1 (u) to a2 (v), edge 1 from a2 (v) to a0 (w), edge 2 from a0 (w) to a1 (u).
  return w * w * w * corner[0] + u * u * u * corner[1] + v * v * v * corner[2] +
         3 * u * u * v * edge[0][0] + 3 * u * v * v * edge[0][1] + 3 * v * v * w * edge[1][0] +
         3 * v * w * w * edge[1][1] + 3 * w * w * u * edge[2][0] + 3 * w * u * u * edge[2][1] +
         6 * u * v * w * center;
}

void BezierTriangle::at(std::size_t n, const PointBlock::Row& u, const PointBlock::Row& v,
                        PointBlock& points) const {
  points.resize(n);
  places(points.groups(), *this, u.data(), v.data(), points.x.data(), points.y.data(),
         points.z.data());
}

std::array<Vec3, 2> BezierTriangle::derivatives(double u, double v) const {
  const double w = 1 - u - v;
  // Derivatives along a0->a1 and a0->a2, three times these quadratics of control differences.
  const Vec3 du = w * w * (edge[2][0] - corner[0]) + u * u * (corner[1] - edge[2][1]) +
                  v * v * (edge[0][1] - edge[1][0]) + 2 * w * u * (edge[2][1] - edge[2][0]) +
                  2 * u * v * (edge[0][0] - center) + 2 * v * w * (center - edge[1][1]);
  const Vec3 dv = w * w * (edge[1][1] - corner[0]) + u * u * (edge[0][0] - edge[2][1]) +
                  v * v * (corner[2] - edge[1][0]) + 2 * w * u * (center - edge[2][0]) +
                  2 * u * v * (edge[0][1] - center) + 2 * v * w * (edge[1][0] - edge[1][1]);
  return {3 * du, 3 * dv};
}

Vec3 BezierTriangle::normal(double u, double v) const {
  const auto [du, dv] = derivatives(u, v);
  return cross(du, dv);
}

void BezierTriangle::set_center() {
  const Vec3 m = (edge[0][0] + edge[0][1] + edge[1][0] + edge[1][1] + edge[2][0] + edge[2][1]) / 6;
  const Vec3 v = (corner[0] + corner[1] + corner[2]) / 3;
  center = m + (m - v) / 2;
}

}  // namespace cavea
