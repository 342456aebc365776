#include "cavea/surface/ridge_ends.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "cavea/base/buckets.h"

namespace cavea {
namespace {

class Continuation {
 public:
  Continuation(TetMesh& m, const std::vector<EdgeSide>& sides)
      : m_(m), sides_(sides), degrees_(m.points.size(), 0) {
    for_each_edge(sides, [&](const EdgeSide* begin, const EdgeSide*) {
      if (tags(*begin) & (tag::kRidge | tag::kNonManifold))
        ++degrees_[begin->a], ++degrees_[begin->b];
    });
  }

  void run(const FoldAngle& fold, double least_angle,
           const std::function<bool(VertexId, VertexId)>& taken) {
    const std::vector<std::size_t> last = last_edges();
    if (last.empty()) return;
    measure_folds(fold);
    find_creases(least_angle, taken);
    for (const std::size_t i : last)
      for (const VertexId v : {sides_[i].a, sides_[i].b})
        if (degrees_[v] == 1) follow(i, v);
  }

 private:
  /// Ridge edges with an end, as the tags are before any goes on.
  std::vector<std::size_t> last_edges() const {
    std::vector<std::size_t> last;
    for (std::size_t i = 0; i < sides_.size(); ++i)
      if (is_first(i) && is_ridge(sides_[i]) &&
          (degrees_[sides_[i].a] == 1 || degrees_[sides_[i].b] == 1))
        last.push_back(i);
    return last;
  }

  void measure_folds(const FoldAngle& fold) {
    folds_.assign(3 * m_.triangles.size(), 0);
    across_.assign(3 * m_.triangles.size(), kNone);
    parallel_for_each_edge(sides_, [&](const EdgeSide* begin, const EdgeSide* end) {
      if (end - begin != 2) return;
      const double angle = fold(begin[0].triangle, begin[1].triangle);
      for (int i = 0; i < 2; ++i) {
        folds_[slot(begin[i])] = float(angle);
        across_[slot(begin[i])] = begin[1 - i].triangle;
      }
    });
  }

  static std::size_t slot(const EdgeSide& s) {
    return 3 * std::size_t(s.triangle) + std::size_t(s.k);
  }
  bool is_first(std::size_t i) const { return i == 0 || !sides_[i].same_edge(sides_[i - 1]); }
  Tag tags(const EdgeSide& s) const { return m_.triangles[s.triangle].edge_tag[s.k]; }
  bool is_ridge(const EdgeSide& s) const { return tags(s) & tag::kRidge; }

  bool is_much(const EdgeSide& s, std::size_t other) const {
    constexpr float kShare = 0.5;
    const bool ridge = m_.triangles[other / 3].edge_tag[other % 3] & tag::kRidge;
    return !ridge && folds_[other] > kShare * folds_[slot(s)];
  }

  /// Whether half as much of a fold is beside an edge on one side: at the triangle there, or
  /// opposite the edge at those behind it.
  bool is_rivalled(const EdgeSide& s) const {
    for (int k = 0; k < 3; ++k) {
      if (k == s.k) continue;
      const std::size_t beside = 3 * std::size_t(s.triangle) + std::size_t(k);
      if (is_much(s, beside)) return true;
      const TriangleId behind = across_[beside];
      if (behind == kNone) continue;
      const auto& v = m_.triangles[behind].v;
      for (int l = 0; l < 3; ++l) {
        const VertexId p = v[(l + 1) % 3], q = v[(l + 2) % 3];
        const bool touches = p == s.a || p == s.b || q == s.a || q == s.b;
        if (!touches && is_much(s, 3 * std::size_t(behind) + std::size_t(l))) return true;
      }
    }
    return false;
  }

  void find_creases(double least_angle, const std::function<bool(VertexId, VertexId)>& taken) {
    const auto is_crease = [&](std::size_t i) {
      return is_first(i) && across_[slot(sides_[i])] != kNone && !is_ridge(sides_[i]) &&
             folds_[slot(sides_[i])] > least_angle && !is_rivalled(sides_[i]) &&
             !is_rivalled(sides_[i + 1]) && (!taken || taken(sides_[i].a, sides_[i].b));
    };
    creases_ = Buckets(sides_.size(), m_.points.size(), [&](std::size_t i, auto put) {
      if (!is_crease(i)) return;
      put(sides_[i].a, std::uint32_t(i));
      put(sides_[i].b, std::uint32_t(i));
    });
  }

  static VertexId other_end(const EdgeSide& s, VertexId v) { return s.a == v ? s.b : s.a; }

  /// The crease that goes on from an edge at its end v most nearly in its direction, or -1.
  std::ptrdiff_t ahead(std::size_t from, VertexId v) const {
    const double kAhead = std::cos(45 * std::numbers::pi / 180);
    const Vec3 in = normalized(m_.points[v] - m_.points[other_end(sides_[from], v)]);
    std::ptrdiff_t best = -1;
    double best_cosine = kAhead;
    for (const std::uint32_t i : creases_.of(std::size_t(v))) {
      const Vec3 out = normalized(m_.points[other_end(sides_[i], v)] - m_.points[v]);
      const double cosine = dot(in, out);
      const bool better = cosine > best_cosine || (cosine == best_cosine && i < best);
      if (better && !is_ridge(sides_[i])) best = std::ptrdiff_t(i), best_cosine = cosine;
    }
    return best;
  }

  void follow(std::size_t edge, VertexId end) {
    while (degrees_[end] == 1) {
      const std::ptrdiff_t next = ahead(edge, end);
      if (next < 0) return;
      edge = std::size_t(next);
      for (std::size_t i = edge; i < edge + 2; ++i)
        m_.triangles[sides_[i].triangle].edge_tag[sides_[i].k] |= tag::kRidge;
      end = other_end(sides_[edge], end);
      ++degrees_[sides_[edge].a], ++degrees_[sides_[edge].b];
    }
  }

  TetMesh& m_;
  const std::vector<EdgeSide>& sides_;
  std::vector<float> folds_;           ///< at the edge opposite each corner of each triangle
  std::vector<TriangleId> across_;     ///< there, where there is one other triangle
  std::vector<std::int32_t> degrees_;  ///< ridges and non-manifold edges at each vertex
  Buckets creases_;
};

}  // namespace

void continue_ridges(TetMesh& mesh, const std::vector<EdgeSide>& sides, const FoldAngle& fold,
                     double least_angle, const std::function<bool(VertexId, VertexId)>& taken) {
  Continuation(mesh, sides).run(fold, least_angle, taken);
}

}  // namespace cavea
