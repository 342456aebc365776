#include "cavea/remesh/repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "cavea/remesh/asking.h"
#include "cavea/remesh/joining.h"
#include "cavea/remesh/mending.h"
#include "cavea/remesh/narrow_places.h"
#include "cavea/remesh/rounds.h"
#include "cavea/remesh/standing.h"

namespace cavea {
namespace {

/// Repairs move the surface beside, too. After so many, what is within the tolerance is left, if
/// not with the margin for what lies between samples.
constexpr int kRepairs = 10;
/// After so many, what is beyond is left and reported.
constexpr int kMostRepairs = 20;

/// Around the far sample's triangle. The distance goes with the square of the size; a little more
/// for good measure.
SizeSphere spot_around(const FarSample& f, const TetMesh& mesh, const ResolvedOptions& r) {
  SizeSphere spot = spot_over(mesh, f.where, mesh.triangles[std::size_t(f.triangle)].v);
  const double factor = std::max(0.5, 0.75 * std::sqrt(kMeasuredShare * f.hausd / f.distance));
  spot.size = std::max(spot.size * factor, r.finest);
  return spot;
}

std::size_t far_places(const SurfaceDistance& distance) {
  return distance.far_facets.size() + distance.far_triangles.size();
}

/// Triangles that stay as they are, whatever size is asked for there: all around would be refined,
/// repair by repair, and nothing mended.
class Stuck {
 public:
  /// Those at far samples are asked once more.
  void ask(const SurfaceDistance& distance, const TetMesh& mesh) {
    std::map<Place, int> before = std::exchange(asked_, {});
    for (const auto* far : {&distance.far_facets, &distance.far_triangles})
      for (const FarSample& f : *far)
        if (f.triangle != kNone) {
          const Place place = place_of(f, mesh);
          asked_[place] = before[place] + 1;
        }
  }
  bool holds(const FarSample& f, const TetMesh& mesh) const {
    // Sizes are to a third by then: an edge of 0.7 sizes would be split.
    constexpr int kMostAsked = 4;
    const auto at = asked_.find(place_of(f, mesh));
    return at != asked_.end() && at->second > kMostAsked;
  }

 private:
  /// Corners: ids are given anew.
  using Place = std::array<std::array<double, 3>, 3>;
  static Place place_of(const FarSample& f, const TetMesh& mesh) {
    Place place;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = mesh.points[mesh.triangles[std::size_t(f.triangle)].v[k]];
      place[k] = {p.x, p.y, p.z};
    }
    std::ranges::sort(place);
    return place;
  }
  std::map<Place, int> asked_;
};

/// Whether a row of repairs only makes the surface finer, as where it is held away from the ideal
/// one: by what is required, or since that is another body's.
class Vain {
 public:
  Vain(const Job& job, const SurfaceDistance& distance)
      : worst_(distance.worse().worst),
        places_(far_places(distance)),
        tets_(job.mesh.tets.size()) {}

  /// \param distance after one more repair
  bool operator()(const Job& job, const SurfaceDistance& distance) {
    // The distance goes with the square of the size: twice the tets leave two thirds of it.
    constexpr double kProgress = 0.9, kMostGrowth = 2;
    // What is better by chance, time and again, is no better for it.
    constexpr double kLittle = 0.5, kMostInAll = 8;
    const double worst = distance.worse().worst;
    const std::size_t places = far_places(distance), tets = job.mesh.tets.size();
    if (worst > kLittle * first_worst_ && double(tets) > kMostInAll * double(first_tets_))
      return true;
    if (worst < kProgress * worst_ || double(places) < kProgress * double(places_)) {
      worst_ = worst, places_ = places, tets_ = tets;
      return false;
    }
    return double(tets) > kMostGrowth * double(tets_);
  }

 private:
  double worst_, first_worst_ = worst_;
  std::size_t places_, tets_, first_tets_ = tets_;
};

std::vector<SizeSphere> spots_of(const SurfaceDistance& distance, const TetMesh& mesh,
                                 const ResolvedOptions& r, const Stuck& stuck) {
  std::vector<SizeSphere> spots;
  for (const auto* far : {&distance.far_facets, &distance.far_triangles})
    for (const FarSample& f : *far)
      if (f.triangle != kNone && !stuck.holds(f, mesh)) spots.push_back(spot_around(f, mesh, r));
  return spots;
}

/// \return false if sizes there are as small as they may get, and nothing was asked
bool repair(Job& job, const SurfaceDistance& distance, Stuck& stuck) {
  stuck.ask(distance, job.mesh);
  job.input.keep(job.mesh);
  const std::vector<float> sizes_before =
      job.sizes.lower(job.mesh, job.surface.model(), spots_of(distance, job.mesh, job.r, stuck),
                      job.r.finest, steepest_growth(job.r));
  ask_nothing(job.mesh);
  ask_changed_lengths(job.mesh, sizes_before);
  if (is_nothing_asked(job.mesh)) return false;
  run_phases(job, mending_recipe(job.r));
  return true;
}

/// Repairs make the surface finer, which would break a budget that binds. Where the size is to be
/// uniform only few places may be, or it is too large for the tolerance.
bool may_repair(const Job& job, const SurfaceDistance& distance) {
  constexpr double kFewPlaces = 0.02;  // of the surface triangles
  const bool few = double(far_places(distance)) < kFewPlaces * double(job.mesh.triangles.size());
  return (few || !job.r.uniform()) && !job.r.freeze.insert && !job.r.freeze.surface &&
         !job.sizes.budget().binds();
}

/// What stands is only to keep the tolerance: no sample of it is between those measured.
bool is_far(const Job& job, const SurfaceDistance& distance, int repairs) {
  const bool exactly = job.keeping.stands || repairs >= kRepairs;
  return distance.worse().worst > (exactly ? 1 : kMeasuredShare);
}

/// The caller's last touch.
void finish(Job& job) {
  if (!job.options.finish || job.r.freeze.move || job.r.freeze.surface) return;
  job.input.keep(job.mesh);
  job.steps.timed("finish", [&] { job.options.finish(job.mesh); });
}

SurfaceDistance finish_and_measure(Job& job) {
  finish(job);
  SurfaceDistance distance;
  job.steps.timed("measurement", [&] { distance = job.surface.distance_of(job.mesh); });
  return distance;
}

}  // namespace

SizeSphere spot_over(const TetMesh& mesh, const Vec3& center, std::span<const VertexId> vertices) {
  // They are to lie inside, whatever rounding does.
  constexpr double kReach = 1.01;
  SizeSphere spot{center, 0, std::numeric_limits<double>::infinity()};
  for (const VertexId v : vertices) {
    spot.radius = std::max(spot.radius, kReach * distance(center, mesh.points[v]));
    spot.size = std::min(spot.size, double(mesh.sizes[v]));
  }
  return spot;
}

double steepest_growth(const ResolvedOptions& r) {
  constexpr double kBackToUniform = 1.8;
  return r.uniform() ? std::max(r.hgrad, kBackToUniform) : r.hgrad;
}

SurfaceDistance measure_and_repair(Job& job) {
  SurfaceDistance distance = finish_and_measure(job);
  int repairs = 0;
  Stuck stuck;
  const auto repair_all = [&] {
    Vain in_vain(job, distance);
    for (; repairs < kMostRepairs && may_repair(job, distance) && is_far(job, distance, repairs);
         ++repairs) {
      bool is_tried = false;
      job.steps.timed("repair", [&] { is_tried = repair(job, distance, stuck); });
      if (!is_tried) break;
      distance = finish_and_measure(job);
      if (in_vain(job, distance)) break;
    }
  };
  repair_all();
  if (repairs > 0 && count_poor(job.mesh) > 0) {
    // Repairs may leave poor tets as phases do, and mending these may move the surface.
    mend_poor(job);
    distance = finish_and_measure(job);
    repair_all();
  }
  join_surface(job, distance, [&] { return finish_and_measure(job); });
  refine_narrow_places(job, distance, [&] {
    distance = finish_and_measure(job);
    repair_all();
    return distance;
  });
  return distance;
}

}  // namespace cavea
