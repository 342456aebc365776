#include "cavea/surface/features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <vector>

#include "cavea/base/parallel.h"
#include "cavea/surface/edges.h"
#include "cavea/surface/ridge_ends.h"
#include "cavea/surface/surface_vertices.h"

namespace cavea {
namespace {

/// Union-find whose representatives are the smallest members.
class Components {
 public:
  explicit Components(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::int32_t find(std::int32_t a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  void join(std::int32_t a, std::int32_t b) {
    a = find(a), b = find(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::int32_t> parent_;
};

/// What meets at a vertex: its feature edges' other ends (the first two), their kinds, their
/// number.
struct FeatureStar {
  std::array<VertexId, 2> ends{kNone, kNone};
  std::array<Tag, 2> kinds{};
  Tag all_kinds = 0;
  int degree = 0;
  int fans = 0;  ///< sheets of triangles around the vertex, joined through edges

  void add(VertexId end, Tag kind) {
    if (degree < 2) ends[degree] = end, kinds[degree] = kind;
    all_kinds |= kind;
    ++degree;
  }
};

Vec3 triangle_normal(const TetMesh& m, const Triangle& t) {
  return normalized(
      cross(m.points[t.v[1]] - m.points[t.v[0]], m.points[t.v[2]] - m.points[t.v[0]]));
}

/// The normals that folds are told by: those of the triangles, but for slivers that stand up
/// between two others: they have theirs.
class FoldNormals {
 public:
  FoldNormals(const TetMesh& m, const std::vector<EdgeSide>& sides, const FeatureOptions& o)
      : own_(m.triangles.size()), cosine_(std::cos(o.angle * std::numbers::pi / 180)) {
    parallel_for(own_.size(), [&](std::size_t t) {
      if (m.triangles[t].alive()) own_[t] = triangle_normal(m, m.triangles[t]);
    });
    normals_ = own_;
    if (o.sliver > 0) look_across(triangles_across(edges_of_slivers(m, o.sliver), sides));
  }
  const Vec3& operator[](TriangleId t) const { return normals_[std::size_t(t)]; }

 private:
  /// Of each triangle the corners opposite its edges, that of the longest edge first; none where
  /// its least height is not below `sliver`.
  using Edges = std::vector<std::array<std::int8_t, 3>>;
  static Edges edges_of_slivers(const TetMesh& m, double sliver) {
    Edges edges(m.triangles.size(), {-1, -1, -1});
    parallel_for(edges.size(), [&](std::size_t t) {
      const Triangle& s = m.triangles[t];
      if (!s.alive()) return;
      const Vec3 x[3] = {m.points[s.v[0]], m.points[s.v[1]], m.points[s.v[2]]};
      double lengths[3];
      for (int k = 0; k < 3; ++k) lengths[k] = distance(x[(k + 1) % 3], x[(k + 2) % 3]);
      std::array<std::int8_t, 3> by_length = {0, 1, 2};
      std::ranges::stable_sort(by_length, [&](int i, int j) { return lengths[i] > lengths[j]; });
      if (norm(cross(x[1] - x[0], x[2] - x[0])) < sliver * lengths[by_length[0]])
        edges[t] = by_length;
    });
    return edges;
  }

  using Across = std::vector<std::array<TriangleId, 3>>;
  static Across triangles_across(const Edges& edges, const std::vector<EdgeSide>& sides) {
    Across across(edges.size(), {kNone, kNone, kNone});
    parallel_for_each_edge(sides, [&](const EdgeSide* begin, const EdgeSide* end) {
      if (end - begin != 2) return;
      for (int i = 0; i < 2; ++i) {
        const auto t = std::size_t(begin[i].triangle);
        const auto at = std::ranges::find(edges[t], begin[i].k);
        if (at != edges[t].end())
          across[t][std::size_t(at - edges[t].begin())] = begin[1 - i].triangle;
      }
    });
    return across;
  }

  void look_across(const Across& across) {
    constexpr int kPasses = 4;  // slivers are beside each other
    for (int pass = 0; pass < kPasses; ++pass) {
      const std::vector<Vec3> before = normals_;
      const auto over = [&](TriangleId t) { return t == kNone ? Vec3{} : before[std::size_t(t)]; };
      parallel_for(across.size(), [&](std::size_t t) {
        const Vec3 a = over(across[t][0]), b = over(across[t][1]), c = over(across[t][2]);
        if (stands_up(own_[t], a, b))
          normals_[t] = normalized(a + b);
        else if (stands_up(own_[t], a, c))
          normals_[t] = normalized(a + c);
      });
    }
  }

  /// Whether a triangle is farther from two others than these are from each other, and they make no
  /// fold.
  bool stands_up(const Vec3& n, const Vec3& a, const Vec3& b) const {
    return dot(a, b) >= std::max({cosine_, dot(n, a), dot(n, b)}) && norm2(a) > 0 && norm2(b) > 0;
  }

  std::vector<Vec3> own_, normals_;
  double cosine_;
};

/// The options as cosines.
struct Sharpness {
  explicit Sharpness(const FeatureOptions& o)
      : cosine(std::cos(o.angle * std::numbers::pi / 180)),
        detect(o.detect_ridges),
        crease(o.crease),
        flat(o.flat),
        least_angle(o.least_crease_angle * std::numbers::pi / 180) {}
  bool folds(double cos_angle, double length) const {
    const double angle = std::acos(std::clamp(cos_angle, -1.0, 1.0));
    return angle > least_angle && angle * length > crease;
  }
  double cosine;
  bool detect;
  double crease;
  bool flat;
  double least_angle;
};

/// Mean height of the two triangles at an edge over it. An edge across flat ones, from one end of
/// their heights to the other, sags by half of the harmonic mean times the angle between them.
double mean_height(const TetMesh& m, const EdgeSide* begin, bool flat) {
  double heights[2];
  for (int i = 0; i < 2; ++i) {
    const auto& v = m.triangles[begin[i].triangle].v;
    heights[i] = norm(cross(m.points[v[1]] - m.points[v[0]], m.points[v[2]] - m.points[v[0]])) /
                 distance(m.points[begin->a], m.points[begin->b]);
  }
  const double sum = heights[0] + heights[1];
  return flat ? 2 * heights[0] * heights[1] / sum : sum / 2;
}

Tag edge_tags(const TetMesh& m, const EdgeSide* begin, const EdgeSide* end,
              const Sharpness& sharpness, const FoldNormals& normals) {
  Tag tags = 0;
  int outside = 0;
  for (const EdgeSide* s = begin; s != end; ++s) {
    tags |= m.triangles[s->triangle].edge_tag[s->k];
    outside += m.triangles[s->triangle].is_exterior();
  }
  if (outside > 2) tags |= tag::kPinched;
  if (end - begin != 2) return Tag(tags | tag::kNonManifold);
  const Triangle& t0 = m.triangles[begin[0].triangle];
  const Triangle& t1 = m.triangles[begin[1].triangle];
  if (t0.ref != t1.ref) tags |= tag::kReferenceEdge;
  const Vec3 n0 = normals[begin[0].triangle], n1 = normals[begin[1].triangle];
  // A triangle of zero area has no normal and says nothing about sharpness.
  const bool both = norm2(n0) > 0 && norm2(n1) > 0;
  if (!both) return tags;
  const double cosine = dot(n0, n1);
  if (sharpness.detect && cosine < sharpness.cosine) tags |= tag::kRidge;
  if (sharpness.folds(cosine, mean_height(m, begin, sharpness.flat))) tags |= tag::kRidge;
  return tags;
}

void tag_edges(TetMesh& m, const std::vector<EdgeSide>& sides, const FeatureOptions& options) {
  const Sharpness sharpness(options);
  const FoldNormals normals(m, sides, options);
  parallel_for_each_edge(sides, [&](const EdgeSide* begin, const EdgeSide* end) {
    Tag tags = edge_tags(m, begin, end, sharpness, normals);
    if ((tags & tag::kRidge) && options.may_be_ridge && !options.may_be_ridge(begin->a, begin->b))
      tags &= Tag(~tag::kRidge);
    std::int32_t ref = 0;
    for (const EdgeSide* s = begin; s != end; ++s) {
      const std::int32_t r = m.triangles[s->triangle].edge_ref[s->k];
      if (r != 0) ref = r;
    }
    for (const EdgeSide* s = begin; s != end; ++s) {
      m.triangles[s->triangle].edge_tag[s->k] = tags;
      m.triangles[s->triangle].edge_ref[s->k] = ref;
    }
  });
  if (!options.detect_ridges || options.continued_above >= options.angle) return;
  const auto fold = [&](TriangleId a, TriangleId b) {
    return angle_between(normals[a], normals[b]);
  };
  continue_ridges(m, sides, fold, options.continued_above * std::numbers::pi / 180,
                  options.may_be_ridge);
}

std::vector<FeatureStar> gather_stars(const TetMesh& m, const std::vector<EdgeSide>& sides,
                                      const SurfaceVertices& surface) {
  std::vector<FeatureStar> stars(surface.vertices.size());
  const auto star = [&](VertexId v) -> FeatureStar& { return stars[surface.number[v]]; };
  Components corners(3 * m.triangles.size());  // (triangle, local vertex) pairs joined across edges
  auto corner = [&](const EdgeSide& s, VertexId v) {
    const auto& t = m.triangles[s.triangle].v;
    return 3 * s.triangle + (t[0] == v ? 0 : t[1] == v ? 1 : 2);
  };
  for_each_edge(sides, [&](const EdgeSide* begin, const EdgeSide* end) {
    const Tag kind =
        m.triangles[begin->triangle].edge_tag[begin->k] & Tag(tag::kFeature | tag::kPinched);
    if (kind) {
      star(begin->a).add(begin->b, kind);
      star(begin->b).add(begin->a, kind);
    }
    for (const EdgeSide* s = begin + 1; s < end; ++s)
      for (VertexId v : {s->a, s->b}) corners.join(corner(*begin, v), corner(*s, v));
  });
  for (std::size_t t = 0; t < m.triangles.size(); ++t)
    if (m.triangles[t].alive())
      for (int k = 0; k < 3; ++k)
        if (corners.find(std::int32_t(3 * t + k)) == std::int32_t(3 * t + k))
          ++star(m.triangles[t].v[k]).fans;
  return stars;
}

bool is_corner(const TetMesh& m, VertexId v, const FeatureStar& star, const Sharpness& sharpness) {
  if (star.fans > 1 || star.degree == 1 || star.degree > 2) return true;
  if (star.degree == 0) return false;
  if ((star.kinds[0] & star.kinds[1]) == 0) return true;
  const Vec3 in = normalized(m.points[v] - m.points[star.ends[0]]);
  const Vec3 out = normalized(m.points[star.ends[1]] - m.points[v]);
  const double cosine = dot(in, out);
  if (cosine < sharpness.cosine) return true;
  const double length =
      distance(m.points[star.ends[0]], m.points[v]) + distance(m.points[star.ends[1]], m.points[v]);
  return sharpness.folds(cosine, length / 2);
}

/// Finds tips: vertices with no feature edge whose triangles leave little of the full angle, like
/// the apex of a cone. Nothing would hold a vertex there, so that tips were cut off.
class Tips {
 public:
  Tips(const TetMesh& m, double least_height, const SurfaceVertices& surface)
      : m_(m), surface_(surface), least_height_(least_height), fans_(surface.vertices.size()) {
    for (const Triangle& t : m.triangles)
      if (t.alive())
        for (int k = 0; k < 3; ++k) add(t.v[k], t.v[(k + 1) % 3], t.v[(k + 2) % 3]);
  }

  bool has(VertexId v) const {
    // What a cone of half a right angle leaves is 254 degrees; the corner of an octahedron, which
    // may stand for a sphere, has 240, but its edges are ridges.
    constexpr double kMostAngle = 235 * std::numbers::pi / 180;
    const Fan& fan = fans_[surface_.number[v]];
    return fan.angle < kMostAngle &&
           distance(m_.points[v], fan.ring / (2 * fan.triangles)) > least_height_;
  }

 private:
  struct Fan {
    double angle = 0;
    Vec3 ring;  ///< sum of the other vertices, each of two triangles
    int triangles = 0;
  };

  void add(VertexId v, VertexId a, VertexId b) {
    const Vec3 x = m_.points[a] - m_.points[v], y = m_.points[b] - m_.points[v];
    Fan& fan = fans_[surface_.number[v]];
    fan.angle += angle_between(x, y);
    fan.ring = fan.ring + m_.points[a] + m_.points[b];
    ++fan.triangles;
  }

  const TetMesh& m_;
  const SurfaceVertices& surface_;
  double least_height_;
  std::vector<Fan> fans_;
};

void tag_vertices(TetMesh& m, const SurfaceVertices& surface, const std::vector<FeatureStar>& stars,
                  const Tips& tips, const FeatureOptions& options) {
  const Sharpness sharpness(options);
  for (std::size_t i = 0; i < stars.size(); ++i) {
    const VertexId v = surface.vertices[i];
    const FeatureStar& star = stars[i];
    // What the mesh carries of its edges' kinds may hold no longer.
    m.vertex_tags[v] &= Tag(~(tag::kOnCurve | tag::kPinched));
    m.vertex_tags[v] |= Tag(tag::kSurface | (star.all_kinds & (tag::kOnCurve | tag::kPinched)));
    if (star.fans > 1) m.vertex_tags[v] |= tag::kPinched;
    const bool is_tip = star.degree == 0 && sharpness.detect && tips.has(v);
    if (is_tip || is_corner(m, v, star, sharpness)) m.vertex_tags[v] |= tag::kCorner;
  }
}

int number_patches(TetMesh& m, const std::vector<EdgeSide>& sides) {
  Components patches(m.triangles.size());
  for_each_edge(sides, [&](const EdgeSide* begin, const EdgeSide* end) {
    if (end - begin != 2 || (m.triangles[begin->triangle].edge_tag[begin->k] & tag::kFeature))
      return;
    patches.join(begin[0].triangle, begin[1].triangle);
  });
  std::vector<std::int32_t> number(m.triangles.size(), kNone);
  int count = 0;
  for (std::size_t t = 0; t < m.triangles.size(); ++t) {
    if (!m.triangles[t].alive()) continue;
    std::int32_t& n = number[patches.find(std::int32_t(t))];
    if (n == kNone) n = count++;
    m.triangles[t].patch = n;
  }
  return count;
}

}  // namespace

int classify_features(TetMesh& mesh, const FeatureOptions& options) {
  const std::vector<EdgeSide> sides = sorted_edge_sides(mesh.triangles);
  tag_edges(mesh, sides, options);
  const SurfaceVertices surface(mesh);
  // Work for one thread each.
  std::vector<FeatureStar> stars;
  std::optional<Tips> tips;
  int patches = 0;
  run_together([&] { stars = gather_stars(mesh, sides, surface); },
               [&] {
                 tips.emplace(mesh, options.least_tip, surface);
                 patches = number_patches(mesh, sides);
               });
  tag_vertices(mesh, surface, stars, *tips, options);
  return patches;
}

}  // namespace cavea
