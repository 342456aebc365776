#include "cavea/remesh/conclusion.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "cavea/base/error.h"
#include "cavea/base/parallel.h"
#include "cavea/mesh/check.h"
#include "cavea/part/interface_quality.h"
#include "cavea/remesh/recipe.h"
#include "cavea/remesh/stubborn.h"
#include "cavea/surface/crossings.h"

namespace cavea {
namespace {

/// A budget of tets is met when it is exceeded by no more than this share.
constexpr double kBudgetMargin = 0.1;

std::string to_text(const Vec3& p) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z);
}

/// Whether nothing was found to do in an input that stands.
bool is_as_before(const Job& job) {
  if (job.input.is_lent()) return true;
  const TetMesh& input = job.input.mesh();
  return job.keeping.stands && !job.options.finish && job.mesh.points == input.points &&
         job.mesh.tets == input.tets;
}

MeshSummary summary_of(const TetMesh& mesh) {
  return {count(mesh), quality_statistics(mesh), length_statistics(mesh)};
}

std::vector<Target> targets_of(const Job& job, const SurfaceDistance& distance,
                               const std::vector<Crossing>& crossings) {
  std::vector<Target> targets;
  const auto add = [&](const char* name, double wanted, double measured, bool met, const Vec3& at) {
    targets.push_back({name, wanted, measured, met, met ? "" : to_text(at)});
  };
  const Options& o = job.options;
  const QualityStatistics& q = job.report.after.quality;
  const LengthStatistics& l = job.report.after.lengths;
  add("worst quality", o.min_quality, q.worst, q.worst >= o.min_quality, q.worst_place);
  add("flat tetrahedra", 0, double(q.flat.size()), q.flat.empty(),
      q.flat.empty() ? Vec3{} : q.flat.front().place);
  add("conforming lengths", o.min_conform, l.conforming_percent(),
      l.conforming_percent() >= o.min_conform, l.longest_place);
  if (o.max_tets) {
    const double most = double(*o.max_tets), tets = double(job.mesh.tets.size());
    add("tets", most, tets, tets <= (1 + kBudgetMargin) * most, {});
  }
  const OneSidedDistance& d = distance.worse();
  const double hausd = d.hausd > 0 ? d.hausd : job.r.hausd;
  add("surface distance", hausd, d.worst * hausd, d.worst <= 1, d.where);
  add("surface crossings", 0, double(crossings.size()), crossings.empty(),
      crossings.empty() ? Vec3{} : crossings[0].where);
  return targets;
}

/// A result that crosses itself may have that from its input.
std::vector<std::string> warnings_of(const Job& job, const std::vector<Crossing>& of_result) {
  if (of_result.empty()) return {};
  const std::vector<Crossing> crossings =
      job.input.is_lent() ? of_result : find_crossings(job.input.mesh());
  if (crossings.empty()) return {};
  return {
      fmt::format("the surface of the input passes through itself: {} pairs of triangles, the "
                  "first near {}",
                  crossings.size(), to_text(crossings.front().where))};
}

/// Where a surface passes through itself, operators are not sure of what positive volumes prove
/// everywhere else.
void require_whole(const TetMesh& mesh) {
  if (const CheckResult result = check(mesh, {.allow_flat_tets = true}); !result.sound())
    throw InternalError(fmt::format("the mesh broke where its surface passes through itself: {}",
                                    result.message()));
}

}  // namespace

void conclude(Job& job, const SurfaceDistance& distance) {
  Report& report = job.report;
  const TetMesh& mesh = job.mesh;
  report.surface_distance = distance.max();
  report.bulge = job.surface.bulge();
  const bool as_before = is_as_before(job);
  std::vector<Crossing> crossings;
  run_together([&] { crossings = find_crossings(mesh); },
               [&] {
                 report.after = as_before ? report.before : summary_of(mesh);
                 report.interface_quality = interface_quality(mesh);
                 if (job.options.directions)
                   report.directions = surface_directions(mesh, job.surface.model());
               });
  if (!crossings.empty()) require_whole(mesh);
  report.verdicts = counts_of(job.verdicts);
  report.stubborn = find_stubborn(mesh, job.surface.working_model(), last_phase(job.r).cycle,
                                  job.options.min_quality);
  report.finer = as_before ? 1 : job.sizes.finer();
  report.hausd = job.r.hausd, report.hmin = job.r.hmin, report.hmax = job.r.hmax,
  report.hgrad = job.r.hgrad;
  report.targets = targets_of(job, distance, crossings);
  report.warnings = warnings_of(job, crossings);
}

}  // namespace cavea
