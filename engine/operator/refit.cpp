#include "cavea/operator/refit.h"

#include <limits>
#include <vector>

#include "cavea/geometry/closest.h"

namespace cavea {
namespace {

using Corners = std::array<Vec3, 3>;

class Refit {
 public:
  Refit(const OperatorContext& c, const Cavity& cavity, VertexId m, std::span<const Anchor> hints)
      : c_(c), cavity_(cavity), m_(m), hints_(hints.begin(), hints.end()) {
    for (const TriangleId t : cavity.removed_triangles)
      old_.push_back(corners(c.mesh.triangles[t]));
    for (const Triangle& t : cavity.triangles) new_.push_back(corners(t));
  }

  Verdict fit() const {
    const auto fit_of_new = [&](std::size_t k) {
      const Triangle& t = cavity_.triangles[k];
      return fit_triangle(c_, new_[k], t.patch, hints_of(t));
    };
    return judge_surface(new_.size(), fit_of_new,
                         [&] { return fit_of(c_, cavity_.removed_triangles); });
  }

  bool leaves_model_far() const {
    for (std::size_t k = 0; k < old_.size(); ++k) {
      const Corners& x = old_[k];
      const Triangle& t = c_.mesh.triangles[cavity_.removed_triangles[k]];
      for (const Vec3& sample : {(x[0] + x[1] + x[2]) / 3, (x[0] + x[1]) / 2, (x[1] + x[2]) / 2,
                                 (x[2] + x[0]) / 2, x[0], x[1], x[2]})
        if (leaves_far(sample, t)) return true;
    }
    return false;
  }

 private:
  Corners corners(const Triangle& t) const {
    const auto point = [&](VertexId v) { return v == m_ ? cavity_.vertex.point : c_.point(v); };
    return {point(t.v[0]), point(t.v[1]), point(t.v[2])};
  }

  std::vector<Anchor> hints_of(const Triangle& t) const {
    std::vector<Anchor> hints;
    for (const VertexId v : t.v)
      hints.push_back(v == m_ ? cavity_.vertex.anchor : c_.mesh.anchors[v]);
    hints.insert(hints.end(), hints_.begin(), hints_.end());
    return hints;
  }

  bool leaves_far(const Vec3& sample, const Triangle& t) const {
    const SurfacePoint at = c_.surface.place(sample, t.patch, hints_of(t));
    if (at.anchor.facet == kNone) return false;
    const double after2 = distance2_from(new_, at.point);
    return after2 > c_.tolerance2(at.anchor) && after2 > distance2_from(old_, at.point);
  }

  static double distance2_from(const std::vector<Corners>& triangles, const Vec3& p) {
    double nearest2 = std::numeric_limits<double>::infinity();
    for (const Corners& x : triangles)
      nearest2 = std::min(nearest2, closest_on_triangle(p, x[0], x[1], x[2]).distance2);
    return nearest2;
  }

  const OperatorContext& c_;
  const Cavity& cavity_;
  VertexId m_;
  std::vector<Anchor> hints_;
  std::vector<Corners> old_, new_;
};

}  // namespace

Verdict check_refit(const OperatorContext& c, const Cavity& cavity, VertexId m,
                    std::span<const Anchor> hints) {
  const Refit refit(c, cavity, m, hints);
  if (const Verdict v = refit.fit(); v != Verdict::kAccept) return v;
  return refit.leaves_model_far() ? Verdict::kOffSurface : Verdict::kAccept;
}

}  // namespace cavea
