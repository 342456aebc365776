#include "cavea/surface/distance.h"

#include <cmath>
#include <functional>
#include <optional>
#include <tuple>

#include "cavea/base/ids_where.h"
#include "cavea/base/parallel.h"
#include "cavea/geometry/closest.h"
#include "cavea/surface/facet_tree.h"
#include "cavea/surface/patch_tree.h"
#include "cavea/surface/sampler.h"

namespace cavea {
namespace {

/// How far around a block of samples it is looked for what is nearest to all of them, in its box's
/// diagonals: what is farther is looked for from each sample.
constexpr double kReach = 0.5;

/// Of hausd: what is less is rounding, of which nobody need know more than a bound.
constexpr double kRounding = 1e-9;

double reach_around(const Box& box, double hausd) {
  return std::min(hausd, kReach * distance(box.low, box.high));
}

OneSidedDistance fold(const std::vector<Sampled>& samples, const DistanceSampling& sampling) {
  const bool all_exact = sampling.enough == 0;
  Sampled total;
  for (const Sampled& s : samples) {
    if (!s.exact) continue;  // and nearer than others
    total.max = std::max(total.max, s.max);
    if (s.worst > total.worst) total.worst = s.worst, total.hausd = s.hausd, total.where = s.where;
    total.sum += s.area * (s.sum / s.count);
    total.area += s.area;
  }
  return {std::max(total.max, 0.0), all_exact && total.area > 0 ? total.sum / total.area : 0,
          std::max(total.worst, 0.0), total.hausd, total.where};
}

/// \param id_of the id of the i-th sampled triangle \param ids of the output's triangles
template <class IdOf>
std::vector<FarSample> beyond(const std::vector<Sampled>& samples, double most, IdOf&& id_of,
                              const std::vector<TriangleId>& ids) {
  std::vector<FarSample> far;
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (const Sampled& s = samples[i]; s.worst > most)
      far.push_back({id_of(i), s.where, s.worst * s.hausd, s.hausd,
                     s.triangle == kNone ? kNone : ids[std::size_t(s.triangle)]});
  return far;
}

/// A mesh's surface triangles, without holes.
struct OutputSurface {
  std::vector<TriangleId> ids;
  std::vector<Corners> corners;
  std::vector<std::array<std::int32_t, 3>> anchors;  ///< of this model, or of another
  std::vector<std::int32_t> facets;                  ///< as one of these says

  OutputSurface() = default;
  explicit OutputSurface(const TetMesh& mesh) {
    ids = ids_where(mesh.triangles.size(), [&](TriangleId t) { return mesh.triangles[t].alive(); });
    corners.resize(ids.size());
    anchors.resize(ids.size());
    facets.resize(ids.size());
    parallel_for(ids.size(), [&](std::size_t i) {
      const auto& v = mesh.triangles[ids[i]].v;
      const auto anchor = [&](int k) { return mesh.anchors[v[k]].facet; };
      corners[i] = {mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]};
      anchors[i] = {anchor(0), anchor(1), anchor(2)};
      facets[i] = std::max({kNone, anchor(0), anchor(1), anchor(2)});
    });
  }
};

/// Triangles that are a facet of the model are nearest to that one.
void prefer_own_facets(std::span<const Corners> facets, OutputSurface& out) {
  parallel_for(std::min(facets.size(), out.corners.size()), [&](std::size_t t) {
    if (out.corners[t] == facets[t]) out.facets[t] = std::int32_t(t);
  });
}

std::vector<Corners> facets_of(const SurfaceModel& model) {
  std::vector<Corners> facets(model.facets());
  parallel_for(facets.size(),
               [&](std::size_t f) { facets[f] = model.facet_corners(std::int32_t(f)); });
  return facets;
}

double least_hausd_of(const SurfaceModel& model) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < model.facets(); ++f)
    least = std::min(least, model.hausd(std::int32_t(f)));
  return least;
}

/// The output's triangles, measured from the model.
class FromModel {
 public:
  static constexpr double kNearLimit = 0.75;

  /// \param hausd the smallest \param small bounds that will do at first
  FromModel(const OutputSurface& out, const SurfaceModel& model, const PatchTree& tree,
            double hausd, double small)
      : out_(out), model_(model), tree_(tree), hausd_(hausd), small_(small) {}

  struct Near {
    std::vector<std::int32_t> slots;
    bool all = false;  ///< are to be looked at, or only until all bounds are small
  };

  /// Its facet if it is one, and those where its corners are.
  void begin(std::size_t t, Near& near) const {
    near.slots.clear();
    near.all = false;
    add(out_.facets[t], near);
    for (const std::int32_t facet : out_.anchors[t])
      if (facet >= kNone)
        add(facet, near);
      else if (const std::int32_t edge = SurfaceModel::curve_of(facet);
               std::size_t(edge) < model_.curve_edges())
        for (const std::int32_t f : model_.facets_at_curve(edge)) add(f, near);
  }

  void widen(std::size_t t, Near& near) const {
    const Box box = box_of(out_.corners[t]);
    near.slots.clear();
    near.all = true;
    tree_.near(box, reach_around(box, hausd_), near.slots);
    // The likeliest first: what is far behind it is left out soon.
    const std::int32_t likely = tree_.hint_at(out_.facets[t]).slot;
    const auto at = std::ranges::find(near.slots, likely);
    if (at != near.slots.end())
      std::swap(*at, near.slots.front());
    else if (likely != kNone)
      near.slots.push_back(likely);
  }

  Vec3 at(std::size_t t, double u, double v) const {
    const Corners& k = out_.corners[t];
    return (1 - u - v) * k[0] + u * k[1] + v * k[2];
  }

  void bound(std::size_t t, const Lattice::Block& block, const Near& near,
             std::vector<Measured>& measured) const {
    PointBlock points;
    points.resize(block.count);
    for (std::size_t i = 0; i < points.groups() * PointBlock::kGroup; ++i) {
      const Vec3 p = at(t, block.u[i], block.v[i]);
      points.x[i] = p.x, points.y[i] = p.y, points.z[i] = p.z;
    }
    NearestOfBlock nearest;
    nearest.clear(block.count);
    const Box box = points.box();
    for (const std::int32_t slot : near.slots) {
      tree_.improve(points, box, slot, nearest);
      if (!near.all && nearest.largest2() <= small_ * small_) break;
    }
    for (std::size_t i = 0; i < block.count; ++i)
      measured[std::size_t(block.place[i])] = result(t, nearest.distance2(i), nearest.number(i));
  }

  Measured exact(std::size_t t, const Vec3& x, const Measured& from, double small) const {
    NearestOnModel hint;
    hint.slot = from.slot;
    const NearestOnModel r = tree_.nearest(x, hint, small);
    return result(t, r.place.distance2, r.slot);
  }

 private:
  void add(std::int32_t facet, Near& near) const {
    const std::int32_t slot = tree_.hint_at(facet).slot;
    if (slot != kNone && std::ranges::find(near.slots, slot) == near.slots.end())
      near.slots.push_back(slot);
  }
  Measured result(std::size_t t, double distance2, std::int32_t slot) const {
    return {std::sqrt(distance2), slot == kNone ? 1 : model_.hausd(tree_.facet(slot)),
            std::int32_t(t), slot};
  }

  const OutputSurface& out_;
  const SurfaceModel& model_;
  const PatchTree& tree_;
  double hausd_, small_;
};

/// The model's patches, measured from the output.
class FromOutput {
 public:
  /// Samples are three times as far apart as on the output's triangles: a facet that the output
  /// leaves at 25 degrees was 1.11 away between two of less than 0.75.
  static constexpr double kNearLimit = 0.6;

  /// \param small bounds that will do at first
  FromOutput(const OutputSurface& out, const SurfaceModel& model, const FacetTree& tree,
             double small)
      : model_(model), tree_(tree), small_(small), near_(model.facets(), kNone) {
    for (std::size_t t = 0; t < out.facets.size(); ++t)
      if (const std::int32_t f = out.facets[t]; f >= 0 && std::size_t(f) < near_.size())
        near_[std::size_t(f)] = tree.hint_at(std::int32_t(t)).slot;
  }

  struct Near {
    std::int32_t slot = kNone;
    double small = -1;  ///< bounds that will do
  };

  void begin(std::size_t f, Near& near) const { near = {near_[f], small_}; }
  void widen(std::size_t, Near& near) const { near.small = -1; }

  Vec3 at(std::size_t f, double u, double v) const { return patch(f).at(u, v); }

  void bound(std::size_t f, const Lattice::Block& block, const Near& near,
             std::vector<Measured>& measured) const {
    PointBlock points;
    patch(f).at(block.count, block.u, block.v, points);
    const Box box = points.box();
    const double hausd = model_.hausd(std::int32_t(f)), reach = reach_around(box, hausd);
    NearestOfBlock nearest;
    const bool all = tree_.nearest(points, box, near.slot, reach, near.small, nearest);
    for (std::size_t i = 0; i < block.count; ++i) {
      Measured& m = measured[std::size_t(block.place[i])];
      m = result(f, nearest.distance2(i), nearest.number(i));
      m.exact = all && nearest.distance2(i) < reach * reach;
    }
  }

  Measured exact(std::size_t f, const Vec3& x, const Measured& from, double small) const {
    NearestFacet hint;
    hint.slot = from.slot;
    const NearestFacet r = tree_.nearest_from(x, hint, small);
    return result(f, r.distance2, r.slot);
  }

 private:
  const BezierTriangle& patch(std::size_t f) const {
    return model_.patch_of_facet(std::int32_t(f));
  }
  Measured result(std::size_t f, double distance2, std::int32_t slot) const {
    return {std::sqrt(distance2), model_.hausd(std::int32_t(f)),
            slot == kNone ? kNone : tree_.triangle(slot), slot};
  }

  const SurfaceModel& model_;
  const FacetTree& tree_;
  double small_;
  std::vector<std::int32_t> near_;  ///< slot of a triangle that is likely to be near
};

bool is_before(const Corners& a, const Corners& b) {
  auto key = [](const Corners& t) {
    return std::tie(t[0].x, t[0].y, t[0].z, t[1].x, t[1].y, t[1].z, t[2].x, t[2].y, t[2].z);
  };
  return key(a) < key(b);
}

/// What became of triangles between two surfaces.
struct Changes {
  std::vector<std::int32_t> before_of;  ///< for each one after: the same one before, or none
  std::vector<std::int32_t> after_of;   ///< for each one before
  std::vector<Box> boxes;               ///< of those of one surface alone

  Changes(std::span<const Corners> before, std::span<const Corners> after)
      : before_of(after.size(), kNone), after_of(before.size(), kNone) {
    std::vector<std::int32_t> sorted(before.size());
    parallel_for(sorted.size(), [&](std::size_t i) { sorted[i] = std::int32_t(i); });
    parallel_sort(sorted.begin(), sorted.end(), [&](std::int32_t a, std::int32_t b) {
      if (is_before(before[a], before[b])) return true;
      return !is_before(before[b], before[a]) && a < b;
    });
    parallel_for(after.size(), [&](std::size_t i) {
      const auto at = std::lower_bound(
          sorted.begin(), sorted.end(), after[i],
          [&](std::int32_t b, const Corners& t) { return is_before(before[b], t); });
      if (at != sorted.end() && !is_before(after[i], before[*at])) before_of[i] = *at;
    });
    for (std::size_t i = 0; i < after.size(); ++i)
      if (before_of[i] != kNone) after_of[before_of[i]] = std::int32_t(i);
    add_boxes(before, after_of);
    add_boxes(after, before_of);
  }

 private:
  void add_boxes(std::span<const Corners> triangles, const std::vector<std::int32_t>& other) {
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      if (other[i] == kNone) boxes.push_back(box_of(triangles[i]));
    }
  }
};

/// Where the other surface may have what is nearest to a sample of the facet's patch.
Box reach_of(const BezierTriangle& patch, double farthest) {
  Box box = box_of(patch.corner);  // a Bezier triangle is within the hull of its control points
  for (const auto& points : patch.edge) box.add(box_of(points));
  box.add(patch.center);
  return box.widened(farthest);
}

}  // namespace

double measure_bulge(const SurfaceModel& model) {
  // A cubic patch is smooth: its highest place is missed by little between so many samples.
  const Lattice lattice(6);
  constexpr std::size_t kBatch = 1024;  // after which those that cannot be higher are left out
  constexpr std::size_t kGrain = 32;
  const std::size_t facets = model.facets();
  std::vector<std::pair<double, std::size_t>> highest_first(facets);
  parallel_for(facets, [&](std::size_t f) {
    highest_first[f] = {-offset_bound(model.patch_of_facet(std::int32_t(f))), f};
  });
  parallel_sort(highest_first.begin(), highest_first.end());
  if (facets == 0) return 0;
  if (-highest_first[0].first <= kRounding * least_hausd_of(model)) return -highest_first[0].first;
  std::vector<double> bulge2(facets, 0);
  const auto sample = [&](std::size_t f) {
    const Corners own = model.facet_corners(std::int32_t(f));
    for (const auto& [u, v] : lattice.places()) {
      const Vec3 x = model.patch_of_facet(std::int32_t(f)).at(u, v);
      // The other facets matter only to a sample that would raise the largest distance.
      double d2 = closest_on_triangle(x, own[0], own[1], own[2]).distance2;
      if (d2 <= bulge2[f]) continue;
      bulge2[f] = std::max(bulge2[f], model.facets_distance2(x, d2));
    }
  };
  double bulge = 0;
  for (std::size_t begin = 0; begin < facets; begin += kBatch) {
    if (-highest_first[begin].first <= bulge) break;
    const std::size_t count = std::min(kBatch, facets - begin);
    parallel_for(
        count, [&](std::size_t i) { sample(highest_first[begin + i].second); }, kGrain);
    for (std::size_t i = 0; i < count; ++i)
      bulge = std::max(bulge, std::sqrt(bulge2[highest_first[begin + i].second]));
  }
  return bulge;
}

struct DistanceMeter::Memory {
  Memory(const SurfaceModel& m, const DistanceSampling& s)
      : model(m), sampling(s), least_hausd(least_hausd_of(m)), facets(facets_of(m)) {}

  void forget_what_changed(OutputSurface now) {
    if (out.corners.empty()) {
      run_together([&] { of_out.assign(now.corners.size(), {}); },
                   [&] { of_model.assign(facets.size(), {}); });
      out = std::move(now);
      return;
    }
    if (now.ids == out.ids && now.corners == out.corners) return;
    const Changes changes(out.corners, now.corners);
    std::vector<Sampled> kept(now.corners.size());
    parallel_for(kept.size(), [&](std::size_t t) {
      if (changes.before_of[t] == kNone) return;
      kept[t] = of_out[std::size_t(changes.before_of[t])];
      kept[t].triangle = std::int32_t(t);
    });
    of_out = std::move(kept);
    const BoxTree changed(changes.boxes);
    parallel_for(of_model.size(), [&](std::size_t f) {
      Sampled& s = of_model[f];
      if (s.triangle != kNone) s.triangle = changes.after_of[std::size_t(s.triangle)];
      if (s.triangle == kNone) s.count = 0;
      changed.visit_overlapping(reach_of(model.patch_of_facet(std::int32_t(f)), s.max),
                                [&](std::size_t) { s.count = 0; });
    });
    out = std::move(now);
  }

  /// Triangles that are still facets of the model are no farther from their patches, nor these from
  /// them, than control points are from a flat patch: which is known without samples.
  void bound_own_facets() {
    if (sampling.enough == 0) return;
    parallel_for(std::min(facets.size(), out.corners.size()), [&](std::size_t f) {
      if (out.corners[f] != facets[f]) return;
      Sampled s;
      s.max = offset_bound(model.patch_of_facet(std::int32_t(f)));
      s.worst = s.max / least_hausd, s.hausd = least_hausd;
      s.where = facets[f][0];
      s.triangle = std::int32_t(f), s.count = 1;
      s.exact = s.worst <= kRounding;
      for (Sampled* sampled : {&of_out[f], &of_model[f]})
        if (sampled->count == 0) *sampled = s;
    });
  }

  void sample() {
    const auto is_known = [](const Sampled& s) { return s.count > 0 && s.exact; };
    if (std::ranges::all_of(of_out, is_known) && std::ranges::all_of(of_model, is_known)) return;
    std::optional<FacetTree> tree;
    run_together([&] { tree.emplace(out.corners); },
                 [&] {
                   if (!patches) patches.emplace(model);
                 });
    const double small = sampling.enough * least_hausd;
    const FromModel from_model(out, model, *patches, least_hausd, small);
    Sampler(out.corners, sampling, sampling.step.out, lattices, least_hausd, true, from_model)
        .sample_all(of_out);
    const FromOutput from_output(out, model, *tree, small);
    Sampler(facets, sampling, sampling.step.model, lattices, least_hausd, false, from_output)
        .sample_all(of_model);
  }

  const SurfaceModel& model;
  DistanceSampling sampling;
  double least_hausd;
  std::optional<PatchTree> patches;  ///< once one is asked
  std::vector<Corners> facets;
  Lattices lattices;
  OutputSurface out;
  std::vector<Sampled> of_out, of_model;
};

DistanceMeter::DistanceMeter(const SurfaceModel& model, const DistanceSampling& sampling)
    : memory_(std::make_unique<Memory>(model, sampling)) {}

DistanceMeter::~DistanceMeter() = default;

const SampleSteps& DistanceMeter::steps() const { return memory_->sampling.step; }

SurfaceDistance DistanceMeter::measure(const TetMesh& mesh) {
  Memory& m = *memory_;
  OutputSurface now(mesh);
  prefer_own_facets(m.facets, now);
  m.forget_what_changed(std::move(now));
  m.bound_own_facets();
  m.sample();
  SurfaceDistance result;
  result.out_to_model = fold(m.of_out, m.sampling);
  result.far_triangles = beyond(
      m.of_out, m.sampling.most, [&](std::size_t i) { return m.out.ids[i]; }, m.out.ids);
  result.model_to_out = fold(m.of_model, m.sampling);
  result.far_facets = beyond(
      m.of_model, m.sampling.most, [](std::size_t i) { return std::int32_t(i); }, m.out.ids);
  return result;
}

SurfaceDistance measure_surface_distance(const TetMesh& mesh, const SurfaceModel& model,
                                         double step, double most, double enough) {
  return DistanceMeter(model, {{step, step}, most, enough}).measure(mesh);
}

namespace {

/// Of the longest edges of triangles, the root of the mean square.
double mean_edge(const std::vector<Corners>& triangles) {
  const std::size_t n = triangles.size();
  const double sum = parallel_reduce(
      n, 0.0,
      [&](std::size_t begin, std::size_t end) {
        double here = 0;
        for (std::size_t i = begin; i < end; ++i) here += longest_edge2(triangles[i]);
        return here;
      },
      std::plus<>{});
  return n == 0 ? 0 : std::sqrt(sum / double(n));
}

}  // namespace

SampleSteps default_sample_steps(const TetMesh& mesh, const SurfaceModel& model) {
  constexpr double kStepsAcrossBox = 400;
  // Lattices of 9 and 3 intervals have 55 and 10 points; those on corners and edges count in part.
  constexpr double kMeanIntervals = 9, kMeanModelIntervals = 3;
  const double edge = mean_edge(OutputSurface(mesh).corners);
  const Box box = parallel_reduce(
      model.facets(), Box{},
      [&](std::size_t begin, std::size_t end) {
        Box here;
        for (std::size_t f = begin; f < end; ++f)
          here.add(box_of(model.facet_corners(std::int32_t(f))));
        return here;
      },
      [](Box a, const Box& b) {
        a.add(b);
        return a;
      });
  const double least = box.empty() ? 0 : distance(box.low, box.high) / kStepsAcrossBox;
  const auto step = [&](double intervals) {
    const double wanted = std::max(least, edge / intervals);
    return wanted > 0 ? wanted : 1;  // any does for surfaces without extent
  };
  return {step(kMeanIntervals), step(kMeanModelIntervals)};
}

}  // namespace cavea
