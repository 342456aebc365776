#include "cavea/surface/midpoint.h"

namespace cavea {

NewVertex midpoint(const TetMesh& m, const SurfaceModel& surface, VertexId a, VertexId b,
                   TriangleId triangle, int side) {
  NewVertex v;
  v.point = (m.points[a] + m.points[b]) / 2;
  v.size = (m.sizes[a] + m.sizes[b]) / 2;
  if (triangle == kNone) return v;
  const Triangle& t = m.triangles[triangle];
  const Tag edge = t.edge_tag[std::size_t(side)];
  v.tags = Tag(tag::kSurface | (edge & (tag::kOnCurve | tag::kPinched)));
  const Anchor hints[2] = {m.anchors[a], m.anchors[b]};
  const SurfacePoint at = edge & tag::kFeature ? surface.place_on_curve(v.point, hints)
                                               : surface.place(v.point, t.patch, hints);
  v.anchor = at.anchor;
  if (at.anchor.facet != kNone) v.point = at.point;
  return v;
}

}  // namespace cavea
