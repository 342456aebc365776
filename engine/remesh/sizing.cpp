#include "cavea/remesh/sizing.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

#include "cavea/field/own_sizes.h"
#include "cavea/field/spots.h"

namespace cavea {
void Sizing::look_at(const TetMesh& mesh) {
  vary_ = !r_.uniform() || budget_.given() || r_.freeze.surface ||
          (r_.hgradreq && !required_sizes(mesh).empty());
}

void Sizing::set(TetMesh& mesh, IdealSurface& surface) {
  const auto at_anchor = [&](VertexId v) { return surface.model().size(mesh.anchors[v]); };
  // What is set once need not be known again.
  const std::function<double(VertexId)> size = vary_ ? surface.sizes_of(mesh) : at_anchor;
  budget_.fit(mesh, [&] { set_wanted_sizes(mesh, size, field_, bounds(r_.hmin)); });
}

void Sizing::set_curved(TetMesh& mesh, const SurfaceModel& surface) const {
  set_wanted_sizes(
      mesh, [&](VertexId v) { return surface.curved_size(mesh.anchors[v]); }, {}, bounds(r_.hmin));
}

std::vector<float> Sizing::lower(TetMesh& mesh, const SurfaceModel& surface,
                                 std::vector<SizeSphere> spots, double finest, double hgrad) const {
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  const SizeField in_spots = field_inside(std::move(spots));
  const auto on_surface = [&](const Anchor& a) {
    return a.facet == kNone ? kEndless : in_spots(surface.at(a));
  };
  SizeBounds rules = bounds(std::min(r_.hmin, finest));
  rules.hgrad = hgrad;
  return lower_wanted_sizes(mesh, on_surface, rules);
}

SizeLaw Sizing::law() const {
  return {budget_.scale() * r_.hmin, finer_ * budget_.scale() * r_.hmax, r_.hgrad, budget_.scale(),
          field_};
}

SizeBounds Sizing::bounds(double hmin) const {
  return {hmin,     r_.hmax,     r_.local,         finer_, budget_.scale(),
          r_.hgrad, r_.hgradreq, r_.freeze.surface};
}

}  // namespace cavea
