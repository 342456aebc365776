#include "cavea/remesh/narrow_places.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "cavea/field/spots.h"
#include "cavea/geometry/centroid.h"
#include "cavea/remesh/asking.h"
#include "cavea/remesh/attempt.h"
#include "cavea/remesh/detour.h"
#include "cavea/remesh/obstacle.h"
#include "cavea/remesh/recipe.h"
#include "cavea/remesh/repair.h"
#include "cavea/remesh/rounds.h"
#include "cavea/remesh/standing.h"
#include "cavea/remesh/stubborn.h"

namespace cavea {
namespace {

/// Where more of the tets are unsound, the domain is to blame: walls that meet at small angles have
/// as many of them in any size. Of a small mesh a narrow place may be more.
constexpr double kFew = 0.005;
constexpr std::size_t kFewAtLeast = 30;
/// However large the mesh is: each place is compared with all that have failed.
constexpr std::size_t kMost = 10000;
/// Of tets that are sound, but poor, only so few are worth it.
constexpr double kHardlyAny = 0.0005;
/// Two copies of a mesh of more tets would make it need more memory than all that came before.
constexpr std::size_t kMostCopiedTwice = 10'000'000;
/// Down to ResolvedOptions::finest.
constexpr int kHalvings = 5;
constexpr double kHalf = 0.5;

/// What is done in a spot changes what is beside it.
constexpr double kAround = 2;

/// A spot may add half of the tets, or so many to a small mesh: beyond that the end is not worth
/// it. The same for all of them together where half the size is in vain. It happens where a large
/// tet has a vertex of a far smaller size.
constexpr double kMostAdded = 0.5, kMostAddedToSmall = 40'000;

/// A forecast: sizes rise from a spot so fast that only what is near its surface is small; seen
/// are 160 to 180 times the square, and less where spots are side by side.
double tets_added_by(const SizeSphere& spot) {
  const double widths = spot.radius / spot.size;
  return 170 * widths * widths;
}

/// Those whose centers lie in another one add little to it.
double tets_added_by(const std::vector<SizeSphere>& spots) {
  double tets = 0;
  for (auto spot = spots.begin(); spot != spots.end(); ++spot)
    if (std::none_of(spots.begin(), spot, [&](const SizeSphere& s) {
          return distance(s.center, spot->center) < s.radius;
        }))
      tets += tets_added_by(*spot);
  return tets;
}

/// The last tets are often such by chance: between walls of 14 degrees those at the edge are good
/// only if both walls have as many vertices along it. Where detours do not help, other sizes make
/// another mesh there.
constexpr double kOtherSizes[] = {0.8, 0.65, 0.9, 0.72};
/// So many trials are made, for so many tets all together, lest they take longer than the run; more
/// places than that are not chance.
constexpr int kMostTrials = 40, kFewestTrials = 6;
/// In a large mesh each takes a tenth of the run, and a uniform size is kept if there is a choice.
constexpr int kFewestOfUniform = 2;
/// A detour takes 10 to 40 ms, and leaves sizes as they are.
constexpr int kFewestDetours = 12;
constexpr double kTetsOfTrials = 1e6;
constexpr std::size_t kMostPlaces = 30;

/// If as many tets stay poor, the worst of them is to gain so much: half as far from a good one,
/// the next halving of the sizes may mend all of them.
constexpr double kClearGain = 0.03;

std::vector<Vec3> centers_of(const TetMesh& mesh, const std::vector<TetId>& tets) {
  std::vector<Vec3> centers;
  for (const TetId t : tets) centers.push_back(centroid(mesh.corners(t)));
  return centers;
}

/// The tets of a mesh that are below a quality, the worst first.
struct Bad {
  std::vector<TetId> tets;
  double worst = 1;

  Bad(const TetMesh& mesh, double quality) : tets(tets_below(mesh, quality)) {
    if (!tets.empty()) worst = mesh.qualities[tets.front()];
  }

  bool is_clearly_better_than(const Bad& other) const {
    if (tets.size() != other.tets.size()) return tets.size() < other.tets.size();
    return worst >= other.worst + kClearGain;
  }
};

/// What a refinement is for.
struct Aim {
  double quality;    ///< tets below it are to become fewer
  double growth;     ///< of sizes from where they are lowered
  int trials;        ///< each leaves out the places where the last one was in vain
  int finer_trials;  ///< the same of sizes less than half, where halves were in vain
};

/// What a trial changes, as it was before.
class Undo {
 public:
  Undo(Job& job, SurfaceDistance& distance)
      : job_(job), distance_(distance), before_(kept(job)), distance_before_(distance) {}

  void operator()() && {
    std::move(before_).give_back(job_);
    distance_ = std::move(distance_before_);
  }

 private:
  static const Job& kept(Job& job) {
    job.input.keep(job.mesh);
    return job;
  }

  Job& job_;
  SurfaceDistance& distance_;
  Before before_;
  SurfaceDistance distance_before_;
};

class Refinement {
 public:
  Refinement(Job& job, const Aim& aim, SurfaceDistance& distance,
             const std::function<SurfaceDistance()>& measure)
      : job_(job), aim_(aim), distance_(distance), measure_(measure) {}

  /// Half the sizes at all bad tets, again while that helps; where it does not, and no angle of the
  /// domain is the reason, a quarter and so on: steps have more poor tets along them first.
  void refine() {
    double share = kHalf;
    for (int k = 0; k < kHalvings; ++k) {
      const Bad bad(job_.mesh, aim_.quality);
      if (bad.tets.empty()) return;
      failed_.clear();
      share = refine_once(bad, share) ? kHalf : kHalf * share;
    }
  }

  /// The last tets one by one, each with several other sizes, but where angles of the domain are
  /// the reason.
  void refine_singly() {
    int left = trials_one_by_one(job_.r.uniform() ? kFewestOfUniform : kFewestTrials);
    for (const double share : kOtherSizes) {
      failed_.clear();
      for (; left > 0; --left) {
        const Bad bad(job_.mesh, aim_.quality);
        const auto t =
            first_blameless(bad.tets, [&](TetId n) { return hopeful_spot(n, share).has_value(); });
        if (!t) break;
        const SizeSphere spot = *hopeful_spot(*t, share);
        if (!refine_at({spot}, bad)) failed_.push_back({spot.center, spot.radius});
      }
    }
  }

  /// The last tets one by one: an operation beside each that makes it worse first, but then leads
  /// to fewer of them.
  void detour() {
    if (job_.r.freeze.any_operator()) return;
    failed_.clear();
    for (int left = trials_one_by_one(kFewestDetours); left > 0; --left) {
      const std::vector<TetId> bad = tets_below(job_.mesh, aim_.quality);
      const auto t = first_blameless(
          bad, [&](TetId n) { return !has_failed(centroid(job_.mesh.corners(n))); });
      if (!t) return;
      const Vec3 center = centroid(job_.mesh.corners(*t));
      if (!detour_at(*t, bad.size())) failed_.push_back({center, 0});
    }
  }

 private:
  int trials_one_by_one(int fewest) const {
    return std::clamp(int(kTetsOfTrials / double(job_.mesh.tets.size())), fewest, kMostTrials);
  }

  /// The worst tet that is hopeful and for which the angles of the domain are not to blame; none if
  /// the bad ones are too many.
  template <class IsHopeful>
  std::optional<TetId> first_blameless(const std::vector<TetId>& bad,
                                       IsHopeful&& is_hopeful) const {
    if (bad.size() > kMostPlaces) return {};
    OperatorContext context(job_.mesh, job_.surface.working_model());
    for (const TetId t : bad)
      if (is_hopeful(t) && !is_too_sharp(context, t)) return t;
    return {};
  }

  bool has_failed(const Vec3& place) const {
    return std::ranges::any_of(failed_, [&](const FailedPlace& f) { return f.contains(place); });
  }

  /// Of the mesh as it is.
  Standard standard() {
    if (!crossings_) crossings_ = find_crossings(job_.mesh).size();
    return standard_of(job_.mesh, distance_, *crossings_);
  }

  bool accept(const std::vector<Crossing>& crossings) {
    crossings_ = crossings.size();
    return true;
  }

  /// False if there is none, or it was taken back.
  bool detour_at(TetId t, std::size_t bad) {
    std::optional<Detour> detour;
    job_.steps.timed("detours", [&] { detour.emplace(job_, t, aim_.quality); });
    if (!detour->leads_on()) return false;
    const Standard standard = this->standard();
    Undo undo(job_, distance_);
    std::move(*detour).take();
    run_residual_of(job_, last_phase(job_.r));
    distance_ = measure_();
    if (tets_below(job_.mesh, aim_.quality).size() < bad) {
      const std::vector<Crossing> crossings = find_crossings(job_.mesh);
      if (standard.is_met(job_.mesh, distance_, crossings)) return accept(crossings);
    }
    std::move(undo)();
    return false;
  }

  /// \return whether that made the bad tets fewer or better
  bool refine_once(const Bad& bad, double share) {
    const int trials = share == kHalf ? aim_.trials : aim_.finer_trials;
    for (int trial = 0; trial < trials; ++trial) {
      const std::vector<SizeSphere> spots = hopeful_spots(bad.tets, share);
      if (spots.empty()) return false;
      if (refine_at(spots, bad)) return true;
    }
    return false;
  }

  /// Around the bad tets; none if they are too many.
  std::vector<SizeSphere> hopeful_spots(const std::vector<TetId>& bad, double share) const {
    const auto few = std::size_t(kFew * double(job_.mesh.tets.size()));
    if (bad.size() > std::min(kMost, std::max(kFewAtLeast, few))) return {};
    OperatorContext context(job_.mesh, job_.surface.working_model());
    std::vector<SizeSphere> spots;
    for (const TetId t : bad)
      if (const auto spot = hopeful_spot(t, share))
        if (share == kHalf || !is_too_sharp(context, t)) spots.push_back(*spot);
    if (share < kHalf && tets_added_by(spots) > most_added()) return {};
    return spots;
  }

  /// Around a bad tet, with so much of the sizes that are there; none where that has failed,
  /// would add too many tets, or these are as small as they may be.
  std::optional<SizeSphere> hopeful_spot(TetId t, double share) const {
    const TetMesh& mesh = job_.mesh;
    SizeSphere spot = spot_over(mesh, centroid(mesh.corners(t)), mesh.tets[t]);
    if (has_failed(spot.center) || spot.size <= job_.r.finest) return {};
    spot.size = std::max(job_.r.finest, share * spot.size);
    if (tets_added_by(spot) > most_added()) return {};
    return spot;
  }

  double most_added() const {
    return std::max(kMostAddedToSmall, kMostAdded * double(job_.mesh.tets.size()));
  }

  /// False if that was in vain: then it is taken back, and its failures are known.
  bool refine_at(const std::vector<SizeSphere>& spots, const Bad& bad) {
    const Standard standard = this->standard();
    const std::vector<Vec3> centers = centers_of(job_.mesh, bad.tets);
    Undo undo(job_, distance_);
    job_.steps.timed("refining", [&] { lower_and_mend(spots, bad.tets); });
    distance_ = measure_();
    const Bad left(job_.mesh, aim_.quality);
    const std::vector<Crossing> crossings = find_crossings(job_.mesh);
    if (left.is_clearly_better_than(bad) && standard.is_met(job_.mesh, distance_, crossings))
      return accept(crossings);
    add_failures(spots, centers, centers_of(job_.mesh, left.tets),
                 standard.failures(job_.mesh, distance_, crossings));
    std::move(undo)();
    return false;
  }

  void lower_and_mend(const std::vector<SizeSphere>& spots, const std::vector<TetId>& bad) {
    TetMesh& mesh = job_.mesh;
    const std::vector<float> sizes_before =
        job_.sizes.lower(mesh, job_.surface.model(), spots, job_.r.finest, aim_.growth);
    ask_nothing(mesh);
    ask_changed_lengths(mesh, sizes_before);
    for (const TetId t : bad) mesh.tet_flags[t] |= tet_flag::kAskAll;
    run_phases(job_, mending_recipe(job_.r));
    mend_near(spots);
  }

  /// All other poor tets were asked before.
  void mend_near(std::vector<SizeSphere> spots) {
    constexpr int kMends = 3;
    for (SizeSphere& s : spots) s.radius *= kAround;
    const SizeField near = field_inside(std::move(spots));
    const TetMesh& mesh = job_.mesh;
    const auto is_near = [&](TetId t) { return std::isfinite(near(centroid(mesh.corners(t)))); };
    const std::vector<Phase> phases = poor_recipe(job_.r);
    for (int k = 0; k < kMends; ++k) {
      ask_nothing(job_.mesh);
      for (const Phase& phase : phases) {
        ask_poor(job_.mesh, is_near);
        if (is_nothing_asked(mesh)) return;
        run_phase(job_, phase);
      }
      run_residual_of(job_, phases.back());
    }
  }

  /// Spots that have as many bad tets around them as before, and those near other failures.
  void add_failures(const std::vector<SizeSphere>& spots, const std::vector<Vec3>& before,
                    const std::vector<Vec3>& after, const std::vector<FailedPlace>& worse) {
    for (const SizeSphere& s : spots) {
      const FailedPlace around{s.center, kAround * s.radius};
      const auto count = [&](const std::vector<Vec3>& centers) {
        return std::ranges::count_if(centers, [&](const Vec3& p) { return around.contains(p); });
      };
      const bool is_worse = std::ranges::any_of(worse, [&](const FailedPlace& f) {
        return distance(f.center, s.center) <= f.radius + around.radius;
      });
      if (is_worse || count(after) >= count(before)) failed_.push_back({s.center, s.radius});
    }
  }

  Job& job_;
  const Aim aim_;
  SurfaceDistance& distance_;
  const std::function<SurfaceDistance()>& measure_;
  std::optional<std::size_t> crossings_;  ///< of the surface, once they are counted
  std::vector<FailedPlace> failed_;
};

/// Takes all back if some tet stays below the quality.
void refine_all_or_nothing(Job& job, const Aim& aim, SurfaceDistance& distance,
                           const std::function<SurfaceDistance()>& measure) {
  if (job.mesh.tets.size() > kMostCopiedTwice) return;
  Undo undo(job, distance);
  Refinement(job, aim, distance, measure).refine();
  if (tets_below(job.mesh, aim.quality).empty()) return;
  std::move(undo)();
}

}  // namespace

void refine_narrow_places(Job& job, SurfaceDistance& distance,
                          const std::function<SurfaceDistance()>& measure) {
  constexpr int kTrials = 4, kFinerTrials = 2;
  const Freezes& freeze = job.r.freeze;
  if (job.keeping.stands || freeze.insert || freeze.surface || job.sizes.budget().binds()) return;
  const double steep = steepest_growth(job.r), slow = job.r.hgrad;
  Refinement narrow(job, {kSoundQuality, steep, kTrials, kFinerTrials}, distance, measure);
  narrow.detour();
  narrow.refine();
  narrow.refine_singly();
  narrow.detour();
  if (job.r.uniform()) {
    // Worth the lengths that do not conform only if it is the end of it.
    if (slow < steep && !unsound_tets(job.mesh).empty())
      refine_all_or_nothing(job, {kSoundQuality, slow, kTrials, 0}, distance, measure);
    return;
  }
  const std::size_t poor = tets_below(job.mesh, kPoorQuality).size();
  if (poor == 0 || double(poor) > kHardlyAny * double(job.mesh.tets.size()) ||
      !unsound_tets(job.mesh).empty())
    return;
  constexpr int kOnce = 1;  // there is no place to leave out
  refine_all_or_nothing(job, {kPoorQuality, slow, kOnce, 0}, distance, measure);
}

}  // namespace cavea
