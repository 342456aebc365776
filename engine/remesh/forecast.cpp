#include "cavea/remesh/forecast.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "cavea/base/error.h"
#include "cavea/base/ids.h"
#include "cavea/base/parallel.h"
#include "cavea/mesh/wanted_tets.h"
#include "cavea/remesh/size_pieces.h"

namespace cavea {
namespace {

/// Of a run, at its peak, per tet of the result: measured from a million tets to forty million.
constexpr double kBytesPerTet = 200;

/// Meshes of graded or uniform sizes have about as many tets as regular ones would fill the volume.
constexpr double kTetsPerRegular = 1.1;

double tets_in(double volume, double size) { return kTetsPerRegular * regular_tets(volume, size); }

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
    return tets_in(volume_of(mesh.corners(t)), least);
  });
}

double forecast_tets(const TetMesh& mesh, const SizeLaw& law) {
  return sum_over_tets(mesh, [&](TetId t) {
    double tets = 0;
    for_each_size(mesh, t, law, [&](double volume, double size) { tets += tets_in(volume, size); });
    return tets;
  });
}

double forecast_about(const TetMesh& mesh, const SizeLaw& law) {
  double tets = 0;
  for_each_size_about(mesh, law,
                      [&](double volume, double size) { tets += tets_in(volume, size); });
  return tets;
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
