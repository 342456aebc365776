#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "cavea/geometry/box.h"
#include "cavea/geometry/vec3.h"

namespace cavea {

/// Body-centred cubic lattices: the corners and centres of cubes of `cell * 2^level` at the origin.
/// Each is part of the next finer one. Their Delaunay tets are all alike, with edges of 1 and
/// sqrt(3)/2 cells and a quality of 0.93, and no five points are on a common sphere with none
/// inside, so that they are the only ones.
struct Lattice {
  double cell = 0;

  double cell_at(int level) const { return std::ldexp(cell, level); }

  /// About how many points of a level there are in a box.
  double count_in(const Box& box, int level) const {
    const Vec3 size = (box.high - box.low) / cell_at(level) + Vec3{1, 1, 1};
    return 2 * size.x * size.y * size.z;
  }
  /// Calls f(point) for the points of a level inside a tet of positive volume and in a box, in a
  /// time that goes with the box; but for the `coarsest`, without those of the next coarser level.
  template <class F>
  void for_each_inside(const std::array<Vec3, 4>& tet, const Box& box, int level, int coarsest,
                       F&& f) const;
};

namespace lattice_detail {

/// The multiples of `unit` from low to high, and a little beyond: a quotient that is whole may be
/// rounded to either side.
inline std::pair<std::int64_t, std::int64_t> multiples(double low, double high, double unit) {
  constexpr double kBeyond = 1e-6;
  return {std::int64_t(std::ceil(low / unit - kBeyond)),
          std::int64_t(std::floor(high / unit + kBeyond))};
}

/// The half spaces of a tet's faces: n . p <= d inside.
struct HalfSpaces {
  std::array<Vec3, 4> n;
  std::array<double, 4> d;

  explicit HalfSpaces(const std::array<Vec3, 4>& x) {
    constexpr std::size_t kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
    for (std::size_t f = 0; f < 4; ++f) {
      const Vec3& o = x[kFaces[f][0]];
      n[f] = cross(x[kFaces[f][1]] - o, x[kFaces[f][2]] - o);
      d[f] = dot(n[f], o);
    }
  }
  bool contain(const Vec3& p) const {
    return dot(n[0], p) <= d[0] && dot(n[1], p) <= d[1] && dot(n[2], p) <= d[2] &&
           dot(n[3], p) <= d[3];
  }
};

}  // namespace lattice_detail

template <class F>
void Lattice::for_each_inside(const std::array<Vec3, 4>& tet, const Box& box, int level,
                              int coarsest, F&& f) const {
  // In units of half a cell a point has three even or three odd coordinates; it is one of the
  // coarser level if these are even and alike modulo 4.
  const double unit = cell_at(level) / 2;
  const auto [x0, x1] = lattice_detail::multiples(box.low.x, box.high.x, unit);
  const auto [y0, y1] = lattice_detail::multiples(box.low.y, box.high.y, unit);
  const auto [z0, z1] = lattice_detail::multiples(box.low.z, box.high.z, unit);
  if (x0 > x1 || y0 > y1 || z0 > z1) return;
  const lattice_detail::HalfSpaces inside(tet);
  // Points on common faces and edges, of which a lattice has many, are to be in one tet only.
  const double little = 1e-7 * unit;
  const Vec3 off{little, 0.37 * little, 0.71 * little};
  for (std::int64_t i = x0; i <= x1; ++i)
    for (std::int64_t j = y0 + ((y0 ^ i) & 1); j <= y1; j += 2)
      for (std::int64_t k = z0 + ((z0 ^ i) & 1); k <= z1; k += 2) {
        const bool coarser = !(i & 1) && !((i ^ j) & 3) && !((i ^ k) & 3);
        if (coarser && level != coarsest) continue;
        const Vec3 p{double(i) * unit, double(j) * unit, double(k) * unit};
        if (inside.contain(p + off)) f(p);
      }
}

}  // namespace cavea
