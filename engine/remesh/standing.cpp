#include "cavea/remesh/standing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cavea/base/ids_where.h"
#include "cavea/base/parallel.h"
#include "cavea/field/own_sizes.h"
#include "cavea/geometry/metric.h"
#include "cavea/remesh/room.h"
#include "cavea/remesh/stubborn.h"

namespace cavea {
namespace {

/// Mean qualities that runs reach where the size is uniform, and where it varies: 0.82 to 0.92, and
/// 0.77 to 0.84, on bodies of all kinds. A mesh below may have something to gain, but if it is thin
/// everywhere.
constexpr double kUniformMean = 0.80, kVaryingMean = 0.77;

/// Runs from two meshes of the same sizes differ by less in the mean quality, by 0.0125 in a plate
/// as thick as one size, and in the share of poor tets.
constexpr double kGain = 0.015, kPoorGain = 0.01;
/// The same for the percent of lengths that conform: the sizes are those of another surface.
constexpr double kConformGain = 2.5;
/// The same for the worst quality, which is that of a single tet.
constexpr double kWorstGain = 0.05;

/// Lengths that no result has where operators were free. Within these bounds a result is also in
/// the sizes that follow from its own surface, which is not quite that of the input.
constexpr double kTooLong = 2.6, kTooShort = 0.3;

/// More poor tets than this share are not exceptions.
constexpr double kFew = 0.01;

/// Results may have so many by chance, and lengths that are beyond by so much: seen are 3 of 17
/// thousand, 246 of 449 thousand and a length of 0.22.
constexpr double kHardlyAny = 0.001, kHardlyBeyond = 1.5;

bool is_poor(const TetMesh& m, TetId t) {
  if (m.qualities[t] < kPoorQuality) return true;
  return std::ranges::any_of(kEdgeVertices, [&](const auto& e) {
    const VertexId a = m.tets[t][e[0]], b = m.tets[t][e[1]];
    const double length2 = distance2(m.points[a], m.points[b]), h0 = m.sizes[a], h1 = m.sizes[b];
    return length_exceeds(length2, h0, h1, kTooLong) || !length_exceeds(length2, h0, h1, kTooShort);
  });
}

/// Of quality below 0.4, which is kPoorQuality: four bins of ten.
double share_of_poor(const QualityStatistics& q) {
  const auto& bins = q.histogram;
  return double(std::accumulate(bins.begin(), bins.begin() + 4, std::int64_t{0})) /
         double(std::accumulate(bins.begin(), bins.end(), std::int64_t{0}));
}

/// Whether the quality is that of results, the mean length at least `finest`, and few edges are too
/// long.
bool is_between(const MeshSummary& now, const InCurvedSizes& curved, const Options& options,
                double finest) {
  // Facets that fit their surface may be long beside sizes that follow from how they bend: smaller
  // ones bend in narrower strips.
  constexpr double kCoarsest = 1.4;
  // In hausd. That of triangles of the wanted size is 0.75; edges may be 1.4 times as long, and it
  // grows with their square.
  constexpr double kFittingBulge = 1.5;
  const bool fits = options.faceted || curved.bulge <= kFittingBulge;
  const bool coarse = fits ? curved.lengths.mean > kCoarsest
                           : curved.lengths.too_long_percent() > 100 - options.min_conform;
  return has_the_quality_of_results(now.quality, false, options) && now.lengths.mean >= finest &&
         !coarse;
}

}  // namespace

bool no_length_is_poor(const LengthStatistics& now) {
  return now.shortest >= kTooShort && now.longest <= kTooLong;
}

double mean_lost_to_gradation(const Options& options) {
  // As measured on seven bodies: 0.010 for an hgrad of 1.4, 0.020 for 1.5, 0.035 for 1.7, 0.055 for
  // 2 and 0.095 for 3.
  constexpr double kLost = 0.12, kDefault = 1.3, kSteepest = 4;
  return kLost *
         std::log(std::clamp(options.hgrad.value_or(kSteepest), kDefault, kSteepest) / kDefault);
}

bool has_the_quality_of_results(const QualityStatistics& now, bool uniform,
                                const Options& options) {
  return now.mean >= (uniform ? kUniformMean : kVaryingMean - mean_lost_to_gradation(options));
}

bool is_as_good_as_results(const MeshSummary& now, bool uniform, const Options& options) {
  return has_the_quality_of_results(now.quality, uniform, options) &&
         now.lengths.conforming_percent() >= options.min_conform;
}

bool worst_has_risen(const MeshSummary& before, const MeshSummary& after) {
  return before.quality.worst < kPoorQuality &&
         after.quality.worst > before.quality.worst + kWorstGain;
}

bool gained_nothing(const MeshSummary& before, const MeshSummary& after, const Options& options) {
  const auto met = [&](const MeshSummary& m) {
    return int(m.quality.flat.empty()) + (m.quality.worst >= options.min_quality) +
           (m.lengths.conforming_percent() >= options.min_conform);
  };
  return met(after) <= met(before) && !worst_has_risen(before, after) &&
         after.quality.mean < before.quality.mean + kGain &&
         share_of_poor(after.quality) > share_of_poor(before.quality) - kPoorGain &&
         (before.lengths.conforming_percent() >= options.min_conform ||
          after.lengths.conforming_percent() < before.lengths.conforming_percent() + kConformGain);
}

bool sizes_are_given(const Options& options, bool has_field) {
  return has_field || options.hsiz || options.optim || options.max_tets || !options.local.empty() ||
         !options.size_regions.empty() || (options.hmin && options.hmin == options.hmax) ||
         options.freeze.any_operator() || options.freeze.surface;
}

bool is_nearly_result(const MeshSummary& now, const InCurvedSizes& curved, const Options& options) {
  // The surface of a result asks for sizes that are larger by up to a fifth, as seen on 70 models,
  // or a third: on fibres whose own surface had been given coarsely.
  constexpr double kFinest = 0.75;
  return is_between(now, curved, options, kFinest);
}

bool may_have_made_room(const MeshSummary& now, const InCurvedSizes& curved,
                        const Options& options) {
  return is_between(now, curved, options, 0.9 * kFinestRoom);
}

std::vector<float> own_sizes_within(const TetMesh& mesh, double largest) {
  // Of the wanted sizes: what is finer yet is no chance. What is coarser is so where the surface of
  // the mesh bends, which stays as it is.
  constexpr float kFinest = float(0.5 * kTooShort);
  constexpr double kCoarsest = 1.25;  // of the largest size
  std::vector<float> sizes = mean_edge_lengths(mesh);
  parallel_for(sizes.size(), [&](std::size_t v) {
    const float finest = kFinest * mesh.sizes[v];
    sizes[v] = std::max(finest, std::min(sizes[v], float(kCoarsest * largest)));
  });
  return sizes;
}

void give_way_to_own(TetMesh& mesh) {
  // Where sizes are kept, few vertices have shorter edges.
  constexpr float kGivenWay = 0.7f;
  const std::vector<float> own = own_sizes_within(mesh, *std::ranges::max_element(mesh.sizes));
  parallel_for(own.size(), [&](std::size_t v) {
    if (own[v] < kGivenWay * mesh.sizes[v]) mesh.sizes[v] = own[v];
  });
}

std::int64_t count_poor(const TetMesh& mesh) {
  return count_where(mesh.tets.size(), [&](TetId t) { return is_poor(mesh, t); });
}

bool none_is_poor(const MeshSummary& now) {
  return now.quality.worst >= kPoorQuality && no_length_is_poor(now.lengths);
}

bool poor_by_chance(const MeshSummary& now, std::int64_t poor) {
  const LengthStatistics& lengths = now.lengths;
  return now.quality.worst >= kSoundQuality && lengths.shortest >= kTooShort / kHardlyBeyond &&
         lengths.longest <= kHardlyBeyond * kTooLong &&
         double(poor) <= kHardlyAny * double(now.counts.tets);
}

bool few_are_poor(const TetMesh& mesh) {
  return double(count_poor(mesh)) <= kFew * double(mesh.tets.size());
}

void ask_poor(TetMesh& mesh, const std::function<bool(TetId)>& concerns) {
  parallel_for(mesh.tets.size(), [&](std::size_t t) {
    if (is_poor(mesh, TetId(t)) && (!concerns || concerns(TetId(t))))
      mesh.tet_flags[t] |= tet_flag::kAskAll;
  });
}

}  // namespace cavea
