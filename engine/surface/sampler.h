#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

#include "cavea/base/ids.h"
#include "cavea/base/parallel.h"
#include "cavea/surface/distance.h"
#include "cavea/surface/facet_tree.h"
#include "cavea/surface/lattice.h"

namespace cavea {

inline double longest_edge2(const Corners& t) {
  return std::max({distance2(t[0], t[1]), distance2(t[1], t[2]), distance2(t[2], t[0])});
}

/// A sample's distance, or a bound above it, and hausd at the facet that it is from or to.
struct Measured {
  double distance = std::numeric_limits<double>::infinity(), hausd = 1;
  std::int32_t triangle = kNone;  ///< of the output, that it is from or to
  std::int32_t slot = kNone;      ///< where the search ended, which may begin another
  bool exact = false;
};

/// What the samples of one triangle say, or bounds above it.
struct Sampled {
  double max = -1, worst = -1, hausd = 0, sum = 0, area = 0;
  Vec3 where;
  std::int32_t triangle = kNone;
  int count = 0;
  int intervals = 0;  ///< of the lattice
  bool exact = false;

  void add(const Vec3& x, const Measured& m) {
    raise(x, m);
    sum += m.distance;
    ++count;
  }
  /// A place that is looked at because it is far counts for no mean.
  void raise(const Vec3& x, const Measured& m) {
    max = std::max(max, m.distance);
    if (m.distance > worst * m.hausd) {
      worst = m.distance / m.hausd, hausd = m.hausd;
      where = x, triangle = m.triangle;
    }
  }
  /// A bound is no place to go to.
  void add_bound(const Measured& m, double least_hausd) {
    max = std::max(max, m.distance);
    if (m.distance > worst * least_hausd) worst = m.distance / least_hausd, triangle = m.triangle;
    ++count;
  }
};

/// Samples the triangles of one surface. A `Side` knows the other surface:
///   Near                              what of it is looked at for one triangle
///   begin(t, near), widen(t, near)    sets that to what is likely to be nearest; to all around
///   at(t, u, v)                       a place of the triangle
///   bound(t, block, near, measured)   bounds, or exact distances, of a block of places
///   exact(t, x, from, small)          the distance of one; if at most `small`, a bound will do
///   kNearLimit                        between samples so many hausd away there may be one beyond 1
/// None uses what it found for another triangle: which that is depends on the threads.
template <class Side>
class Sampler {
 public:
  /// \param step of the lattices \param may_stop where the first samples are all near: not where
  /// the triangle is far larger than those of the other surface
  Sampler(std::span<const Corners> triangles, const DistanceSampling& sampling, double step,
          const Lattices& lattices, double least_hausd, bool may_stop, const Side& side)
      : triangles_(triangles),
        sampling_(sampling),
        step_(step),
        lattices_(lattices),
        least_hausd_(least_hausd),
        may_stop_(may_stop),
        side_(side) {}

  /// Bounds first, which are near; then what is as far as others is looked at, the farthest first,
  /// until no bound is above the largest distance. Those that have samples keep them.
  void sample_all(std::vector<Sampled>& samples) const {
    parallel_ranges(samples.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      Scratch scratch;
      for (std::size_t t = begin; t < end; ++t)
        if (samples[t].count == 0)
          samples[t] = sample(t, all_exact() ? kEverything : kBoundsOnly, 0, scratch);
    });
    if (!all_exact()) make_exact_what_matters(samples);
  }

 private:
  /// Triangles a task: their cost differs by their samples.
  static constexpr std::size_t kGrain = 32;

  /// What is not beyond these need not be exact.
  struct Floor {
    double max, worst;
    bool is_exceeded_by(const Sampled& s) const { return s.max > max || s.worst > worst; }
  };
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  static constexpr Floor kBoundsOnly{kInfinity, kInfinity}, kEverything{-1, -1};

  struct Scratch {
    typename Side::Near near;
    std::vector<Measured> measured;  ///< by the places of a lattice
    std::size_t apex = 2;            ///< of the triangle: the corner that rows lead to
  };

  bool all_exact() const { return sampling_.enough == 0; }

  int intervals(std::size_t t) const {
    const double wanted = std::ceil(std::sqrt(longest_edge2(triangles_[t])) / step_);
    return int(std::clamp<double>(wanted, Lattice::kMinIntervals, Lattice::kMaxIntervals));
  }

  /// A needle takes fewer rows along its longest edge than that has intervals.
  const Lattice& lattice_of(std::size_t t, int n) const {
    const Corners& k = triangles_[t];
    const double area2 = norm(cross(k[1] - k[0], k[2] - k[0])), longest2 = longest_edge2(k);
    const double share = longest2 > 0 ? area2 / longest2 : 0;  // of the height in that edge
    return lattices_.with_rows(n, int(std::ceil(share * n)));
  }

  /// The corner opposite to the longest edge.
  std::size_t apex_of(std::size_t t) const {
    const Corners& k = triangles_[t];
    const double opposite2[] = {distance2(k[1], k[2]), distance2(k[2], k[0]),
                                distance2(k[0], k[1])};
    return std::size_t(std::max_element(opposite2, opposite2 + 3) - opposite2);
  }

  /// A lattice's place as coordinates of the triangle's own second and third corner.
  static Lattice::Place turned(const Lattice::Place& p, std::size_t apex) {
    const double rest = 1 - p.u - p.v;
    return apex == 2 ? p : apex == 0 ? Lattice::Place{rest, p.u} : Lattice::Place{p.v, rest};
  }

  Vec3 at(std::size_t t, const Lattice::Place& p, std::size_t apex) const {
    const Lattice::Place own = turned(p, apex);
    return side_.at(t, own.u, own.v);
  }

  void bound(std::size_t t, const Lattice::Block& block, Scratch& s) const {
    if (s.apex == 2) return side_.bound(t, block, s.near, s.measured);
    Lattice::Block own = block;
    for (std::size_t i = 0; i < PointBlock::kMost; ++i) {
      const Lattice::Place p = turned({block.u[i], block.v[i]}, s.apex);
      own.u[i] = p.u, own.v[i] = p.v;
    }
    side_.bound(t, own, s.near, s.measured);
  }

  void bound(std::size_t t, const Lattice& lattice, Scratch& s) const {
    s.measured.resize(lattice.places().size());
    for (const Lattice::Block& block : lattice.blocks()) bound(t, block, s);
  }

  /// \param n intervals of the lattice, if known: then nothing is asked that may not do
  Sampled sample(std::size_t t, const Floor& floor, int n, Scratch& scratch) const {
    side_.begin(t, scratch.near);
    scratch.apex = apex_of(t);
    bool is_near = false;
    if (n > 0) {
      side_.widen(t, scratch.near);
    } else {
      n = intervals(t);
      is_near =
          n > Lattice::kMinIntervals && may_stop_ && !all_exact() && are_first_near(t, scratch);
      if (is_near) n = Lattice::kMinIntervals;  // of which the bounds are known by now
    }
    const Lattice& lattice = lattice_of(t, n);
    if (!is_near) bound(t, lattice, scratch);
    return resolve(t, lattice, floor, scratch);
  }

  /// Whether the corners, edge midpoints and centroid are; measured only as far as that needs.
  bool are_first_near(std::size_t t, Scratch& s) const {
    const double near = sampling_.enough * least_hausd_;
    const auto is_near = [&](const Measured& m) { return m.distance <= near; };
    bound(t, lattices_.coarsest(), s);
    if (std::ranges::all_of(s.measured, is_near)) return true;
    side_.widen(t, s.near);
    bound(t, lattices_.coarsest(), s);
    for (;;) {
      const std::size_t i = farthest_bound(s.measured);
      if (i == s.measured.size() || is_near(s.measured[i])) return true;
      Measured& m = s.measured[i];
      m = side_.exact(t, at(t, lattices_.coarsest().places()[i], s.apex), m, near);
      m.exact = m.distance > near;
      if (m.distance > sampling_.enough * m.hausd) return false;
    }
  }

  /// Of those that are not exact; their number if all are.
  static std::size_t farthest_bound(const std::vector<Measured>& all) {
    std::size_t farthest = all.size();
    for (std::size_t i = 0; i < all.size(); ++i)
      if (!all[i].exact && (farthest == all.size() || all[i].distance > all[farthest].distance))
        farthest = i;
    return farthest;
  }

  /// Makes exact what is beyond the floor, and then all that raises the triangle's maximum.
  Sampled resolve(std::size_t t, const Lattice& lattice, Floor floor, Scratch& scratch) const {
    std::vector<Measured>& measured = scratch.measured;
    Sampled s;
    for (const Measured& m : measured)
      if (m.exact) s.add({}, m);
    bool done = false;
    for (;;) {
      const std::size_t i = farthest_bound(measured);
      const double small =
          std::min(std::max(floor.max, s.max), std::max(floor.worst, s.worst) * least_hausd_);
      done = done || i == measured.size();
      if (i == measured.size() || (!all_exact() && measured[i].distance <= small)) {
        if (done || !floor.is_exceeded_by(s)) break;
        floor = kEverything, done = true;
        continue;
      }
      Measured& m = measured[i];
      const Vec3 x = at(t, lattice.places()[i], scratch.apex);
      m = side_.exact(t, x, m, all_exact() ? -1 : small);
      m.exact = all_exact() || m.distance > small;
      if (m.exact) s.add(x, m);
    }
    return summary(t, lattice, done, scratch);
  }

  Sampled summary(std::size_t t, const Lattice& lattice, bool exact, Scratch& scratch) const {
    const std::vector<Measured>& measured = scratch.measured;
    Sampled s;
    for (std::size_t i = 0; i < measured.size(); ++i)
      if (measured[i].exact)
        s.add(at(t, lattice.places()[i], scratch.apex), measured[i]);
      else if (!exact)
        s.add_bound(measured[i], least_hausd_);
    s.exact = exact;
    s.intervals = lattice.intervals();
    if (exact && s.worst > Side::kNearLimit)
      for (const Lattice::Place& peak : peaks(lattice, measured, s.worst))
        climb(t, peak, {0.5 / lattice.intervals(), 0.5 / lattice.rows()}, scratch, s);
    const Corners& k = triangles_[t];
    s.area = norm(cross(k[1] - k[0], k[2] - k[0])) / 2;
    return s;
  }

  /// The worst place, and those nearly as bad that are not beside a worse one: what is highest
  /// between places need not be at the highest of them.
  static std::vector<Lattice::Place> peaks(const Lattice& lattice,
                                           const std::vector<Measured>& measured, double worst) {
    constexpr double kNearlyWorst = 0.8, kApart = 1.5;  // of the worst; in intervals
    constexpr std::size_t kMostPeaks = 8;
    std::vector<std::pair<double, std::size_t>> high;
    for (std::size_t i = 0; i < measured.size(); ++i)
      if (const double d = measured[i].distance / measured[i].hausd; d >= kNearlyWorst * worst)
        high.emplace_back(-d, i);
    std::ranges::sort(high);
    std::vector<Lattice::Place> found;
    for (const auto& [d, i] : high) {
      if (found.size() == kMostPeaks) break;
      const Lattice::Place& p = lattice.places()[i];
      const auto is_beside = [&](const Lattice::Place& q) {
        const double u = (p.u - q.u) * lattice.intervals(), v = (p.v - q.v) * lattice.rows();
        return std::max({std::abs(u), std::abs(v), std::abs(u + v)}) < kApart;
      };
      if (std::ranges::none_of(found, is_beside)) found.push_back(p);
    }
    return found;
  }

  /// Adds samples around a peak of a triangle and around what is higher then, nearer once none is.
  void climb(std::size_t t, Lattice::Place peak, Lattice::Place step, Scratch& scratch,
             Sampled& s) const {
    constexpr int kMostRings = 8, kHalvings = 4;
    constexpr double kOnEdge = 1e-12;  // rounding of what is on the border of the triangle
    std::vector<Lattice::Place> places;
    for (int ring = 0, halvings = 0; ring < kMostRings && halvings < kHalvings; ++ring) {
      places.clear();
      // Along rows, and along both edges that lead from these to the apex.
      const Lattice::Place ways[] = {{0, 0},       {step.u, 0},       {-step.u, 0},     {0, step.v},
                                     {0, -step.v}, {-step.v, step.v}, {step.v, -step.v}};
      for (const Lattice::Place& way : ways) {
        const Lattice::Place p{peak.u + way.u, peak.v + way.v};
        if (p.u >= -kOnEdge && p.v >= -kOnEdge && p.u + p.v <= 1 + kOnEdge) places.push_back(p);
      }
      if (places.empty()) return;
      const std::size_t highest = look_at(t, places, scratch, s);
      peak = places[highest];
      if (highest == 0) step = {step.u / 2, step.v / 2}, ++halvings;
    }
  }

  /// \return which of the places is farthest
  std::size_t look_at(std::size_t t, const std::vector<Lattice::Place>& places, Scratch& scratch,
                      Sampled& s) const {
    scratch.measured.resize(places.size());
    bound(t, Lattice::block_of(places), scratch);
    std::size_t farthest = 0;
    double most = -1;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double small = std::min(s.max, s.worst * least_hausd_);
      const Vec3 x = at(t, places[i], scratch.apex);
      Measured m = scratch.measured[i];
      if (!m.exact && (all_exact() || m.distance > small))
        m = side_.exact(t, x, m, all_exact() ? -1 : small);
      s.raise(x, m);
      if (m.distance > most * m.hausd) most = m.distance / m.hausd, farthest = i;
    }
    return farthest;
  }

  void make_exact_what_matters(std::vector<Sampled>& samples) const {
    // After each batch those that cannot be farther are left out: the first ones tell most.
    constexpr std::size_t kFirstBatch = 64, kMostInBatch = 1024;
    const double always = std::min(Side::kNearLimit, sampling_.most);
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
    for (std::size_t batch = kFirstBatch;; batch = std::min(2 * batch, kMostInBatch)) {
      const Floor floor{max, std::min(worst, always)};
      std::erase_if(open, [&](std::size_t t) {
        return samples[t].exact || !floor.is_exceeded_by(samples[t]);
      });
      if (open.empty()) return;
      const auto end = open.begin() + std::ptrdiff_t(std::min(batch, open.size()));
      std::partial_sort(open.begin(), end, open.end(), is_farther);
      const std::size_t count = std::size_t(end - open.begin());
      parallel_ranges(count, kGrain, [&](std::size_t first, std::size_t last) {
        Scratch scratch;
        for (std::size_t i = first; i < last; ++i)
          samples[open[i]] = sample(open[i], floor, samples[open[i]].intervals, scratch);
      });
      for (auto t = open.begin(); t != end; ++t)
        if (samples[*t].exact)
          max = std::max(max, samples[*t].max), worst = std::max(worst, samples[*t].worst);
    }
  }

  std::span<const Corners> triangles_;
  const DistanceSampling& sampling_;
  double step_;
  const Lattices& lattices_;
  double least_hausd_;
  bool may_stop_;
  const Side& side_;
};

}  // namespace cavea
