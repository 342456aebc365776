#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "cavea/geometry/vec3.h"

namespace cavea {

/// The angle in degrees between the two faces at the edge (a, b) of a tet (a, b, c, d).
inline double dihedral(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 ab = b - a, n = cross(ab, c - a), m = cross(ab, d - a);
  // |n x m| = |ab| |6 volume|; the arc tangent keeps its digits near 0 and 180 degrees.
  const double sine = norm(ab) * std::abs(dot(n, d - a));
  return std::atan2(sine, dot(n, m)) * (180 / std::numbers::pi);
}

/// The edges of a tet, as rows of kEdgeVertices, by falling dihedral angle; equal ones by row.
inline std::array<int, 6> edges_by_dihedral(const std::array<Vec3, 4>& x) {
  // Outer normals: face i lies opposite vertex i.
  const Vec3 ab = x[1] - x[0], ac = x[2] - x[0], ad = x[3] - x[0];
  const Vec3 n1 = cross(ad, ac), n2 = cross(ab, ad), n3 = cross(ac, ab);
  const Vec3 n[4] = {-1.0 * (n1 + n2 + n3), n1, n2, n3};
  double length[4];
  for (int i = 0; i < 4; ++i) length[i] = std::max(norm(n[i]), 1e-300);
  // The faces at each edge are those opposite the other two vertices.
  constexpr int kFaces[6][2] = {{2, 3}, {1, 3}, {1, 2}, {0, 3}, {0, 2}, {0, 1}};
  std::array<double, 6> cosine;  // of the dihedral angle
  std::array<int, 6> order{0, 1, 2, 3, 4, 5};
  for (int e = 0; e < 6; ++e) {
    const int i = kFaces[e][0], j = kFaces[e][1];
    cosine[std::size_t(e)] = -dot(n[i], n[j]) / (length[i] * length[j]);
  }
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const double of_a = cosine[std::size_t(a)], of_b = cosine[std::size_t(b)];
    return of_a < of_b || (of_a == of_b && a < b);
  });
  return order;
}

}  // namespace cavea
