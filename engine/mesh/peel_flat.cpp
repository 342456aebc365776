#include "cavea/mesh/peel_flat.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "cavea/base/parallel.h"
#include "cavea/geometry/box_tree.h"
#include "cavea/geometry/closest.h"
#include "cavea/mesh/compact.h"
#include "cavea/mesh/faces.h"

namespace cavea {
namespace {

/// A new triangle lies in the plane of one before it, up to what flat tets may be thick: this
/// cosine, this share of its longest edge. At a crack inside some look another way.
constexpr double kSameWay = 0.9, kInPlane = 1e-3;

bool is_flat_below(const TetMesh& m, const Triangle& s) {
  return s.is_exterior() && m.qualities[s.sides[0].tet()] < kFlat;
}

bool is_any_flat_below(const TetMesh& m) {
  return parallel_reduce(
      m.triangles.size(), false,
      [&](std::size_t begin, std::size_t end) {
        return std::any_of(m.triangles.data() + begin, m.triangles.data() + end,
                           [&](const Triangle& s) { return is_flat_below(m, s); });
      },
      std::logical_or<>{});
}

using Corners = std::array<Vec3, 3>;

Corners corners_of(const TetMesh& m, const std::array<VertexId, 3>& v) {
  return {m.points[v[0]], m.points[v[1]], m.points[v[2]]};
}

Vec3 normal_of(const Corners& x) { return normalized(cross(x[1] - x[0], x[2] - x[0])); }

double longest_edge2(const Corners& x) {
  return std::max({distance2(x[0], x[1]), distance2(x[1], x[2]), distance2(x[2], x[0])});
}

/// Surface triangles that may go, to be found by place.
class OldSurface {
 public:
  OldSurface(const TetMesh& m, const std::vector<TriangleId>& triangles)
      : corners_(triangles.size()), refs_(triangles.size()) {
    std::vector<Box> boxes(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const Triangle& s = m.triangles[triangles[i]];
      corners_[i] = corners_of(m, s.v), refs_[i] = s.ref;
      for (const Vec3& p : corners_[i]) boxes[i].add(p);
    }
    tree_.emplace(boxes);
  }

  /// The reference of what a new triangle lies on, or none.
  std::optional<std::int32_t> ref_at(const Corners& x) const {
    const Vec3 normal = normal_of(x), centroid = (x[0] + x[1] + x[2]) / 3;
    double nearest2 = kInPlane * kInPlane * longest_edge2(x);
    std::optional<std::int32_t> ref;
    tree_->visit_near(centroid, nearest2, [&](std::size_t slot) {
      const auto i = std::size_t(tree_->order()[slot]);
      const Corners& y = corners_[i];
      if (dot(normal, normal_of(y)) < kSameWay) return;
      const double d2 = closest_on_triangle(centroid, y[0], y[1], y[2]).distance2;
      if (d2 < nearest2) ref = refs_[i], nearest2 = d2;
    });
    return ref;
  }

 private:
  std::vector<Corners> corners_;
  std::vector<std::int32_t> refs_;
  std::optional<BoxTree> tree_;
};

/// Flat tets that reach each other through common faces, and what bounds them.
struct Cluster {
  std::vector<TetId> tets;
  std::vector<TriangleId> outer;  ///< the surface above
  std::vector<FaceLink> behind;   ///< faces of other tets
};

class FlatTetPeeler {
 public:
  FlatTetPeeler(TetMesh& mesh, std::span<const VertexId> kept)
      : m_(mesh), kept_(kept.begin(), kept.end()), on_surface_(mesh.points.size()) {
    for (const Triangle& s : m_.triangles)
      for (const VertexId v : s.v) on_surface_[v] = 1;
  }

  Peeled run() {
    find_clusters();
    if (std::ranges::none_of(clusters_, [&](const Cluster& c) { return hides_a_vertex(c); }))
      return {};
    for (const Triangle& s : m_.triangles) count_edges(s.v, 1);
    std::vector<TriangleId> outer;
    for (const Cluster& c : clusters_) outer.insert(outer.end(), c.outer.begin(), c.outer.end());
    const OldSurface old(m_, outer);
    for (const Cluster& c : clusters_) peel(c, old);
    std::ranges::sort(peeled_.vertices);
    return std::move(peeled_);
  }

 private:
  static std::uint64_t key(VertexId a, VertexId b) {
    return std::uint64_t(std::min(a, b)) << 32 | std::uint64_t(std::max(a, b));
  }

  void count_edges(const std::array<VertexId, 3>& v, int by) {
    for (int k = 0; k < 3; ++k) triangles_at_[key(v[k], v[(k + 1) % 3])] += by;
  }

  void find_clusters() {
    for (const Triangle& s : m_.triangles) {
      if (!is_flat_below(m_, s) || !found_.insert(s.sides[0].tet()).second) continue;
      Cluster c;
      if (grow(c, s.sides[0].tet())) clusters_.push_back(std::move(c));
    }
  }

  /// \return false if the cluster touches what must stay
  bool grow(Cluster& c, TetId first) {
    bool may_go = true;
    c.tets.push_back(first);
    for (std::size_t i = 0; i < c.tets.size(); ++i)
      for (const FaceLink link : m_.links[c.tets[i]]) {
        if (link.is_triangle()) {
          const Triangle& s = m_.triangles[link.triangle()];
          may_go = may_go && s.is_exterior() && !(s.tags & tag::kRequired);
          c.outer.push_back(link.triangle());
        } else if (m_.qualities[link.tet()] >= kFlat) {
          c.behind.push_back(link);
        } else if (found_.insert(link.tet()).second) {
          c.tets.push_back(link.tet());
        }
      }
    return may_go && !c.behind.empty();
  }

  bool hides_a_vertex(const Cluster& c) const {
    return std::ranges::any_of(c.tets, [&](TetId t) {
      return std::ranges::any_of(m_.tets[t], [&](VertexId v) { return !on_surface_[v]; });
    });
  }

  std::array<VertexId, 3> vertices_of(FaceLink behind) const {
    return face_vertices(m_.tets[behind.tet()], behind.face());
  }

  void peel(const Cluster& c, const OldSurface& old) {
    std::vector<Triangle> made;
    for (const FaceLink behind : c.behind) {
      Triangle s;
      s.v = vertices_of(behind);
      s.sides[0] = behind;
      const std::optional<std::int32_t> ref = old.ref_at(corners_of(m_, s.v));
      if (!ref) return;
      s.ref = *ref;
      made.push_back(s);
    }
    const std::vector<VertexId> lost = lost_vertices(c);
    if (std::ranges::any_of(lost, [&](VertexId v) { return kept_.contains(v); })) return;
    if (change_edges(c, made)) replace(c, made, lost);
  }

  /// Vertices that have no tets but those of the cluster.
  std::vector<VertexId> lost_vertices(const Cluster& c) const {
    std::unordered_set<VertexId> stay;
    for (const FaceLink behind : c.behind)
      for (const VertexId v : vertices_of(behind)) stay.insert(v);
    std::vector<VertexId> lost;
    for (const TetId t : c.tets)
      for (const VertexId v : m_.tets[t])
        if (!stay.contains(v)) lost.push_back(v);
    std::ranges::sort(lost);
    lost.erase(std::unique(lost.begin(), lost.end()), lost.end());
    return lost;
  }

  /// \return false, and nothing has changed, if an edge would not have two triangles
  bool change_edges(const Cluster& c, const std::vector<Triangle>& made) {
    const auto exchange = [&](int by) {
      for (const TriangleId id : c.outer) count_edges(m_.triangles[id].v, -by);
      for (const Triangle& s : made) count_edges(s.v, by);
    };
    exchange(1);
    for (const Triangle& s : made)
      for (int k = 0; k < 3; ++k)
        if (triangles_at_[key(s.v[k], s.v[(k + 1) % 3])] != 2) {
          exchange(-1);
          return false;
        }
    return true;
  }

  void replace(const Cluster& c, const std::vector<Triangle>& made,
               const std::vector<VertexId>& lost) {
    for (const TriangleId id : c.outer) m_.triangles[id].v = {kNone, kNone, kNone};
    for (const TetId t : c.tets) m_.tets[t] = {kNone, kNone, kNone, kNone};
    for (const Triangle& s : made) {
      const FaceLink behind = s.sides[0];
      m_.links[behind.tet()][behind.face()] =
          FaceLink::to_triangle(TriangleId(m_.triangles.size()));
      m_.triangles.push_back(s);
      for (const VertexId v : s.v) m_.vertex_tets[v] = behind.tet();
    }
    for (const VertexId v : lost) m_.vertex_tets[v] = kNone;
    peeled_.tets += std::int64_t(c.tets.size());
    peeled_.vertices.insert(peeled_.vertices.end(), lost.begin(), lost.end());
  }

  TetMesh& m_;
  const std::unordered_set<VertexId> kept_;
  std::vector<char> on_surface_;                         ///< by vertex
  std::unordered_map<std::uint64_t, int> triangles_at_;  ///< how many, by edge
  std::unordered_set<TetId> found_;
  std::vector<Cluster> clusters_;
  Peeled peeled_;
};

}  // namespace

Peeled peel_flat_tets(TetMesh& mesh, std::span<const VertexId> kept) {
  if (!is_any_flat_below(mesh)) return {};
  Peeled peeled = FlatTetPeeler(mesh, kept).run();
  compact(mesh);
  return peeled;
}

}  // namespace cavea
