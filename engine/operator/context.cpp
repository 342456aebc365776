#include "cavea/operator/context.h"

#include <limits>

namespace cavea {

void gather_around(OperatorContext& c) {
  c.around.clear();
  c.vertex_marker.begin(c.mesh.points.size());
  c.vertex_marker.mark(c.ball.v);
  for (const TetId t : c.ball.tets)
    for (const VertexId v : c.mesh.tets[t])
      if (c.vertex_marker.mark(v)) c.around.push_back({v, t});
}

void prepare_star(OperatorContext& c) {
  const VertexId v = c.ball.v;
  c.star.clear();
  for (TetId t : c.ball.tets) {
    const auto& k = c.mesh.tets[t];
    const int* f = kFaceVertices[c.mesh.local_index(t, v)];
    c.star.add(c.point(k[f[0]]), c.point(k[f[1]]), c.point(k[f[2]]));
  }
  c.star.prepare(c.mesh.sizes[v]);
}

SurfaceFit fit_triangle(const OperatorContext& context, const std::array<Vec3, 3>& t, int patch,
                        std::span<const Anchor> hints, unsigned sides) {
  constexpr SurfaceFit kNoFit{-1, std::numeric_limits<double>::infinity()};
  const Vec3 n = normalized(cross(t[1] - t[0], t[2] - t[0]));
  if (norm2(n) == 0) return kNoFit;
  // What is within the tolerance fits, however near it is.
  const double enough = context.limits.tolerance_share;
  const SurfacePoint at = context.surface.place((t[0] + t[1] + t[2]) / 3, patch, hints, enough);
  if (at.anchor.facet == kNone) return kNoFit;
  SurfaceFit fit{dot(n, context.surface.normal(at.anchor, patch)),
                 at.distance2 / context.tolerance2(at.anchor)};
  for (int k = 0; k < 3; ++k) {
    if (!(sides >> k & 1)) continue;
    const Vec3 middle = (t[std::size_t(k)] + t[std::size_t(k + 1) % 3]) / 2;
    const SurfacePoint p = context.surface.place(middle, patch, {&at.anchor, 1}, enough);
    fit.deviation2 = std::max(fit.deviation2, p.distance2 / context.tolerance2(p.anchor));
  }
  return fit;
}

unsigned sides_at(const Triangle& t, std::size_t i) {
  unsigned sides = 1u << i;
  // The side that ends at corner i lies opposite the next one.
  if ((t.edge_tag[(i + 1) % 3] & tag::kFeature) || t.sides[1].is_tet()) sides |= 1u << (i + 2) % 3;
  return sides;
}

SurfaceFit fit_in_fan(const OperatorContext& c, TriangleId id, VertexId v, const Vec3& to,
                      const Anchor& at) {
  const Triangle& t = c.mesh.triangles[id];
  const std::size_t i = t.v[0] == v ? 0 : t.v[1] == v ? 1 : 2;
  std::array<Vec3, 3> x;
  for (std::size_t k = 0; k < 3; ++k) x[k] = k == i ? to : c.point(t.v[k]);
  const Anchor hints[3] = {at, c.mesh.anchors[t.v[i == 0 ? 1 : 0]], c.mesh.anchors[v]};
  return fit_triangle(c, x, t.patch, hints, sides_at(t, i));
}

SurfaceFit fit_of_fan(const OperatorContext& c, VertexId v, const std::vector<TriangleId>& fan) {
  SurfaceFit fit;
  for (const TriangleId t : fan) fit.add(fit_in_fan(c, t, v, c.point(v), c.mesh.anchors[v]));
  return fit;
}

SurfaceFit fit_of(const OperatorContext& c, const std::vector<TriangleId>& triangles) {
  SurfaceFit fit;
  for (TriangleId id : triangles) {
    const Triangle& t = c.mesh.triangles[id];
    const auto& a = c.mesh.anchors;
    const Anchor hints[3] = {a[t.v[0]], a[t.v[1]], a[t.v[2]]};
    fit.add(fit_triangle(c, {c.point(t.v[0]), c.point(t.v[1]), c.point(t.v[2])}, t.patch, hints));
  }
  return fit;
}

namespace {

/// Cosine of the largest angle between a triangle and the ideal surface below it: 60 degrees, wider
/// than half the default ridge angle so that coarse inputs are not stuck, narrow enough for no
/// fold.
constexpr double kFoldCosine = 0.5;

}  // namespace

bool fits_well(const SurfaceFit& fit) { return fit.cosine >= kFoldCosine && fit.deviation2 <= 1; }

Verdict compare_fits(const SurfaceFit& after, const SurfaceFit& before) {
  if (after.cosine < kFoldCosine && after.cosine < before.cosine) return Verdict::kFolded;
  if (after.deviation2 > 1 && after.deviation2 > before.deviation2) return Verdict::kOffSurface;
  return Verdict::kAccept;
}

}  // namespace cavea
