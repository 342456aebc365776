#include "cavea/remesh/trials.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "cavea/mesh/copy.h"
#include "cavea/remesh/room.h"
#include "cavea/remesh/standing.h"
#include "cavea/remesh/stubborn.h"

namespace cavea {
namespace {

/// Sizes that are tried where the body has no room for those wanted, as shares of them: each makes
/// about twice the tets, the last a hundred times.
constexpr double kFinerSizes[] = {0.8, 0.64, 0.512, 0.41, 0.33, 0.26, kFinestRoom};

/// Runs on one input until the result has room for its elements.
class Trials {
 public:
  Trials(Input& input, const SizeField& field, const Options& options)
      : input_(input), field_(field), options_(options) {}

  Result operator()() {
    const std::unique_ptr<Run> first = run_once(1);
    const Room room_of_first = room(first->report());
    // After enough nobody needs the input.
    best_ = room_of_first == Room::kEnough ? first->take() : take(*first);
    switch (room_of_first) {
      case Room::kEnough:
        break;
      case Room::kLittle:
        if (const std::optional<double> finer = finer_size_of_input()) try_finer(*finer);
        break;
      case Room::kMissing:
        finest_tets_ = best_.report.after.counts.tets;
        if (is_left_alone(*first) || (first->made_room() && try_mended())) break;
        for (std::size_t i = 0; i < std::size(kFinerSizes); ++i)
          if (try_finer_and_back(kFinerSizes[i], i == 0 ? 1 : kFinerSizes[i - 1])) break;
    }
    best_.report.phases = std::move(phases_);
    return std::move(best_);
  }

 private:
  /// A run, and where the input turns out to be as good as its result another one that only mends
  /// it, or leaves it if that does not help.
  std::unique_ptr<Run> run_once(double finer, Effort effort = Effort::kWhereNeeded) {
    std::unique_ptr<Run> run;
    const auto run_with = [&](Effort e) {
      run.reset();  // which gives back what was lent to it
      run = std::make_unique<Run>(input_, field_, options_, e, finer);
      (*run)();
      keep_phases(*run);
    };
    run_with(effort);
    if (run->in_vain()) run_with(Effort::kMend);
    if (run->mended_in_vain()) run_with(Effort::kLeave);
    return run;
  }

  /// What was tried took its time, too.
  void keep_phases(Run& run) { std::ranges::move(run.take_phases(), std::back_inserter(phases_)); }

  /// The result of a run after which the input may be needed.
  Result take(Run& run) {
    input_.keep(run.mesh());
    return run.take();
  }

  Room room(const Report& report) const { return room_in(report.after, options_, bool(field_)); }

  /// The share of the sizes for which the input was made, if smaller ones were. A little room is
  /// found by one run and missed by the next: what the input has decides, but where it is much
  /// finer and the room is more than hardly enough, the caller wants other sizes.
  std::optional<double> finer_size_of_input() const {
    if (!has_the_quality_of_results(best_.report.before.quality, false, options_)) return {};
    for (const double finer : kFinerSizes) {
      if (Run(input_, field_, options_, Effort::kWhereNeeded, finer).stands()) return finer;
      if (!hardly_has_room(best_.report.after, options_)) break;
    }
    return {};
  }

  /// A result that lacks room by little was the best of these trials: others would find another
  /// one by chance.
  bool is_left_alone(const Run& run) const {
    return run.only_mends() && is_as_good_as_results(best_.report.after, false, options_);
  }

  bool gained(const Result& result) const {
    const MeshSummary &before = best_.report.after, &now = result.report.after;
    return now.quality.mean > before.quality.mean && !gained_nothing(before, now, options_);
  }

  static bool is_sound(const Result& result) {
    return result.report.after.quality.worst >= kSoundQuality;
  }

  bool is_worst_worse(const Result& result) const {
    return worst_has_risen(result.report.after, best_.report.after);
  }

  /// What only mends may leave tets as they are that a run would have made better.
  bool try_mended() {
    Result result = take(*run_once(1, Effort::kMend));
    if (room(result.report) == Room::kMissing || is_worst_worse(result)) return false;
    std::swap(best_, result);
    return true;
  }

  bool try_finer(double finer) { return offer(take(*run_once(finer))); }

  /// Strips between features that are about as wide as the sizes are filled by a row of triangles
  /// or by two, and operators do not get from one to the other. Collapses out of a finer mesh find
  /// what splits have missed.
  /// \return whether no finer one need be tried
  bool try_finer_and_back(double finer, double back_to) {
    const bool may_grow = is_coarse_mesh(best_.report.after);
    const std::unique_ptr<Run> run = run_once(finer);
    if (run->only_mends()) return offer(take(*run));
    if (bounds_hold(*run)) return offer(take(*run)), true;
    Result there{copy_of(run->mesh()), run->report()};
    run->coarsen(back_to);
    keep_phases(*run);
    Result back = take(*run);
    back.report.before = best_.report.before;
    const bool as_sound = is_sound(back) || !is_sound(there);
    if ((has_room(back.report.after, options_) || gained(back)) && as_sound &&
        !is_worst_worse(back))
      std::swap(best_, back);
    return room(best_.report) != Room::kMissing || !may_grow || offer(std::move(there));
  }

  /// The caller's bounds may leave sizes hardly finer than those of the last run.
  bool bounds_hold(const Run& run) {
    constexpr double kLeastGrowth = 1.1;  // about 2 are expected, see kFinerSizes
    const std::int64_t tets = run.report().after.counts.tets;
    return double(tets) < kLeastGrowth * double(std::exchange(finest_tets_, tets));
  }

  bool offer(Result&& result) {
    const MeshSummary& now = result.report.after;
    // What has become too large to be made finer yet may lack room all the same.
    const bool enough = has_room(now, options_) || !is_coarse_mesh(now);
    if (has_room(now, options_) || (enough && gained(result))) best_ = std::move(result);
    return enough;
  }

  Input& input_;
  const SizeField& field_;
  const Options& options_;
  Result best_;
  std::int64_t finest_tets_ = 0;  ///< of the run with the finest sizes so far
  std::vector<PhaseTime> phases_;
};

}  // namespace

Result run_trials(Input& input, const SizeField& field, const Options& options) {
  return Trials(input, field, options)();
}

}  // namespace cavea
