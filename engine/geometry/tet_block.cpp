#include "cavea/geometry/tet_block.h"

#include "cavea/base/wide.h"
#include "cavea/geometry/quality.h"

namespace cavea {
namespace {

using Rows = const std::array<TetBlock::Row, 4>&;

CAVEA_WIDE void set_qualities(std::size_t n, Rows x, Rows y, Rows z, double* __restrict quality) {
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 a{x[0][i], y[0][i], z[0][i]}, b{x[1][i], y[1][i], z[1][i]};
    const Vec3 c{x[2][i], y[2][i], z[2][i]}, d{x[3][i], y[3][i], z[3][i]};
    quality[i] = tet_quality(a, b, c, d);
  }
}

CAVEA_WIDE void set_cosines(std::size_t n, Rows x, Rows y, Rows z, double* __restrict of01,
                            double* __restrict of02, double* __restrict of03,
                            double* __restrict of12, double* __restrict of13,
                            double* __restrict of23) {
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 a{x[0][i], y[0][i], z[0][i]}, b{x[1][i], y[1][i], z[1][i]};
    const Vec3 c{x[2][i], y[2][i], z[2][i]}, d{x[3][i], y[3][i], z[3][i]};
    const Vec3 ab = b - a, ac = c - a, ad = d - a;
    // Outer normals: each of the face opposite a corner.
    const Vec3 n0 = cross(c - b, d - b), n1 = cross(ad, ac), n2 = cross(ab, ad), n3 = cross(ac, ab);
    const double l0 = norm(n0), l1 = norm(n1), l2 = norm(n2), l3 = norm(n3);
    of01[i] = -dot(n2, n3) / (l2 * l3);
    of02[i] = -dot(n3, n1) / (l3 * l1);
    of03[i] = -dot(n1, n2) / (l1 * l2);
    of12[i] = -dot(n0, n3) / (l0 * l3);
    of13[i] = -dot(n2, n0) / (l2 * l0);
    of23[i] = -dot(n0, n1) / (l0 * l1);
  }
}

}  // namespace

const TetBlock::Row& TetBlock::qualities() {
  set_qualities(count_, x_, y_, z_, quality_.data());
  return quality_;
}

const std::array<TetBlock::Row, 6>& TetBlock::cosines() {
  set_cosines(count_, x_, y_, z_, cosine_[0].data(), cosine_[1].data(), cosine_[2].data(),
              cosine_[3].data(), cosine_[4].data(), cosine_[5].data());
  return cosine_;
}

}  // namespace cavea
