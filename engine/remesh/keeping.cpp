#include "cavea/remesh/keeping.h"

#include "cavea/field/own_sizes.h"
#include "cavea/remesh/asking.h"
#include "cavea/remesh/job.h"
#include "cavea/remesh/standing.h"

namespace cavea {
namespace {

/// Judges the input of a job.
class Judge {
 public:
  Judge(Job& job, Effort effort) : job_(job), before_(job.report.before), effort_(effort) {}

  Keeping operator()() {
    keeping_.possible = is_possible();
    keeping_.stands = keeping_.possible && stands();
    if (!keeping_.stands) return keeping_;
    ask_nothing(job_.mesh);
    if (effort_ != Effort::kLeave && !none_is_poor(before_) && few_are_poor(job_.mesh))
      ask_poor_ones();
    if (!job_.options.surface) job_.surface.trust_facets(job_.mesh);
    return keeping_;
  }

 private:
  void ask_poor_ones() {
    const std::int64_t poor = count_poor(job_.mesh);
    if (poor_by_chance(before_, poor)) return;
    keeping_.poor = poor;
    ask_poor(job_.mesh);
  }

  bool is_possible() {
    return !job_.r.freeze.any_operator() && job_.sizes.budget().met(job_.mesh) &&
           !(job_.options.surface && job_.surface.distance_of(job_.mesh).worse().worst > 1);
  }

  /// A result's surface is not quite that of its input, and asks for other sizes: a mesh that is
  /// kept has its own, if the caller has not said which.
  bool stands() {
    const bool surely = effort_ != Effort::kWhereNeeded || is_good();
    const bool own = !sizes_are_given(job_.options, bool(job_.field));
    if (!own && surely && !no_length_is_poor(before_.lengths)) leave_narrow_places();
    if (!own || !(surely || is_near())) return surely;
    const LengthStatistics in_wanted = before_.lengths;
    std::vector<float> sizes = own_sizes_within(job_.mesh, job_.r.largest);
    job_.mesh.sizes.swap(sizes);
    before_.lengths = length_statistics(job_.mesh);
    if (surely || is_good()) return true;
    keeping_.own_lengths = before_.lengths;
    job_.mesh.sizes.swap(sizes);
    before_.lengths = in_wanted;
    return false;
  }

  /// Given sizes may have given way where the body is narrow: see refine_narrow_places().
  void leave_narrow_places() {
    give_way_to_own(job_.mesh);
    before_.lengths = length_statistics(job_.mesh);
  }

  bool is_good() const {
    return is_as_good_as_results(before_, job_.r.uniform(), job_.options) &&
           (none_is_poor(before_) || few_are_poor(job_.mesh));
  }

  bool is_near() {
    constexpr double kLeastFiner = 0.8;  // what is finer yet asks for the next scale
    if (!has_the_quality_of_results(before_.quality, false, job_.options)) return false;
    const InCurvedSizes curved{lengths_in_curved_sizes(), job_.surface.bulge() / job_.r.hausd};
    keeping_.made_room = may_have_made_room(before_, curved, job_.options);
    return job_.sizes.finer() >= kLeastFiner && is_nearly_result(before_, curved, job_.options);
  }

  LengthStatistics lengths_in_curved_sizes() {
    const std::vector<float> sizes = job_.mesh.sizes;
    job_.sizes.set_curved(job_.mesh, job_.surface.model());
    const LengthStatistics lengths = length_statistics(job_.mesh);
    job_.mesh.sizes = sizes;
    return lengths;
  }

  Job& job_;
  MeshSummary& before_;
  Effort effort_;
  Keeping keeping_;
};

}  // namespace

Keeping keep_what_stands(Job& job, Effort effort) { return Judge(job, effort)(); }

}  // namespace cavea
