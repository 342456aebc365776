#include "cavea/operator/context.h"

namespace cavea {

Verdict check_triangle(const OperatorContext& context, const std::array<Vec3, 3>& t, int patch,
                       std::span<const Anchor> hints) {
  // Cosine of the largest angle between a triangle and the ideal surface below it: 60 degrees, wider
  // than half the default ridge angle so that coarse inputs are not stuck, narrow enough for no fold.
  constexpr double kFoldCosine = 0.5;
  const Vec3 n = normalized(cross(t[1] - t[0], t[2] - t[0]));
  if (norm2(n) == 0) return Verdict::kFolded;
  const SurfacePoint at = context.surface.place((t[0] + t[1] + t[2]) / 3, patch, hints);
  if (at.anchor.facet == kNone) return Verdict::kOffSurface;
  if (dot(n, context.surface.normal(at.anchor, patch)) < kFoldCosine) return Verdict::kFolded;
  const double tolerance2 = context.limits.tolerance * context.limits.tolerance;
  if (at.distance2 > tolerance2) return Verdict::kOffSurface;
  if (context.surface.deviation2(t, patch, {&at.anchor, 1}) > tolerance2) return Verdict::kOffSurface;
  return Verdict::kAccept;
}

}  // namespace cavea
