#include "cavea/mesh/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <tuple>

#include "cavea/base/buckets.h"
#include "cavea/base/parallel.h"
#include "cavea/base/wide.h"
#include "cavea/geometry/centroid.h"
#include "cavea/geometry/dihedral.h"
#include "cavea/geometry/metric.h"
#include "cavea/geometry/tet_block.h"
#include "cavea/mesh/edge_shares.h"

namespace cavea {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <std::size_t N>
void add(std::array<std::int64_t, N>& sum, const std::array<std::int64_t, N>& more) {
  for (std::size_t i = 0; i < N; ++i) sum[i] += more[i];
}

/// The bin of x among `bins` equal ones from 0 to `top`; what lies outside goes to the ends.
std::size_t equal_bin(double x, double top, std::size_t bins) {
  if (!(x > 0)) return 0;
  return std::min(bins - 1, std::size_t(x / top * double(bins)));
}

constexpr double kDegree = std::numbers::pi / 180;

constexpr std::size_t kAngleBins =
    std::tuple_size_v<decltype(QualityStatistics::dihedral_histogram)>;

/// The cosines of the angles at which the bins of angles end, but for the last one, which fall.
const std::array<double, kAngleBins - 1>& bin_ends() {
  static const auto ends = [] {
    std::array<double, kAngleBins - 1> cosines;
    for (std::size_t k = 0; k < cosines.size(); ++k)
      cosines[k] = std::cos(double(k + 1) * 180 / double(kAngleBins) * kDegree);
    return cosines;
  }();
  return ends;
}

/// How many of some cosines are of an angle at or beyond an end.
CAVEA_WIDE std::int64_t count_beyond(std::size_t n, const double* __restrict cosines, double end) {
  std::int64_t count = 0;
  for (std::size_t i = 0; i < n; ++i) count += cosines[i] <= end;
  return count;
}

/// Whether all of some cosines are numbers between the two.
CAVEA_WIDE bool all_between(std::size_t n, const double* __restrict cosines, double low,
                            double high) {
  std::int64_t count = 0;
  for (std::size_t i = 0; i < n; ++i) count += (cosines[i] >= low) & (cosines[i] <= high);
  return count == std::int64_t(n);
}

struct QualitySum {
  QualityStatistics result;
  double sum = 0;
  std::int64_t tets = 0;
  double largest_cosine = -kInfinity, smallest_cosine = kInfinity;  ///< of the angles so far
  std::int64_t angles = 0;                                          ///< counted by their cosines
  std::array<std::int64_t, kAngleBins - 1> beyond{};  ///< of those, at or beyond each end of a bin

  QualitySum() {
    result.worst = result.smallest_dihedral = kInfinity;
    result.largest_dihedral = -kInfinity;
  }
  void add_tets(const TetMesh& mesh, std::size_t begin, std::size_t end) {
    TetBlock block;
    std::array<TetId, TetBlock::kMost> ids;
    for (std::size_t t = begin; t < end; ++t) {
      if (mesh.tet_alive(TetId(t))) {
        ids[block.size()] = TetId(t);
        block.add(mesh.corners(TetId(t)));
      }
      if (!block.full() && t + 1 < end) continue;
      add_block(block, ids);
      block.clear();
    }
  }
  void add_block(TetBlock& block, std::span<const TetId> ids) {
    const TetBlock::Row& qualities = block.qualities();
    for (std::size_t i = 0; i < block.size(); ++i) add_quality(ids[i], qualities[i], block, i);
    const std::array<TetBlock::Row, 6>& cosines = block.cosines();
    for (std::size_t e = 0; e < cosines.size(); ++e) add_angles(cosines[e], block, e);
  }
  void add_quality(TetId t, double quality, const TetBlock& block, std::size_t i) {
    ++tets;
    sum += quality;
    ++result.histogram[equal_bin(quality, 1, result.histogram.size())];
    if (quality <= kFlat) result.flat.push_back({t, centroid(block[i])});
    if (quality < result.worst) {
      result.worst = quality;
      result.worst_tet = t;
    }
  }
  /// The angles at one edge of each tet. Their bins are told by their cosines, all at once for each
  /// end of a bin, but for those that are near the ends of the scale or no numbers.
  void add_angles(const TetBlock::Row& cosines, const TetBlock& block, std::size_t edge) {
    constexpr double kNearEnd = 0.999;
    const std::size_t n = block.size();
    angles += std::int64_t(n);
    for (std::size_t k = 0; k < beyond.size(); ++k)
      beyond[k] += count_beyond(n, cosines.data(), bin_ends()[k]);
    // Only for these and for the smallest and largest so far is the arc tangent worth its time.
    if (all_between(n, cosines.data(), std::max(smallest_cosine, -kNearEnd),
                    std::min(largest_cosine, kNearEnd)))
      return;
    for (std::size_t i = 0; i < n; ++i) {
      const bool is_clear = std::abs(cosines[i]) <= kNearEnd;
      if (is_clear && cosines[i] <= largest_cosine && cosines[i] >= smallest_cosine) continue;
      const double angle = angle_at(block[i], edge);
      add_extreme(angle);
      if (!is_clear) count_by_angle(cosines[i], angle);
    }
  }
  static double angle_at(const std::array<Vec3, 4>& p, std::size_t edge) {
    const auto& e = kEdgeVertices[edge];
    return dihedral(p[e[0]], p[e[1]], p[e[2]], p[e[3]]);
  }
  void add_extreme(double angle) {
    result.smallest_dihedral = std::min(result.smallest_dihedral, angle);
    result.largest_dihedral = std::max(result.largest_dihedral, angle);
    largest_cosine = std::cos(result.smallest_dihedral * kDegree);
    smallest_cosine = std::cos(result.largest_dihedral * kDegree);
  }
  /// Takes back that an angle was counted by its cosine.
  void count_by_angle(double cosine, double angle) {
    --angles;
    for (std::size_t k = 0; k < beyond.size(); ++k) beyond[k] -= cosine <= bin_ends()[k];
    ++result.dihedral_histogram[equal_bin(angle, 180, kAngleBins)];
  }
  /// The histogram of all angles, those counted by their cosines, too.
  void finish_histogram() {
    for (std::size_t k = 0; k < kAngleBins; ++k)
      result.dihedral_histogram[k] +=
          (k == 0 ? angles : beyond[k - 1]) - (k + 1 == kAngleBins ? 0 : beyond[k]);
  }
  /// `next` holds tets of larger ids.
  static QualitySum combine(QualitySum a, const QualitySum& next) {
    const QualityStatistics& b = next.result;
    a.sum += next.sum;
    a.tets += next.tets;
    a.result.flat.insert(a.result.flat.end(), b.flat.begin(), b.flat.end());
    add(a.result.histogram, b.histogram);
    add(a.result.dihedral_histogram, b.dihedral_histogram);
    if (b.worst < a.result.worst) {
      a.result.worst = b.worst;
      a.result.worst_tet = b.worst_tet;
    }
    a.result.smallest_dihedral = std::min(a.result.smallest_dihedral, b.smallest_dihedral);
    a.result.largest_dihedral = std::max(a.result.largest_dihedral, b.largest_dihedral);
    return a;
  }
};

struct LengthSum {
  LengthStatistics result;
  double sum = 0;

  LengthSum() {
    result.shortest = kInfinity;
    result.longest = -kInfinity;
  }
  void add_edge(const TetMesh& mesh, VertexId a, VertexId b) {
    const Vec3 &p = mesh.points[a], &q = mesh.points[b];
    const double length =
        metric_length(distance(p, q), double(mesh.sizes[a]), double(mesh.sizes[b]));
    ++result.edges;
    sum += length;
    result.conforming += length >= kShortEdge && length <= kLongEdge;
    // All are compared, since a search would guess wrong at every step.
    std::size_t bin = 0;
    for (const double end : kLengthBins) bin += end <= length;
    ++result.histogram[bin];
    result.shortest = std::min(result.shortest, length);
    if (length > result.longest) {
      result.longest = length;
      result.longest_place = 0.5 * (p + q);
    }
  }
  /// `next` holds edges of larger vertices.
  static LengthSum combine(LengthSum a, const LengthSum& next) {
    const LengthStatistics& b = next.result;
    a.sum += next.sum;
    a.result.edges += b.edges;
    a.result.conforming += b.conforming;
    add(a.result.histogram, b.histogram);
    a.result.shortest = std::min(a.result.shortest, b.shortest);
    if (b.longest > a.result.longest) {
      a.result.longest = b.longest;
      a.result.longest_place = b.longest_place;
    }
    return a;
  }
};

/// For each vertex the other ends of the edges whose smaller vertex it is, once or more often.
Buckets edge_ends(const TetMesh& mesh) {
  return Buckets(mesh.tets.size(), mesh.points.size(), [&](std::size_t t, auto&& put) {
    if (!mesh.tet_alive(TetId(t))) return;
    EdgeShare(mesh, TetId(t)).for_each([&](const auto& e) {
      const VertexId a = mesh.tets[t][e[0]], b = mesh.tets[t][e[1]];
      put(std::min(a, b), static_cast<std::uint32_t>(std::max(a, b)));
    });
  });
}

}  // namespace

QualityStatistics quality_statistics(const TetMesh& mesh) {
  const QualitySum total = parallel_reduce(
      mesh.tets.size(), QualitySum{},
      [&](std::size_t begin, std::size_t end) {
        QualitySum here;
        here.add_tets(mesh, begin, end);
        here.finish_histogram();
        return here;
      },
      QualitySum::combine);
  if (total.tets == 0) return {};
  QualityStatistics out = total.result;
  out.mean = total.sum / double(total.tets);
  out.worst_place = centroid(mesh.corners(out.worst_tet));
  return out;
}

double mean_quality(const TetMesh& mesh) {
  struct Sum {
    double quality = 0;
    std::int64_t tets = 0;
  };
  const Sum sum = parallel_reduce(
      mesh.tets.size(), Sum{},
      [&](std::size_t begin, std::size_t end) {
        Sum here;
        for (std::size_t t = begin; t < end; ++t)
          if (mesh.tet_alive(TetId(t))) here.quality += mesh.qualities[t], ++here.tets;
        return here;
      },
      [](const Sum& a, const Sum& b) {
        return Sum{a.quality + b.quality, a.tets + b.tets};
      });
  return sum.tets == 0 ? 0 : sum.quality / double(sum.tets);
}

LengthStatistics length_statistics(const TetMesh& mesh) {
  Buckets edges = edge_ends(mesh);
  const LengthSum total = parallel_reduce(
      edges.keys(), LengthSum{},
      [&](std::size_t begin, std::size_t end) {
        LengthSum here;
        for (std::size_t a = begin; a < end; ++a)
          for (const std::uint32_t b : rising_once(edges.of(a)))
            here.add_edge(mesh, VertexId(a), static_cast<VertexId>(b));
        return here;
      },
      LengthSum::combine);
  if (total.result.edges == 0) return {};
  LengthStatistics out = total.result;
  out.mean = total.sum / double(out.edges);
  return out;
}

}  // namespace cavea
