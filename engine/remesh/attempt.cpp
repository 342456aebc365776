#include "cavea/remesh/attempt.h"

#include <algorithm>
#include <utility>

#include "cavea/base/ids_where.h"
#include "cavea/geometry/centroid.h"
#include "cavea/remesh/stubborn.h"

namespace cavea {
namespace {

double worst_quality(const TetMesh& mesh) { return *std::ranges::min_element(mesh.qualities); }

}  // namespace

Before::Before(const Job& job)
    : mesh_(job.mesh),
      part_of_tet_(job.report.part_of_tet),
      residual_(job.report.residual),
      verdicts_(job.verdicts) {}

void Before::give_back(Job& job) && {
  job.mesh = std::move(mesh_);
  job.report.part_of_tet = std::move(part_of_tet_);
  job.report.residual = residual_;
  job.verdicts = verdicts_;
}

Standard standard_of(const TetMesh& mesh, const SurfaceDistance& distance, std::size_t crossings) {
  return {std::max(kMeasuredShare, distance.worse().worst), worst_quality(mesh), crossings};
}

bool Standard::is_met(const TetMesh& mesh, const SurfaceDistance& distance,
                      const std::vector<Crossing>& found) const {
  return distance.worse().worst <= farthest && worst_quality(mesh) >= worst &&
         found.size() <= crossings;
}

std::vector<FailedPlace> Standard::failures(const TetMesh& mesh, const SurfaceDistance& distance,
                                            const std::vector<Crossing>& found) const {
  // As far as what an operator changes reaches, about.
  constexpr double kAround = 2;
  std::vector<FailedPlace> places;
  const auto add = [&](const Vec3& where, const auto& vertices) {
    double size = 0;
    for (const VertexId v : vertices) size = std::max(size, double(mesh.sizes[v]));
    places.push_back({where, kAround * size});
  };
  for (const auto* far : {&distance.far_facets, &distance.far_triangles})
    for (const FarSample& f : *far)
      if (f.distance > farthest * f.hausd && f.triangle != kNone)
        add(f.where, mesh.triangles[std::size_t(f.triangle)].v);
  for (const Crossing& c : found) add(c.where, mesh.triangles[std::size_t(c.a)].v);
  for (const TetId t : unsound_tets(mesh))
    if (mesh.qualities[t] < worst) add(centroid(mesh.corners(t)), mesh.tets[t]);
  return places;
}

std::vector<TetId> tets_below(const TetMesh& mesh, double quality) {
  std::vector<TetId> tets =
      ids_where(mesh.tets.size(), [&](std::size_t t) { return mesh.qualities[t] < quality; });
  std::ranges::sort(tets, {}, [&](TetId t) { return std::pair(mesh.qualities[t], t); });
  return tets;
}

std::vector<TetId> unsound_tets(const TetMesh& mesh) { return tets_below(mesh, kSoundQuality); }

}  // namespace cavea
