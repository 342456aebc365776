#include "cavea/geometry/predicates.h"

namespace cavea {

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  if (certainly_positive(a, b, c, d)) return 1;
  if (certainly_positive(a, b, d, c)) return -1;
  using Quad = __float128;
  auto difference = [](const Vec3& p, const Vec3& q, Quad out[3]) {
    for (int k = 0; k < 3; ++k) out[k] = Quad(q[k]) - Quad(p[k]);
  };
  Quad u[3], v[3], w[3];
  difference(a, b, u);
  difference(a, c, v);
  difference(a, d, w);
  const Quad det = u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
                   u[2] * (v[0] * w[1] - v[1] * w[0]);
  return det > 0 ? 1 : det < 0 ? -1 : 0;
}

}  // namespace cavea
