#include "cavea/remesh/joining.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "cavea/mesh/fill_holes.h"
#include "cavea/remesh/asking.h"
#include "cavea/remesh/joiner.h"
#include "cavea/remesh/recipe.h"
#include "cavea/remesh/rounds.h"
#include "cavea/surface/crossings.h"

namespace cavea {
namespace {

double worst_quality(const TetMesh& mesh) { return *std::ranges::min_element(mesh.qualities); }

/// What joining and mending change of a job.
class Before {
 public:
  explicit Before(const Job& job)
      : mesh_(job.mesh),
        part_of_tet_(job.report.part_of_tet),
        residual_(job.report.residual),
        verdicts_(job.verdicts) {}

  void give_back(Job& job) && {
    job.mesh = std::move(mesh_);
    job.report.part_of_tet = std::move(part_of_tet_);
    job.report.residual = residual_;
    job.verdicts = verdicts_;
  }

 private:
  TetMesh mesh_;
  std::vector<std::int32_t> part_of_tet_;
  ResidualCount residual_;
  VerdictTable verdicts_;
};

/// What is left of the poor tets there is mended like all, and may leave more to join.
void join_and_mend(Job& job, bool surface_frozen, const std::vector<FailedPlace>& failed,
                   std::optional<Before>& before) {
  constexpr int kRounds = 5;
  std::vector<Phase> phases = poor_recipe(job.r);
  for (Phase& p : phases) p.cycle.limits.surface_frozen |= surface_frozen;
  const auto keep_first = [&] {
    if (!before) before.emplace(job);
  };
  for (int round = 0; round < kRounds; ++round) {
    ask_nothing(job.mesh);
    if (Joiner(job, failed).run(keep_first) == 0) return;
    fill_holes(job.mesh, &job.report.part_of_tet);
    run_phases(job, phases);
  }
}

/// What a trial must not fall short of.
struct Standard {
  double farthest = 0;  ///< distance of the surface from the ideal one, in hausd
  double worst = 0;     ///< quality
  std::size_t crossings = 0;
};

/// The places that must not be as they are: too far from the ideal surface, where the surface
/// passes through itself, or among tets that are worse than any was.
std::vector<FailedPlace> failures(const TetMesh& mesh, const SurfaceDistance& distance,
                                  const std::vector<Crossing>& crossings,
                                  const Standard& standard) {
  // As far as what a junction changes reaches, about.
  constexpr double kAround = 2;
  std::vector<FailedPlace> found;
  const auto add = [&](const Vec3& where, const auto& vertices) {
    double size = 0;
    for (const VertexId v : vertices) size = std::max(size, double(mesh.sizes[v]));
    found.push_back({where, kAround * size});
  };
  for (const auto* far : {&distance.far_facets, &distance.far_triangles})
    for (const FarSample& f : *far)
      if (f.distance > standard.farthest * f.hausd && f.triangle != kNone)
        add(f.where, mesh.triangles[std::size_t(f.triangle)].v);
  for (const Crossing& c : crossings) add(c.where, mesh.triangles[std::size_t(c.a)].v);
  for (const TetId t : unsound_tets(mesh)) {
    if (mesh.qualities[t] >= standard.worst) continue;
    const auto [a, b, c, d] = mesh.corners(t);
    add((a + b + c + d) / 4, mesh.tets[t]);
  }
  return found;
}

/// As long as that fails somewhere, the next trial moves less there.
void try_joining(Job& job, bool surface_frozen, SurfaceDistance& distance,
                 const std::function<SurfaceDistance()>& measure) {
  constexpr int kTrials = 6;
  const Standard standard{std::max(kMeasuredShare, distance.worse().worst), worst_quality(job.mesh),
                          find_crossings(job.mesh).size()};
  std::vector<FailedPlace> failed;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::optional<Before> before;
    job.steps.timed("joining", [&] { join_and_mend(job, surface_frozen, failed, before); });
    if (!before) return;
    SurfaceDistance after = measure();
    const std::vector<Crossing> crossings = find_crossings(job.mesh);
    if (after.worse().worst <= standard.farthest && worst_quality(job.mesh) >= standard.worst &&
        crossings.size() <= standard.crossings)
      return void(distance = std::move(after));
    const std::vector<FailedPlace> now = failures(job.mesh, after, crossings, standard);
    std::move(*before).give_back(job);
    if (now.empty()) return;  // nobody knows where to do otherwise
    failed.insert(failed.end(), now.begin(), now.end());
  }
}

}  // namespace

void join_surface(Job& job, SurfaceDistance& distance,
                  const std::function<SurfaceDistance()>& measure) {
  const Freezes& freeze = job.r.freeze;
  if (job.keeping.stands || freeze.join || freeze.collapse || freeze.insert || freeze.surface)
    return;
  // What operators do to the surface beside may add up to too much: then they leave it alone.
  for (const bool surface_frozen : {false, true}) {
    if (unsound_tets(job.mesh).empty()) return;
    job.input.keep(job.mesh);
    try_joining(job, surface_frozen, distance, measure);
  }
}

}  // namespace cavea
