#include "cavea/geometry/predicates.h"

namespace cavea {

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  if (const int side = certain_side(a, b, c, d)) return side;
  using Quad = __float128;
  auto difference = [](const Vec3& p, const Vec3& q, Quad out[3]) {
    for (int k = 0; k < 3; ++k) out[k] = Quad(q[k]) - Quad(p[k]);
  };
  Quad u[3], v[3], w[3];
  difference(a, b, u);
  difference(a, c, v);
  difference(a, d, w);
  const auto size = [](Quad x) { return x < 0 ? -x : x; };
  Quad det = 0, permanent = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Quad left = v[j] * w[k], right = v[k] * w[j];
    det += u[i] * (left - right);
    permanent += size(u[i]) * (size(left) + size(right));
  }
  // The filter's bound again for this precision, 8 u with u = 2^-113: the products of three
  // differences have up to 160 bits, so that a flat tetrahedron need not give zero.
  const Quad bound = Quad(0x1p-110) * permanent;
  return det > bound ? 1 : det < -bound ? -1 : 0;
}

}  // namespace cavea
