#include "cavea/remesh/remesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "cavea/base/cancel.h"
#include "cavea/base/error.h"
#include "cavea/base/memory.h"
#include "cavea/base/parallel.h"
#include "cavea/base/timer.h"
#include "cavea/field/own_sizes.h"
#include "cavea/field/spots.h"
#include "cavea/field/wanted_sizes.h"
#include "cavea/mesh/check.h"
#include "cavea/mesh/compact.h"
#include "cavea/mesh/copy.h"
#include "cavea/part/round.h"
#include "cavea/remesh/budget.h"
#include "cavea/remesh/bulk.h"
#include "cavea/remesh/forecast.h"
#include "cavea/remesh/input.h"
#include "cavea/remesh/recipe.h"
#include "cavea/remesh/resolved.h"
#include "cavea/remesh/seeding.h"
#include "cavea/remesh/standing.h"
#include "cavea/remesh/stubborn.h"
#include "cavea/surface/attach.h"
#include "cavea/surface/crossings.h"
#include "cavea/surface/distance.h"
#include "cavea/surface/features.h"
#include "cavea/surface/surface_model.h"

namespace cavea {
namespace {

/// Places farther than this share of hausd are made finer: what lies between two samples may be
/// farther than they.
constexpr double kMeasuredShare = 0.95;

/// Places that are still too far from the surface after this many repairs are left and reported.
constexpr int kRepairs = 10;

/// Poor tets are mended at most so often, each time unless more than this share of them stayed so.
constexpr int kMends = 5;
constexpr double kMended = 0.9;

/// Of a lower mean quality are bodies filled with needles from side to side: halving the edges of
/// their surface in bulk would divide each needle many times. Above, bulk does as well.
constexpr double kOfNeedles = 0.1;

/// A budget of tets is met when it is exceeded by no more than this share.
constexpr double kBudgetMargin = 0.1;

/// Sizes that are tried where the body has no room for those wanted, as shares of them; the last
/// makes about eight times the tets.
constexpr double kFinerSizes[] = {0.8, 0.64, kFinestRoom};

constexpr double kEndless = std::numeric_limits<double>::infinity();

/// A mesh is only mended in places if all but a few of its tets are as good as those of results, or
/// in any case; or not even that.
enum class Effort { kWhereNeeded, kMend, kLeave };

std::string to_text(const Vec3& p) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z);
}

/// One run of remesh(): the mesh it works on and what it reports.
class Run {
 public:
  Run(Input& input, const SizeField& field, const Options& options,
      Effort effort = Effort::kWhereNeeded, double finer = 1)
      : input_(input),
        mesh_(input.lend()),
        field_(field),
        options_(options),
        effort_(effort),
        finer_(finer),
        most_bytes_(options.max_memory.value_or(usable_bytes())),
        budget_(options.max_tets) {
    compact(mesh_);
    if (options.optim) field_ = own_sizes(mesh_);
    r_ = resolve(options, box_diagonal(mesh_), wished_range(mesh_, field_));
    field_ = with_regions(field_, options.size_regions, r_.hgrad);
  }

  /// What was lent to it and is no result goes back.
  ~Run() {
    if (!is_taken_) input_.take_back(mesh_);
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  void operator()() {
    timed("analysis", [&] { analyse(); });
    mends_ = ask_if_it_stands();
    if (!mends_ && !r_.freeze.collapse) timed("contraction", [&] { coarsen_in_bulk(); });
    if (!mends_ || poor_ > 0) input_.keep(mesh_);
    adapt(mends_ ? standing_recipe(r_) : recipe(r_, fill()));
  }

  /// From the sizes of this run to larger ones.
  void coarsen(double finer) {
    finer_ = finer;
    resize();
    ask_all(mesh_);
    std::vector<Phase> phases = recipe(r_, Seeds::kSome);
    phases.insert(phases.begin(), thinning(r_));
    adapt(phases);
  }

  /// Whether the input is what is asked for, but for places; nothing else is done.
  bool stands() {
    analyse();
    return ask_if_it_stands();
  }

  bool only_mends() const { return mends_; }

  /// Whether the input may be a result for which the sizes were made finer.
  bool made_room() const { return made_room_; }

  /// Whether the input was as good as the result: it is then better left as it is.
  bool in_vain() const {
    return may_mend_ && !mends_ && gained_nothing(report_.before, report_.after, options_);
  }

  /// Whether poor tets were asked, and stayed so: others in their places are no better.
  bool mended_in_vain() const {
    return poor_ > 0 && double(count_poor(mesh_)) > kMended * double(poor_) &&
           gained_nothing(report_.before, report_.after, options_);
  }

  const TetMesh& mesh() const { return mesh_; }

  /// The mesh that came out: if nothing was changed, with what was lent.
  TetMesh take_mesh() {
    is_taken_ = true;
    return std::move(mesh_);
  }

  Report report_;

 private:
  /// All that comes after the mesh is about as fine as wanted.
  void adapt(const std::vector<Phase>& phases) {
    for (const Phase& phase : phases) {
      forget_interfaces(mesh_);
      timed(phase.name, [&] { run_phase(phase); });
    }
    timed("residual", [&] { run_residual_of(phases.back()); });
    mend_poor();
    finish();
    timed("measurement", [&] { distance_ = measure_distance(); });
    repair_where_far();
    timed("statistics", [&] { measure(); });
    if (options_.directions) report_.directions = surface_directions(mesh_, *surface_);
    report_.peak_resident_bytes = peak_resident_bytes();
  }

  template <class F>
  void timed(const char* name, F&& f) {
    Timer timer;
    tell(name, 0);
    f();
    report_.phases.push_back({name, timer.seconds()});
  }

  void tell(const char* phase, int round) const {
    throw_if_cancelled(options_.cancel);
    if (options_.progress)
      options_.progress({phase, round, std::int64_t(mesh_.tets.size()), timer_.seconds()});
  }

  void analyse() {
    report_.before.counts = count(mesh_);
    report_.before.quality = quality_statistics(mesh_);
    take_surface();
    ask_all(mesh_);
    sizes_vary_ = !r_.uniform() || budget_.given() || r_.freeze.surface ||
                  (r_.hgradreq && !required_sizes(mesh_).empty());
    resize();
    refuse_too_large(mesh_, law(), most_bytes_);
    if (budget_.binds()) loosen();
    mesh_.normals.clear();
    report_.before.lengths = length_statistics(mesh_);
  }

  void take_surface() {
    if (!options_.surface) classify_features(mesh_, feature_options());
    take_model(surface_, 1);
    if (options_.surface) attach_to(mesh_, *surface_, feature_options(), r_.hausd);
  }

  /// The model of the mesh, which is classified, or of the one that the caller names as the truth.
  /// `looser` multiplies the tolerances.
  void take_model(std::optional<SurfaceModel>& model, double looser) {
    auto of_reference = r_.hausd_of_triangles;
    for (auto& [reference, hausd] : of_reference) hausd *= looser;
    const SurfaceModel::Settings settings{looser * r_.hausd, r_.max_bulge, r_.smallest, r_.largest,
                                          of_reference};
    if (!options_.surface) {
      model.emplace(mesh_, settings);
      return;
    }
    TetMesh truth = *options_.surface;
    classify_features(truth, feature_options());
    model.emplace(truth, settings);
  }

  FeatureOptions feature_options() const {
    // An edge of the wanted size h across a fold of angle a sags by h a / 4; where triangles of
    // height w meet at a, h = sqrt(4.5 hausd w / a). Beyond a w = 3 hausd the sag is too large:
    // then edges must follow the fold, and w is no less than about h, so that they can.
    constexpr double kFold = 3;
    // A smooth surface there would bulge by w a / 8. What is above the bound remains as a crease,
    // of angle a' with w a' = w a - 8 bulge, to which sizes of about 3.5 hausd / a' belong. Beyond
    // 6 of them in w it is better to follow the crease, too; but where it is slight the shape is
    // meant to be smooth, and only the tolerance too small for its facets.
    constexpr double kBulge = 8, kCrease = 6 * 3.5, kSlight = 20;
    constexpr double kSliver = 0.5;  // of hausd: less than what the surface may be off anyway
    FeatureOptions o;
    o.sliver = kSliver * r_.hausd;
    o.angle = options_.angle, o.detect_ridges = options_.detect_ridges;
    if (options_.faceted)
      o.crease = kFold * r_.hausd;
    else if (o.detect_ridges)
      o.crease = kBulge * r_.max_bulge + kCrease * r_.hausd, o.least_crease_angle = kSlight;
    return o;
  }

  void resize() {
    budget_.fit(mesh_, [&] {
      set_wanted_sizes(
          mesh_, [&](const Anchor& a) { return surface_->size(a); }, field_, size_bounds(r_.hmin));
    });
  }

  SizeBounds size_bounds(double hmin) const {
    return {hmin,     r_.hmax,     r_.local,         finer_, budget_.scale(),
            r_.hgrad, r_.hgradreq, r_.freeze.surface};
  }

  /// The surface of larger edges is farther from the model, as the square of their scale: operators
  /// are to allow that, save where another sheet is near. What is measured is the model as asked.
  void loosen() { take_model(loose_, budget_.scale() * budget_.scale()); }

  const SurfaceModel& working_surface() const { return loose_ ? *loose_ : *surface_; }

  /// Whether a phase may end after a round with this result.
  bool settled(const Phase& phase, const CycleResult& result) const {
    return !result.full && (phase.budget_rounds == 0 || budget_.met(mesh_)) &&
           double(result.changes) < phase.settled * double(mesh_.tets.size());
  }

  void coarsen_in_bulk() {
    std::optional<TetMesh> coarser = coarsened_in_bulk(mesh_, options_.cancel);
    if (!coarser) return;
    input_.take_back(mesh_);
    mesh_ = *std::move(coarser);
  }

  void refine(BulkEdges which) {
    if (r_.freeze.surface) return;
    refine_in_bulk(mesh_, working_surface(), which, [&] { resize(); });
  }

  SizeLaw law() const {
    return {budget_.scale() * r_.hmin, finer_ * budget_.scale() * r_.hmax, r_.hgrad,
            budget_.scale(), field_};
  }

  std::int64_t seed() {
    const std::int64_t seeds = seed_interior(mesh_, law(), options_.cancel, verdicts_);
    if (sizes_vary_ && seeds > 0) resize();
    ask_all(mesh_);
    trust_good_tets(mesh_);
    return seeds;
  }

  /// The surface's edges by the Delaunay kernel, a level a round.
  void refine_among_needles() {
    if (r_.freeze.surface) return;
    run_phase(surfacing(r_));
    resize();
    ask_all(mesh_);
  }

  /// Brings the mesh near the wanted sizes by what needs no search for where to put vertices.
  Seeds fill() {
    if (r_.freeze.insert) return Seeds::kAbsent;
    constexpr double kFew = 0.05, kMost = 0.5;  // of all vertices
    const bool needles = report_.before.quality.mean < kOfNeedles;
    std::optional<TetMesh> before;
    if (!r_.freeze.surface && (needles || is_worth_bulk(mesh_, BulkEdges::kOfSurface)))
      before = copy_of(mesh_);
    if (needles)
      timed("surface", [&] { refine_among_needles(); });
    else
      timed("bulk", [&] { refine(BulkEdges::kOfSurface); });
    const bool divided = before && mesh_.points.size() > before->points.size();
    const Phase thin = thinning(r_);
    timed(thin.name, [&] { run_phase(thin); });
    std::int64_t seeds = 0;
    timed("seeding", [&] { seeds = seed(); });
    const double share = double(seeds) / double(mesh_.points.size());
    if (share >= kMost) return Seeds::kMost;
    if (!divided || share >= kFew) return Seeds::kSome;
    // Too thin for seeds: a fine surface around what is coarse inside is then hard to mend.
    mesh_ = *std::move(before);
    timed("bulk", [&] { refine(BulkEdges::kAll); });
    return Seeds::kAbsent;
  }

  /// Whether the input is what is asked for, but for places: then those alone are asked, so that
  /// remeshing a result changes next to nothing.
  bool ask_if_it_stands() {
    may_mend_ = !r_.freeze.any_operator() && budget_.met(mesh_) &&
                !(options_.surface && measure_distance().worse().worst > 1);
    if (!may_mend_ || !may_keep()) return false;
    ask_nothing(mesh_);
    if (effort_ != Effort::kLeave && !none_is_poor(report_.before) && few_are_poor(mesh_)) {
      poor_ = count_poor(mesh_);
      ask_poor(mesh_);
    }
    if (!options_.surface) trust_facets();
    return true;
  }

  /// A result's surface is not quite that of its input, and asks for other sizes: a mesh that is
  /// kept has its own, if the caller has not said which.
  bool may_keep() {
    const bool surely = effort_ != Effort::kWhereNeeded || is_good();
    const bool own = !sizes_are_given(options_, bool(field_));
    if (!own || !(surely || is_near())) return surely;
    const LengthStatistics in_wanted = report_.before.lengths;
    std::vector<float> sizes = own_sizes_within(mesh_, r_.largest);
    mesh_.sizes.swap(sizes);
    report_.before.lengths = length_statistics(mesh_);
    if (surely || is_good()) return true;
    mesh_.sizes.swap(sizes);
    report_.before.lengths = in_wanted;
    return false;
  }

  bool is_good() const {
    return is_as_good_as_results(report_.before, r_.uniform(), options_.min_conform) &&
           (none_is_poor(report_.before) || few_are_poor(mesh_));
  }

  bool is_near() {
    constexpr double kLeastFiner = 0.8;  // what is finer yet asks for the next scale
    if (!has_the_quality_of_results(report_.before.quality, false)) return false;
    const LengthStatistics in_curved = lengths_in_curved_sizes();
    made_room_ = may_have_made_room(report_.before, in_curved, options_);
    return finer_ >= kLeastFiner && is_nearly_result(report_.before, in_curved, options_);
  }

  LengthStatistics lengths_in_curved_sizes() {
    const std::vector<float> sizes = mesh_.sizes;
    set_wanted_sizes(
        mesh_, [&](const Anchor& a) { return surface_->curved_size(a); }, {}, size_bounds(r_.hmin));
    const LengthStatistics lengths = length_statistics(mesh_);
    mesh_.sizes = sizes;
    return lengths;
  }

  /// Phases end when little of the whole changes: what is poor then may be little of it, and is
  /// asked for itself as long as that helps.
  void mend_poor() {
    if (mends_ && poor_ == 0) return;  // nothing was asked
    std::int64_t poor = count_poor(mesh_);
    for (int k = 0; k < kMends && poor > 0; ++k) {
      ask_nothing(mesh_);
      ask_poor(mesh_);
      timed("mending", [&] { run_phases(poor_recipe(r_)); });
      const std::int64_t left = count_poor(mesh_);
      if (double(left) > kMended * double(poor)) break;
      poor = left;
    }
  }

  /// A mesh that stands is as fine as its surface asks for: its triangles are within the tolerance
  /// of what they stand for, and a smooth surface that bulges more is not that.
  void trust_facets() {
    constexpr double kTrusted = 0.9;  // so that what lies between samples is within, too
    r_.max_bulge = std::min(r_.max_bulge, kTrusted * r_.hausd);
    if (bulge() <= r_.max_bulge) return;
    surface_->limit_bulge(r_.max_bulge);
    meter_.reset();
    bulge_.reset();
    if (loose_) loosen();
  }

  double bulge() {
    if (!bulge_) bulge_ = measure_bulge(*surface_);
    return *bulge_;
  }

  /// Repairs make the surface finer, which would break a budget that binds. Where the size is to be
  /// uniform only few places may be, or it is too large for the tolerance.
  bool may_repair() const {
    constexpr double kFewPlaces = 0.02;  // of the surface triangles
    const std::size_t places = distance_.far_facets.size() + distance_.far_triangles.size();
    const bool few = double(places) < kFewPlaces * double(mesh_.triangles.size());
    return (few || !r_.uniform()) && !r_.freeze.insert && !r_.freeze.surface && !budget_.binds();
  }

  void run_phases(const std::vector<Phase>& phases) {
    for (const Phase& phase : phases) run_phase(phase);
    run_residual_of(phases.back());
  }

  /// Asks what the interfaces of the last phase's last round have blocked.
  void run_residual_of(const Phase& last) {
    CycleSettings settings = last.cycle;
    settings.cancel = options_.cancel;
    report_.residual +=
        run_residual(mesh_, working_surface(), settings, report_.part_of_tet, verdicts_);
  }

  void run_phase(const Phase& phase) {
    CycleSettings settings = phase.cycle;
    settings.cancel = options_.cancel;
    PartSize size{options_.tets_per_part};
    if (phase.one_part > 0) size.one_part = phase.one_part;
    if (phase.ask > 0) ask_all(mesh_, phase.ask);
    if (phase.ask_below > 0) ask_below(mesh_, phase.ask_below);
    for (int round = 1; round <= phase.rounds || more_for_budget(phase, round); ++round) {
      tell(phase.name, round);
      refuse_too_large(mesh_, most_bytes_);
      if (phase.resize && round > 1 && sizes_vary_) resize(), ask_lengths(mesh_);
      if (report_.part_of_tet.size() == mesh_.tets.size() && is_nothing_asked(mesh_)) break;
      if (phase.growth > 0)
        settings.most_tets = std::int64_t(phase.growth * double(mesh_.tets.size()) /
                                          part_count(std::int64_t(mesh_.tets.size()), size)) +
                             10000;
      const RoundResult result =
          run_round(mesh_, working_surface(), settings, &report_.part_of_tet, size);
      report_.parts = std::max(report_.parts, result.parts);
      verdicts_ += result.cycle.verdicts;
      if (phase.budget_rounds > 0) budget_.learn(mesh_);
      if (settled(phase, result.cycle)) break;
    }
  }

  bool more_for_budget(const Phase& phase, int round) const {
    return round <= phase.rounds + phase.budget_rounds && !budget_.met(mesh_);
  }

  SurfaceDistance measure_distance() {
    // A triangle that is so near at seven samples is not beyond the tolerance at others: bumps of
    // the model below it are sampled from their own side.
    constexpr double kNear = 0.5;
    if (!meter_)
      meter_.emplace(*surface_, DistanceSampling{default_sample_step(mesh_, *surface_),
                                                 kMeasuredShare, kNear});
    return meter_->measure(mesh_);
  }

  void finish() {
    if (!options_.finish || r_.freeze.move || r_.freeze.surface) return;
    input_.keep(mesh_);
    timed("finish", [&] { options_.finish(mesh_); });
  }

  /// Repairs may leave poor tets as phases do, and mending these may move the surface.
  void repair_where_far() {
    auto is_far = [&] { return distance_.worse().worst > kMeasuredShare; };
    int repairs = 0;
    auto measure_anew = [&] {
      finish();
      timed("measurement", [&] { distance_ = measure_distance(); });
    };
    auto repair_all = [&] {
      for (; repairs < kRepairs && may_repair() && is_far(); ++repairs) {
        timed("repair", [&] { repair(); });
        measure_anew();
      }
    };
    repair_all();
    if (repairs == 0 || count_poor(mesh_) == 0) return;
    mend_poor();
    measure_anew();
    repair_all();
  }

  /// Makes the surface finer where it is too far from the model: what the curvature did not tell.
  void repair() {
    input_.keep(mesh_);
    // The smallest size is a wish, but what bounds a uniform one from below would forbid repairs.
    constexpr double kFinest = 0.125;
    const double finest = r_.uniform() ? kFinest * r_.smallest : r_.smallest;
    // The distance goes with the square of the size; a little more for good measure.
    auto factor = [&](const FarSample& f) {
      return std::max(0.5, 0.75 * std::sqrt(kMeasuredShare * f.hausd / f.distance));
    };
    std::vector<SizeSphere> spots;
    // The triangle's vertices are to lie inside the spot, whatever rounding does.
    constexpr double kReach = 1.01;
    auto add = [&](const FarSample& f) {
      if (f.triangle == kNone) return;
      SizeSphere spot{f.where, 0, r_.largest};
      for (VertexId v : mesh_.triangles[std::size_t(f.triangle)].v) {
        spot.radius = std::max(spot.radius, kReach * distance(f.where, mesh_.points[v]));
        spot.size = std::min(spot.size, double(mesh_.sizes[v]));
      }
      spot.size = std::max(spot.size * factor(f), finest);
      spots.push_back(spot);
    };
    std::for_each(distance_.far_facets.begin(), distance_.far_facets.end(), add);
    std::for_each(distance_.far_triangles.begin(), distance_.far_triangles.end(), add);
    resize_for(std::move(spots), finest);
    run_phases(mending_recipe(r_));
  }

  /// Vertices have moved since their sizes were set, so that set anew all would change a little:
  /// what the spots alone ask for counts where it is less.
  void resize_for(std::vector<SizeSphere> spots, double finest) {
    const SizeField in_spots = field_inside(std::move(spots));
    const auto on_surface = [&](const Anchor& a) {
      return a.facet == kNone ? kEndless : in_spots(surface_->at(a));
    };
    const std::vector<float> kept =
        lower_wanted_sizes(mesh_, on_surface, size_bounds(std::min(r_.hmin, finest)));
    ask_nothing(mesh_);
    ask_changed_lengths(mesh_, kept);
  }

  /// Whether nothing was found to do in an input that stands.
  bool is_as_before() const {
    if (input_.is_lent()) return true;
    const TetMesh& input = input_.mesh();
    return mends_ && !options_.finish && mesh_.points == input.points && mesh_.tets == input.tets;
  }

  void measure() {
    report_.surface_distance = distance_.max();
    report_.bulge = bulge();
    if (!is_as_before())
      report_.after = {count(mesh_), quality_statistics(mesh_), length_statistics(mesh_)};
    else
      report_.after = report_.before;
    report_.interface_quality = interface_quality(mesh_);
    report_.verdicts = counts_of(verdicts_);
    report_.stubborn =
        find_stubborn(mesh_, working_surface(), last_phase(r_).cycle, options_.min_quality);
    report_.finer = finer_;
    report_.hausd = r_.hausd, report_.hmin = r_.hmin, report_.hmax = r_.hmax,
    report_.hgrad = r_.hgrad;
    crossings_ = find_crossings(mesh_);
    set_targets();
    if (!crossings_.empty())
      warn_of_crossings(input_.is_lent() ? crossings_ : find_crossings(input_.mesh()));
  }

  /// A result that crosses itself may have that from its input.
  void warn_of_crossings(const std::vector<Crossing>& crossings) {
    if (crossings.empty()) return;
    report_.warnings.push_back(
        fmt::format("the surface of the input passes through itself: {} pairs of triangles, the "
                    "first near {}",
                    crossings.size(), to_text(crossings.front().where)));
  }

  void set_targets() {
    report_.targets.clear();
    const QualityStatistics& q = report_.after.quality;
    const LengthStatistics& l = report_.after.lengths;
    auto add = [&](const char* name, double wanted, double measured, bool met, const Vec3& at) {
      report_.targets.push_back({name, wanted, measured, met, met ? "" : to_text(at)});
    };
    add("worst quality", options_.min_quality, q.worst, q.worst >= options_.min_quality,
        q.worst_place);
    add("flat tetrahedra", 0, double(q.flat.size()), q.flat.empty(),
        q.flat.empty() ? Vec3{} : q.flat.front().place);
    add("conforming lengths", options_.min_conform, l.conforming_percent(),
        l.conforming_percent() >= options_.min_conform, l.longest_place);
    if (budget_.given()) {
      const double most = double(*options_.max_tets), tets = double(mesh_.tets.size());
      add("tets", most, tets, tets <= (1 + kBudgetMargin) * most, {});
    }
    const OneSidedDistance& d = distance_.worse();
    const double hausd = d.hausd > 0 ? d.hausd : r_.hausd;
    add("surface distance", hausd, d.worst * hausd, d.worst <= 1, d.where);
    add("surface crossings", 0, double(crossings_.size()), crossings_.empty(),
        crossings_.empty() ? Vec3{} : crossings_[0].where);
  }

  Input& input_;
  TetMesh mesh_;
  bool is_taken_ = false;
  SizeField field_;
  const Options& options_;
  Effort effort_;
  double finer_;  ///< of the sizes that are not given
  bool may_mend_ =
      false;            ///< the input has the surface and number of tets wanted, operators are free
  bool mends_ = false;  ///< only poor tets are asked
  std::int64_t poor_ = 0;  ///< so many
  bool made_room_ = false;
  std::vector<Crossing> crossings_;
  ResolvedOptions r_;
  bool sizes_vary_ = true;  ///< over space, so that new vertices want theirs set anew
  std::optional<SurfaceModel> surface_, loose_;
  std::optional<DistanceMeter> meter_;  ///< from surface_
  std::optional<double> bulge_;         ///< of surface_, once it was asked for
  SurfaceDistance distance_;
  VerdictTable verdicts_;
  std::int64_t most_bytes_;
  Budget budget_;
  Timer timer_;
};

struct Result {
  TetMesh mesh;
  Report report;
};

/// Runs on one input until the result has room for its elements.
class Trials {
 public:
  Trials(Input& input, const SizeField& field, const Options& options)
      : input_(input), field_(field), options_(options) {}

  Result operator()() {
    const std::unique_ptr<Run> first = run_once(1);
    const Room room_of_first = room(first->report_);
    best_ = room_of_first == Room::kEnough ? take_last(*first) : take(*first);
    switch (room_of_first) {
      case Room::kEnough:
        break;
      case Room::kLittle:
        if (is_input_made_finer()) try_finer(kFinerSizes[0]);
        break;
      case Room::kMissing:
        if (first->made_room() && try_mended()) break;
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
  void keep_phases(Run& run) {
    std::ranges::move(run.report_.phases, std::back_inserter(phases_));
    run.report_.phases.clear();
  }

  /// The result of the last run, after which nobody needs the input.
  static Result take_last(Run& run) { return {run.take_mesh(), std::move(run.report_)}; }

  Result take(Run& run) {
    input_.keep(run.mesh());
    return take_last(run);
  }

  Room room(const Report& report) const { return room_in(report.after, options_, bool(field_)); }

  /// A little room is found by one run and missed by the next: what the input has decides, but
  /// where it is much finer, the caller wants other sizes.
  bool is_input_made_finer() const {
    return has_the_quality_of_results(best_.report.before.quality, false) &&
           Run(input_, field_, options_, Effort::kWhereNeeded, kFinerSizes[0]).stands();
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
    Result there{copy_of(run->mesh()), run->report_};
    run->coarsen(back_to);
    keep_phases(*run);
    Result back = take(*run);
    back.report.before = best_.report.before;
    const bool as_sound = is_sound(back) || !is_sound(there);
    if ((has_room(back.report.after) || gained(back)) && as_sound && !is_worst_worse(back))
      std::swap(best_, back);
    return room(best_.report) != Room::kMissing || !may_grow || offer(std::move(there));
  }

  bool offer(Result&& result) {
    const MeshSummary& now = result.report.after;
    // What has become too large to be made finer yet may lack room all the same.
    const bool enough = has_room(now) || !is_coarse_mesh(now);
    if (has_room(now) || (enough && gained(result))) best_ = std::move(result);
    return enough;
  }

  Input& input_;
  const SizeField& field_;
  const Options& options_;
  Result best_;
  std::vector<PhaseTime> phases_;
};

}  // namespace

Report remesh(TetMesh& mesh, const SizeField& field, const Options& options) {
  validate(options);
  if (options.optim && field) throw OptionError("optim excludes a field of sizes");
  const int threads = options.threads > 0 ? options.threads : default_threads();
  const Timer timer;
  Report report;
  run_in_arena(threads, [&] {
    // A field of the caller, or the surface that he names, may look at the mesh.
    Input input(mesh, !field && !options.surface);
    Result result = Trials(input, field, options)();
    report = std::move(result.report);
    mesh = std::move(result.mesh);
  });
  report.threads = threads;
  report.seconds = timer.seconds();
  report.tets_per_second = double(report.after.counts.tets) / report.seconds;
  return report;
}

}  // namespace cavea
