#include "cavea/remesh/forecast.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "cavea/base/error.h"
#include "cavea/base/ids.h"
#include "cavea/base/parallel.h"
#include "cavea/geometry/predicates.h"
#include "cavea/mesh/wanted_tets.h"

namespace cavea {
namespace {

/// Of a run, at its peak, per tet of the result: measured from a million tets to forty million.
constexpr double kBytesPerTet = 200;

/// Meshes of graded or uniform sizes have about as many tets as regular ones would fill the volume.
constexpr double kTetsPerRegular = 1.1;

/// Where sizes differ by no more than this the rule of five points is good to a tenth.
constexpr double kSimilar = 2;

/// What is to be divided into fewer is not looked into.
constexpr double kDivided = 8;

/// Nor is it worth more where there is no more than this in a piece.
constexpr double kFewTets = 1;

/// Eight halvings of all edges: pieces of a 256th of the tet's edges, where sizes jump.
constexpr int kMostBisections = 24;

double tets_in(double volume, double size) { return kTetsPerRegular * regular_tets(volume, size); }

/// A piece of a tet, with the wanted sizes at its corners.
struct Piece {
  std::array<Vec3, 4> corners;
  std::array<double, 4> sizes;

  double volume() const {
    return std::abs(volume6(corners[0], corners[1], corners[2], corners[3])) / 6;
  }
  Vec3 center() const { return (corners[0] + corners[1] + corners[2] + corners[3]) / 4; }
};

class TetForecast {
 public:
  TetForecast(const TetMesh& mesh, TetId t, const SizeLaw& law) : mesh_(mesh), t_(t), law_(law) {}

  double run() const {
    Piece whole{mesh_.corners(t_), {}};
    for (int k = 0; k < 4; ++k) whole.sizes[k] = mesh_.sizes[mesh_.tets[t_][k]];
    // Its vertices know all there is to know of a tet that is about as small as wanted.
    const double least = std::ranges::min(whole.sizes);
    if (const double tets = tets_in(whole.volume(), least); tets <= kDivided) return tets;
    for (int k = 0; k < 4; ++k) whole.sizes[k] = size_at(whole.corners[k]);
    return tets_in_piece(whole, 0);
  }

 private:
  double size_at(const Vec3& p) const { return law_.at(mesh_, t_, p); }

  double tets_in_piece(const Piece& piece, int depth) const {
    const double middle = size_at(piece.center());
    const double least = std::min(std::ranges::min(piece.sizes), middle),
                 most = std::max(std::ranges::max(piece.sizes), middle);
    const bool is_enough = depth == kMostBisections || most <= kSimilar * least ||
                           tets_in(piece.volume(), least) <= kFewTets;
    return is_enough ? by_five_points(piece, middle) : bisected(piece, depth);
  }

  /// Exact for quadratic densities.
  static double by_five_points(const Piece& piece, double middle) {
    const double volume = piece.volume();
    double tets = 0.8 * tets_in(volume, middle);
    for (const double size : piece.sizes) tets += 0.05 * tets_in(volume, size);
    return tets;
  }

  double bisected(const Piece& piece, int depth) const {
    const auto length2 = [&](const int* e) {
      return distance2(piece.corners[e[0]], piece.corners[e[1]]);
    };
    const int* longest = kEdgeVertices[0];
    for (const auto& e : kEdgeVertices)
      if (length2(e) > length2(longest)) longest = e;
    const Vec3 middle = (piece.corners[longest[0]] + piece.corners[longest[1]]) / 2;
    const double size = size_at(middle);
    double tets = 0;
    for (int k = 0; k < 2; ++k) {
      Piece half = piece;
      half.corners[longest[k]] = middle;
      half.sizes[longest[k]] = size;
      tets += tets_in_piece(half, depth + 1);
    }
    return tets;
  }

  const TetMesh& mesh_;
  const TetId t_;
  const SizeLaw& law_;
};

template <class TetsOf>
double sum_over_tets(const TetMesh& mesh, TetsOf&& tets) {
  return parallel_reduce(
      mesh.tets.size(), 0.0,
      [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t t = begin; t < end; ++t) sum += tets(TetId(t));
        return sum;
      },
      std::plus<>{});
}

void refuse(double tets, std::int64_t bytes) {
  constexpr double kGigabyte = 1e9;
  if (tets >= double(kMaxTets))
    throw MemoryError(fmt::format("about {:.3g} tets are wanted; a mesh holds at most {:.3g}", tets,
                                  double(kMaxTets)));
  if (kBytesPerTet * tets > double(bytes))
    throw MemoryError(fmt::format(
        "about {:.3g} tets are wanted, which take about {:.3g} GB of memory; {:.3g} GB may be used",
        tets, kBytesPerTet * tets / kGigabyte, double(bytes) / kGigabyte));
}

}  // namespace

double most_tets(const TetMesh& mesh, const SizeLaw& law) {
  return sum_over_tets(mesh, [&](TetId t) {
    double least = law.hmax;
    for (const VertexId v : mesh.tets[t]) least = std::min(least, double(mesh.sizes[v]));
    if (law.field) least = std::min(least, law.hmin);
    return tets_in(Piece{mesh.corners(t), {}}.volume(), least);
  });
}

double forecast_tets(const TetMesh& mesh, const SizeLaw& law) {
  return sum_over_tets(mesh, [&](TetId t) { return TetForecast(mesh, t, law).run(); });
}

void refuse_too_large(const TetMesh& mesh, const SizeLaw& law, std::int64_t bytes) {
  const double most = most_tets(mesh, law);
  if (most < double(kMaxTets) && kBytesPerTet * most <= double(bytes)) return;
  refuse(std::max(forecast_tets(mesh, law), double(mesh.tets.size())), bytes);
}

void refuse_too_large(const TetMesh& mesh, std::int64_t bytes) {
  refuse(double(mesh.tets.size()), bytes);
}

}  // namespace cavea
