#include "cavea/surface/distance.h"

#include <cmath>
#include <tuple>

#include "cavea/base/parallel.h"
#include "cavea/geometry/closest.h"
#include "cavea/surface/facet_tree.h"
#include "cavea/surface/patch_tree.h"

namespace cavea {
namespace {

/// 276 lattice points; a triangle that needs more at the caller's step is far larger than the rest.
constexpr int kMaxIntervals = 22;
/// Corners and edge midpoints.
constexpr int kMinIntervals = 2;
/// Triangles a task: their cost differs by their samples.
constexpr std::size_t kGrain = 32;

double longest_edge2(const Corners& t) {
  return std::max({distance2(t[0], t[1]), distance2(t[1], t[2]), distance2(t[2], t[0])});
}

/// Calls f(u, v) on the lattice of n intervals an edge, and on the edge midpoints and the centroid
/// where the lattice misses them: these first, since they are mostly the farthest.
template <class F>
void for_each_sample(int n, F&& f) {
  if (n % 3 != 0) f(1.0 / 3, 1.0 / 3);
  if (n % 2 != 0) f(0.5, 0.0), f(0.5, 0.5), f(0.0, 0.5);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n - j; ++i) f(double(i) / n, double(j) / n);
}

/// A sample's distance, and hausd at the facet that it is from or to.
struct Measured {
  double distance, hausd;
  std::int32_t triangle = kNone;  ///< of the output, that it is from or to
};

/// What the samples of one triangle say, or bounds above it.
struct Sampled {
  double max = -1, worst = -1, hausd = 0, sum = 0, area = 0;
  Vec3 where;
  std::int32_t triangle = kNone;
  int count = 0;
  bool exact = false;

  void add(const Vec3& x, const Measured& m) {
    max = std::max(max, m.distance);
    if (m.distance > worst * m.hausd) {
      worst = m.distance / m.hausd, hausd = m.hausd;
      where = x, triangle = m.triangle;
    }
    sum += m.distance;
    ++count;
  }
};

int intervals(const Corners& k, double step) {
  const double wanted = std::ceil(std::sqrt(longest_edge2(k)) / step);
  return int(std::clamp<double>(wanted, kMinIntervals, kMaxIntervals));
}

/// Between the samples of a triangle that are so many hausd away there may be one beyond 1.
constexpr double kNearLimit = 0.75;

/// Adds samples around the worst one of a triangle, nearer and nearer, and around what is worse
/// then. \param worst_at its barycentric coordinates, which add(u, v) keeps
template <class Add>
void climb(const std::array<double, 2>& worst_at, double step, Add&& add) {
  constexpr int kHalvings = 3;
  constexpr int kDirections[][2] = {{1, 0}, {-1, 1}, {0, -1}, {0, 1}, {1, -1}, {-1, 0}};
  for (int k = 0; k < kHalvings; ++k, step /= 2) {
    const auto [u, v] = worst_at;
    for (const auto& [i, j] : kDirections) {
      const double x = u + i * step, y = v + j * step;
      if (x >= 0 && y >= 0 && x + y <= 1) add(x, y);
    }
  }
}

/// Samples the triangles of one surface. distance_from() makes a function of the sample x for each
/// triangle in turn, so that a search may begin where it ended for the sample before. Never where
/// another triangle's ended: which one that is depends on the threads. Its second argument is a
/// distance so small that it need not be exact, but may be that from where the search begins.
template <class At, class DistanceFrom>
class Sampler {
 public:
  /// \param may_stop where the first samples are all near: not where the triangle is far larger
  /// than those of the other surface
  Sampler(std::span<const Corners> triangles, const DistanceSampling& sampling, double least_hausd,
          bool may_stop, At at, DistanceFrom distance_from)
      : triangles_(triangles),
        sampling_(sampling),
        least_hausd_(least_hausd),
        may_stop_(may_stop),
        at_(std::move(at)),
        distance_from_(std::move(distance_from)) {}

  /// Bounds first, which are near; then what is as far as others is looked at, the farthest first,
  /// until no bound is above the largest distance. Those that have samples keep them.
  void sample_all(std::vector<Sampled>& samples) const {
    const bool all_exact = sampling_.enough == 0;
    parallel_for(
        samples.size(),
        [&](std::size_t t) {
          if (samples[t].count == 0) samples[t] = sample(t, all_exact);
        },
        kGrain);
    if (!all_exact) make_exact_what_matters(samples);
  }

 private:
  /// Of all samples or with bounds of them, which are no less.
  Sampled sample(std::size_t t, bool exact) const {
    const Corners& k = triangles_[t];
    Sampled s;
    auto distance = distance_from_(t);
    std::array<double, 2> worst_at{};
    auto small_enough = [&] {
      if (!exact) return sampling_.enough * least_hausd_;
      return sampling_.enough > 0 ? std::min(s.max, s.worst * least_hausd_) : -1;
    };
    auto add = [&](double u, double v) {
      const double before = s.worst;
      const Vec3 x = at_(t, u, v);
      s.add(x, distance(x, small_enough()));
      if (s.worst > before) worst_at = {u, v};
    };
    const int n = intervals(k, sampling_.step);
    if (n > kMinIntervals && sampling_.enough > 0) for_each_sample(kMinIntervals, add);
    if (s.count == 0 || !may_stop_ || s.worst > sampling_.enough) for_each_sample(n, add);
    if (exact && s.worst > kNearLimit) climb(worst_at, 0.5 / n, add);
    s.area = norm(cross(k[1] - k[0], k[2] - k[0])) / 2;
    s.exact = exact;
    return s;
  }

  void make_exact_what_matters(std::vector<Sampled>& samples) const {
    constexpr std::size_t kBatch = 1024;  // after which those that cannot be farther are left out
    const double always = std::min(kNearLimit, sampling_.most);
    double max = -1, worst = -1;
    std::vector<std::size_t> open;
    for (std::size_t t = 0; t < samples.size(); ++t)
      if (const Sampled& s = samples[t]; !s.exact)
        open.push_back(t);
      else
        max = std::max(max, s.max), worst = std::max(worst, s.worst);
    auto is_farther = [&](std::size_t a, std::size_t b) {
      return std::tie(samples[b].worst, a) < std::tie(samples[a].worst, b);
    };
    for (;;) {
      std::erase_if(open, [&](std::size_t t) {
        const Sampled& s = samples[t];
        return s.exact || (s.max <= max && s.worst <= worst && s.worst <= always);
      });
      if (open.empty()) return;
      const auto end = open.begin() + std::ptrdiff_t(std::min(kBatch, open.size()));
      std::partial_sort(open.begin(), end, open.end(), is_farther);
      const std::size_t count = std::size_t(end - open.begin());
      parallel_for(
          count, [&](std::size_t i) { samples[open[i]] = sample(open[i], true); }, kGrain);
      for (auto t = open.begin(); t != end; ++t)
        max = std::max(max, samples[*t].max), worst = std::max(worst, samples[*t].worst);
    }
  }

  std::span<const Corners> triangles_;
  const DistanceSampling& sampling_;
  double least_hausd_;
  bool may_stop_;
  At at_;
  DistanceFrom distance_from_;
};

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
  std::vector<std::int32_t> facets;  ///< as a corner's anchor says: of this model, or of another

  OutputSurface() = default;
  explicit OutputSurface(const TetMesh& mesh) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Triangle& s = mesh.triangles[t];
      if (!s.alive()) continue;
      ids.push_back(TriangleId(t));
      corners.push_back({mesh.points[s.v[0]], mesh.points[s.v[1]], mesh.points[s.v[2]]});
      facets.push_back(kNone);
      for (const VertexId v : s.v) facets.back() = std::max(facets.back(), mesh.anchors[v].facet);
    }
  }
};

/// Triangles that are a facet of the model are nearest to that one.
void prefer_own_facets(std::span<const Corners> facets, OutputSurface& out) {
  for (std::size_t t = 0; t < std::min(facets.size(), out.corners.size()); ++t)
    if (out.corners[t] == facets[t]) out.facets[t] = std::int32_t(t);
}

std::vector<Corners> facets_of(const SurfaceModel& model) {
  std::vector<Corners> facets(model.facets());
  parallel_for(facets.size(),
               [&](std::size_t f) { facets[f] = model.facet_corners(std::int32_t(f)); });
  return facets;
}

Vec3 on_flat(const Corners& t, double u, double v) {
  return (1 - u - v) * t[0] + u * t[1] + v * t[2];
}

double least_hausd_of(const SurfaceModel& model) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < model.facets(); ++f)
    least = std::min(least, model.hausd(std::int32_t(f)));
  return least;
}

void sample_output(const OutputSurface& out, const SurfaceModel& model, const PatchTree& tree,
                   const DistanceSampling& sampling, std::vector<Sampled>& samples) {
  const Sampler sampler(
      out.corners, sampling, least_hausd_of(model), true,
      [&](std::size_t t, double u, double v) { return on_flat(out.corners[t], u, v); },
      [&](std::size_t t) {
        return [&, t, last = tree.hint_at(out.facets[t])](const Vec3& x, double small) mutable {
          last = tree.nearest(x, last, small);
          const double hausd = last.facet == kNone ? 1 : model.hausd(last.facet);
          return Measured{std::sqrt(last.place.distance2), hausd, std::int32_t(t)};
        };
      });
  sampler.sample_all(samples);
}

void sample_model(const OutputSurface& out, const SurfaceModel& model,
                  std::span<const Corners> facets, const DistanceSampling& sampling,
                  std::vector<Sampled>& samples) {
  const FacetTree tree(out.corners);
  std::vector<std::int32_t> near(facets.size(), kNone);
  for (std::size_t t = 0; t < out.facets.size(); ++t)
    if (const std::int32_t f = out.facets[t]; f >= 0 && std::size_t(f) < near.size())
      near[std::size_t(f)] = std::int32_t(t);
  const Sampler sampler(
      facets, sampling, least_hausd_of(model), false,
      [&](std::size_t f, double u, double v) {
        return model.patch_of_facet(std::int32_t(f)).at(u, v);
      },
      [&](std::size_t f) {
        const double hausd = model.hausd(std::int32_t(f));
        return [&tree, hausd, last = tree.hint_at(near[f])](const Vec3& x, double small) mutable {
          last = tree.nearest_from(x, last, small);
          return Measured{std::sqrt(last.distance2), hausd, last.facet};
        };
      });
  sampler.sample_all(samples);
}

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
      if (other[i] != kNone) continue;
      Box& box = boxes.emplace_back();
      for (const Vec3& p : triangles[i]) box.add(p);
    }
  }
};

/// Where the other surface may have what is nearest to a sample of the facet's patch.
Box reach_of(const BezierTriangle& patch, double farthest) {
  Box box;  // a Bezier triangle is within the hull of its control points
  for (const Vec3& p : patch.corner) box.add(p);
  for (const auto& points : patch.edge)
    for (const Vec3& p : points) box.add(p);
  box.add(patch.center);
  const Vec3 reach{farthest, farthest, farthest};
  return {box.low - reach, box.high + reach};
}

}  // namespace

double measure_bulge(const SurfaceModel& model) {
  // A cubic patch is smooth: its highest place is missed by little between so many samples.
  constexpr int kBulgeIntervals = 6;
  constexpr std::size_t kBatch = 1024;  // after which those that cannot be higher are left out
  const std::vector<Corners> facets = facets_of(model);
  std::vector<std::pair<double, std::size_t>> highest_first(facets.size());
  parallel_for(facets.size(), [&](std::size_t f) {
    highest_first[f] = {-bulge_bound(model.patch_of_facet(std::int32_t(f))), f};
  });
  parallel_sort(highest_first.begin(), highest_first.end());
  const FacetTree tree(facets);
  std::vector<double> bulge2(facets.size(), 0);
  const auto sample = [&](std::size_t f) {
    const Corners& own = facets[f];
    for_each_sample(kBulgeIntervals, [&](double u, double v) {
      const Vec3 x = model.patch_of_facet(std::int32_t(f)).at(u, v);
      // The other facets matter only to a sample that would raise the largest distance.
      double d2 = closest_on_triangle(x, own[0], own[1], own[2]).distance2;
      if (d2 <= bulge2[f]) return;
      if (const NearestFacet r = tree.nearest(x, d2); r.facet != kNone) d2 = r.distance2;
      bulge2[f] = std::max(bulge2[f], d2);
    });
  };
  double bulge = 0;
  for (std::size_t begin = 0; begin < facets.size(); begin += kBatch) {
    if (-highest_first[begin].first <= bulge) break;
    const std::size_t count = std::min(kBatch, facets.size() - begin);
    parallel_for(
        count, [&](std::size_t i) { sample(highest_first[begin + i].second); }, kGrain);
    for (std::size_t i = 0; i < count; ++i)
      bulge = std::max(bulge, std::sqrt(bulge2[highest_first[begin + i].second]));
  }
  return bulge;
}

struct DistanceMeter::Memory {
  Memory(const SurfaceModel& m, const DistanceSampling& s)
      : model(m), sampling(s), tree(m), facets(facets_of(m)), of_model(facets.size()) {}

  void forget_what_changed(OutputSurface now) {
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

  const SurfaceModel& model;
  DistanceSampling sampling;
  PatchTree tree;
  std::vector<Corners> facets;
  OutputSurface out;
  std::vector<Sampled> of_out, of_model;
};

DistanceMeter::DistanceMeter(const SurfaceModel& model, const DistanceSampling& sampling)
    : memory_(std::make_unique<Memory>(model, sampling)) {}

DistanceMeter::~DistanceMeter() = default;

SurfaceDistance DistanceMeter::measure(const TetMesh& mesh) {
  Memory& m = *memory_;
  OutputSurface now(mesh);
  prefer_own_facets(m.facets, now);
  m.forget_what_changed(std::move(now));
  sample_output(m.out, m.model, m.tree, m.sampling, m.of_out);
  sample_model(m.out, m.model, m.facets, m.sampling, m.of_model);
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
  return DistanceMeter(model, {step, most, enough}).measure(mesh);
}

double default_sample_step(const TetMesh& mesh, const SurfaceModel& model) {
  constexpr double kStepsAcrossBox = 400;
  // A lattice of 9 intervals has 55 points.
  constexpr double kMeanIntervals = 9;
  Box box;
  auto mean_edge = [](std::span<const Corners> triangles) {
    double sum = 0;
    for (const Corners& t : triangles) sum += longest_edge2(t);
    return triangles.empty() ? 0 : std::sqrt(sum / double(triangles.size()));
  };
  const std::vector<Corners> facets = facets_of(model);
  for (const Corners& t : facets)
    for (const Vec3& p : t) box.add(p);
  const double coarse = std::max(mean_edge(facets), mean_edge(OutputSurface(mesh).corners));
  const double diagonal = facets.empty() ? 0 : distance(box.low, box.high);
  // Any step does for surfaces without extent.
  const double step = std::max(diagonal / kStepsAcrossBox, coarse / kMeanIntervals);
  return step > 0 ? step : 1;
}

}  // namespace cavea
