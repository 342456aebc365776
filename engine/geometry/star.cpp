#include "cavea/geometry/star.h"

#include <cmath>

#include "cavea/base/wide.h"
#include "cavea/geometry/quality.h"

namespace cavea {
namespace {

/// Height of a regular tet over its face, in edges.
constexpr double kRegularHeight = 0.816496580927726;

/// What the wanted size counts against that of the face, in the height of an ideal apex: alone, the
/// face would keep edges as short or long as they are.
constexpr double kSizeShare = 0.3;

using In = const double* __restrict;
using Out = double* __restrict;

CAVEA_WIDE void prepare_faces(std::size_t n, In ax, In ay, In az, In bx, In by, In bz, In cx, In cy,
                              In cz, Out nx, Out ny, Out nz, Out edges, Out hx, Out hy, Out hz,
                              double size) {
  for (std::size_t i = 0; i < n; ++i) {
    const double ux = bx[i] - ax[i], uy = by[i] - ay[i], uz = bz[i] - az[i];
    const double vx = cx[i] - ax[i], vy = cy[i] - ay[i], vz = cz[i] - az[i];
    const double wx = cx[i] - bx[i], wy = cy[i] - by[i], wz = cz[i] - bz[i];
    const double x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    const double sum = (ux * ux + uy * uy + uz * uz) + (vx * vx + vy * vy + vz * vz) +
                       (wx * wx + wy * wy + wz * wz);
    const double n2 = x * x + y * y + z * z;
    const double h = n2 > 0 ? kRegularHeight *
                                  ((1 - kSizeShare) * std::sqrt(sum / 3) + kSizeShare * size) /
                                  std::sqrt(n2)
                            : 0;
    nx[i] = x, ny[i] = y, nz[i] = z;
    edges[i] = sum;
    hx[i] = (ax[i] + bx[i] + cx[i]) * (1.0 / 3) - h * x;
    hy[i] = (ay[i] + by[i] + cy[i]) * (1.0 / 3) - h * y;
    hz[i] = (az[i] + bz[i] + cz[i]) * (1.0 / 3) - h * z;
  }
}

CAVEA_WIDE void star_qualities(std::size_t n, double x, double y, double z, In ax, In ay, In az,
                               In bx, In by, In bz, In cx, In cy, In cz, In nx, In ny, In nz,
                               In edges, Out quality) {
  for (std::size_t i = 0; i < n; ++i) {
    const double ux = ax[i] - x, uy = ay[i] - y, uz = az[i] - z;
    const double vx = bx[i] - x, vy = by[i] - y, vz = bz[i] - z;
    const double wx = cx[i] - x, wy = cy[i] - y, wz = cz[i] - z;
    const double sum = edges[i] + (ux * ux + uy * uy + uz * uz) + (vx * vx + vy * vy + vz * vz) +
                       (wx * wx + wy * wy + wz * wz);
    const double volume = (ux * nx[i] + uy * ny[i] + uz * nz[i]) * (1.0 / 6.0);
    quality[i] = sum > 0 ? kQualityFactor * volume / (sum * std::sqrt(sum)) : 0;
  }
}

}  // namespace

void Star::grow() {
  constexpr std::size_t kFirst = 64;
  const std::size_t wider = capacity_ ? 2 * capacity_ : kFirst;
  std::vector<double> data(kRows * wider);
  for (int r = 0; r < kRows; ++r)
    for (std::size_t i = 0; i < count_; ++i) data[std::size_t(r) * wider + i] = row(Row(r))[i];
  data_ = std::move(data);
  capacity_ = wider;
}

void Star::add(const Vec3& a, const Vec3& b, const Vec3& c) {
  if (count_ == capacity_) grow();
  const std::size_t i = count_++;
  row(kAx)[i] = a.x, row(kAy)[i] = a.y, row(kAz)[i] = a.z;
  row(kBx)[i] = b.x, row(kBy)[i] = b.y, row(kBz)[i] = b.z;
  row(kCx)[i] = c.x, row(kCy)[i] = c.y, row(kCz)[i] = c.z;
}

void Star::prepare(double size) {
  prepare_faces(count_, row(kAx), row(kAy), row(kAz), row(kBx), row(kBy), row(kBz), row(kCx),
                row(kCy), row(kCz), row(kNx), row(kNy), row(kNz), row(kEdges), row(kHx), row(kHy),
                row(kHz), size);
}

void Star::evaluate(const Vec3& apex) {
  star_qualities(count_, apex.x, apex.y, apex.z, row(kAx), row(kAy), row(kAz), row(kBx), row(kBy),
                 row(kBz), row(kCx), row(kCy), row(kCz), row(kNx), row(kNy), row(kNz), row(kEdges),
                 row(kQuality));
}

Vec3 Star::ideal_apex(std::size_t i) const { return {row(kHx)[i], row(kHy)[i], row(kHz)[i]}; }

}  // namespace cavea
