#include "cavea/remesh/evening.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <vector>

#include "cavea/base/buckets.h"
#include "cavea/base/cancel.h"
#include "cavea/base/parallel.h"
#include "cavea/geometry/predicates.h"
#include "cavea/geometry/quality.h"
#include "cavea/mesh/edge_shares.h"
#include "cavea/remesh/stubborn.h"

namespace cavea {
namespace {

/// Lattices of seeds reach into each other by about as many vertices. More steps, or longer ones,
/// gain no more lengths and make tets poorer.
constexpr int kSteps = 4;
/// Of the mean of what the edges at a vertex are off.
constexpr double kStride = 0.8;
/// Bad moves are halved so often before they are given up.
constexpr int kHalvings = 3;

class Evening {
 public:
  Evening(TetMesh& mesh, const std::atomic<bool>* cancel)
      : mesh_(mesh),
        cancel_(cancel),
        ends_(mesh.tets.size(), mesh.points.size(),
              [&](std::size_t t, auto&& put) {
                EdgeShare(mesh, TetId(t)).for_each([&](const auto& e) {
                  const VertexId a = mesh.tets[t][e[0]], b = mesh.tets[t][e[1]];
                  put(a, std::uint32_t(b));
                  put(b, std::uint32_t(a));
                });
              }),
        degrees_(mesh.points.size()),
        points_(mesh.points),
        qualities_(mesh.qualities) {
    parallel_for(degrees_.size(), [&](std::size_t v) {
      degrees_[v] = std::uint32_t(rising_once(ends_.of(v)).size());
    });
  }

  void run() {
    std::vector<Vec3> next = points_;
    for (int step = 0; step < kSteps; ++step) {
      throw_if_cancelled(cancel_);
      parallel_for(next.size(), [&](std::size_t v) {
        if (tag::is_unbound(mesh_.vertex_tags[v])) next[v] = points_[v] + kStride * pull(v);
      });
      points_.swap(next);
    }
    take_back_bad();
    mesh_.points.swap(points_);
    mesh_.qualities.swap(qualities_);
  }

 private:
  /// The mean over the edges at a vertex of where they would move it.
  Vec3 pull(std::size_t v) const {
    const auto others = ends_.of(v).first(degrees_[v]);
    Vec3 sum;
    for (const std::uint32_t w : others) {
      const Vec3 edge = points_[w] - points_[v];
      const double rest = 0.5 * (double(mesh_.sizes[v]) + double(mesh_.sizes[w]));
      const double length = norm(edge);
      if (length > 0) sum += (1 - rest / length) * edge;
    }
    return others.empty() ? sum : sum / double(others.size());
  }

  void take_back_bad() {
    std::vector<char> moved(points_.size());
    parallel_for(moved.size(), [&](std::size_t v) { moved[v] = points_[v] != mesh_.points[v]; });
    for (int round = 0;; ++round) {
      throw_if_cancelled(cancel_);
      const std::vector<char> back = of_bad_tets(moved);
      parallel_for(moved.size(), [&](std::size_t v) {
        moved[v] = back[v] && points_[v] != mesh_.points[v];
        if (moved[v])
          points_[v] = round < kHalvings ? 0.5 * (points_[v] + mesh_.points[v]) : mesh_.points[v];
      });
      if (std::ranges::find(moved, 1) == moved.end()) return;
    }
  }

  /// Sets the qualities of the tets at moved vertices. \return a mark at the vertices of bad ones
  std::vector<char> of_bad_tets(const std::vector<char>& moved) {
    std::vector<char> bad(points_.size(), 0);
    parallel_for(mesh_.tets.size(), [&](std::size_t t) {
      const auto& k = mesh_.tets[t];
      if (!(moved[k[0]] | moved[k[1]] | moved[k[2]] | moved[k[3]])) return;
      if (is_good_now(TetId(t))) return;
      for (const VertexId v : k) std::atomic_ref(bad[v]).store(1, std::memory_order_relaxed);
    });
    return bad;
  }

  bool is_good_now(TetId t) {
    const auto& k = mesh_.tets[t];
    const Vec3 &a = points_[k[0]], &b = points_[k[1]], &c = points_[k[2]], &d = points_[k[3]];
    qualities_[t] = float(tet_quality(a, b, c, d));
    return qualities_[t] >= std::min(float(kSoundQuality), mesh_.qualities[t]) &&
           certainly_positive(a, b, c, d);
  }

  TetMesh& mesh_;
  const std::atomic<bool>* cancel_;
  Buckets ends_;                        ///< by vertex, the other ends of its edges
  std::vector<std::uint32_t> degrees_;  ///< how many of these there are, each once and first
  std::vector<Vec3> points_;            ///< where the vertices are by now
  std::vector<float> qualities_;
};

}  // namespace

void even_out(TetMesh& mesh, const std::atomic<bool>* cancel) { Evening(mesh, cancel).run(); }

}  // namespace cavea
