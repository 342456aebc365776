#include "cavea/remesh/filling.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "cavea/mesh/copy.h"
#include "cavea/mesh/statistics.h"
#include "cavea/remesh/asking.h"
#include "cavea/remesh/attempt.h"
#include "cavea/remesh/bulk.h"
#include "cavea/remesh/evening.h"
#include "cavea/remesh/rounds.h"
#include "cavea/remesh/seeding.h"

namespace cavea {
namespace {

/// Of a lower mean quality are bodies filled with needles from side to side: halving the edges of
/// their surface in bulk would divide each needle many times. Above 0.2 bulk mostly does about as
/// well, and where a surface is folded, better.
constexpr double kOfNeedles = 0.2;

/// Bulk of a lower mean quality is of needles after all, if the Delaunay kernel makes it so good,
/// or better by so much: 3 to 25 times between fins and beside low steps. What follows then takes
/// 0.02 to 0.8 of the time. In a folded body, which it made better by 2.4 times, to 0.16, it took
/// ten times as long.
constexpr double kSpoilt = 0.15, kNotOfNeedles = 0.25, kMuchBetter = 3;
/// Not worth trying where the body's own tets are better: it was 0.53 at most.
constexpr double kWellShaped = 0.6;

/// Thin bodies of needles are this good between their surfaces, at least, once these are refined by
/// the Delaunay kernel: 0.52 to 0.63 on plates and tubes, as good as lattices would make them, and
/// 0.27 to 0.46 in shells of cones and pipes, of which halving all edges makes 35 to 130 times the
/// tets, of a mean below 0.02.
constexpr double kGoodWithoutSeeds = 0.25;

/// Shares of all vertices that are seeds.
constexpr double kFew = 0.05, kMost = 0.5, kNearlyAll = 0.8;

/// Mean quality of seeds that were evened out where they are left at that, but for the worst: 0.82
/// to 0.87 where sizes rise by up to 0.2 of the way, 0.74 where by 0.26, which the gradation allows
/// at most. Three more rounds would make 0.85 of the latter in place of 0.83, in a third more time.
constexpr double kEven = 0.7;

/// \return the mesh before, if it was refined
std::optional<TetMesh> refine(Job& job, BulkEdges which) {
  if (job.r.freeze.surface) return {};
  return refine_in_bulk(job.mesh, job.surface.working_model(), which, [&] { job.resize(); });
}

/// The same by the Delaunay kernel, a level a round.
std::optional<TetMesh> refine_among_needles(Job& job) {
  if (job.r.freeze.surface) return {};
  TetMesh before = copy_of(job.mesh);
  run_phase(job, surfacing(job.r));
  job.resize();
  ask_all(job.mesh);
  return before;
}

/// The mesh before its surface was refined.
struct Unrefined {
  std::optional<TetMesh> mesh;  ///< none if it was fine enough
  bool of_needles = false;
};

/// In bulk, or as among needles where tets would be too poor or turn out to be.
Unrefined refine_surface(Job& job) {
  std::optional<TetMesh> before;
  const auto among_needles = [&] {
    job.steps.timed("surface", [&] { before = refine_among_needles(job); });
  };
  const double of_input = job.report.before.quality.mean;
  if (of_input < kOfNeedles) {
    among_needles();
    return {std::move(before), true};
  }
  job.steps.timed("bulk", [&] { before = refine(job, BulkEdges::kOfSurface); });
  if (!before || of_input >= kWellShaped) return {std::move(before), false};
  const double of_bulk = mean_quality(job.mesh);
  if (of_bulk >= kSpoilt) return {std::move(before), false};
  Before in_bulk(job);
  job.mesh = *std::move(before);
  among_needles();
  if (mean_quality(job.mesh) >= std::min(kNotOfNeedles, kMuchBetter * of_bulk))
    return {std::move(before), true};
  std::move(in_bulk).give_back(job);
  return {std::move(before), false};
}

struct Seeded {
  double share = 0;      ///< of all vertices
  bool is_even = false;  ///< where lattices of different sizes meet, too
};

Seeded seed(Job& job) {
  TetMesh& mesh = job.mesh;
  if (!job.r.freeze.collapse) tag_replaceable(mesh);
  const std::int64_t seeds = seed_interior(mesh, job.sizes.law(), job.options.cancel, job.verdicts);
  Seeded result{double(seeds) / double(mesh.points.size())};
  if (job.sizes.vary() && seeds > 0) {
    if (result.share >= kNearlyAll && !job.r.uniform() && !job.r.freeze.move) {
      even_out(mesh, job.options.cancel);
      // Where sizes may jump, new vertices want theirs set anew, a round for each time.
      result.is_even = std::isfinite(job.r.hgrad) && mean_quality(mesh) >= kEven;
    }
    job.resize();
  }
  ask_all(mesh);
  trust_good_tets(mesh);
  return result;
}

}  // namespace

void coarsen_in_bulk(Job& job) {
  if (job.r.freeze.collapse) return;
  std::optional<TetMesh> coarser = coarsened_in_bulk(job.mesh, job.options.cancel);
  if (!coarser) return;
  job.input.take_back(job.mesh);
  job.mesh = *std::move(coarser);
}

Seeds fill(Job& job) {
  if (job.r.freeze.insert) return Seeds::kAbsent;
  TetMesh& mesh = job.mesh;
  auto [before, of_needles] = refine_surface(job);
  const bool divided = before && mesh.points.size() > before->points.size();
  Phase thin = thinning(job.r);
  // What the interfaces of so few parts leave is little, and fine asks for it.
  if (of_needles) thin.rounds = 1;
  job.steps.timed(thin.name, [&] { run_phase(job, thin); });
  Seeded seeded;
  job.steps.timed("seeding", [&] { seeded = seed(job); });
  const double share = seeded.share;
  if (seeded.is_even) return Seeds::kEven;
  if (share >= kNearlyAll) return Seeds::kNearlyAll;
  if (share >= kMost) return Seeds::kMost;
  if (!divided || share >= kFew) return Seeds::kSome;
  if (of_needles && mean_quality(mesh) >= kGoodWithoutSeeds) return Seeds::kSome;
  // Too thin for seeds: a fine surface around what is coarse inside is then hard to mend.
  mesh = *std::move(before);
  job.steps.timed("bulk", [&] { refine(job, BulkEdges::kAll); });
  return Seeds::kAbsent;
}

}  // namespace cavea
