#include "cavea/surface/attach.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "cavea/base/parallel.h"
#include "cavea/geometry/box_tree.h"
#include "cavea/geometry/closest.h"
#include "cavea/surface/edges.h"

namespace cavea {
namespace {

/// Vertices farther than this share of the tolerance from the model are to be moved onto it.
constexpr double kOnSurface = 0.05;

std::vector<Box> facet_boxes(const SurfaceModel& model) {
  std::vector<Box> boxes(model.facets());
  for (std::size_t f = 0; f < boxes.size(); ++f)
    boxes[f] = box_of(model.facet_corners(std::int32_t(f)));
  return boxes;
}

std::vector<Box> curve_boxes(const SurfaceModel& model) {
  std::vector<Box> boxes(model.curve_edges());
  for (std::size_t e = 0; e < boxes.size(); ++e)
    boxes[e] = box_of(model.curve_ends(std::int32_t(e)));
  return boxes;
}

class Attachment {
 public:
  Attachment(TetMesh& mesh, const SurfaceModel& model, double tolerance)
      : mesh_(mesh),
        model_(model),
        tolerance_(tolerance),
        facets_(facet_boxes(model)),
        curves_(curve_boxes(model)) {}

  /// Whether a feature curve of the model runs along an edge.
  bool on_curve(VertexId a, VertexId b) const {
    // An earlier result has its ridges within the tolerance; a chord as long as sizes allow sags by
    // another one. Where that result was made with a larger tolerance, its edges are longer.
    constexpr double kNear = 2, kShareOfEdge = 0.25, kAlong = 0.8;
    const Vec3 p = mesh_.points[a], q = mesh_.points[b], middle = (p + q) / 2;
    const double reach = std::max(kNear * tolerance_, kShareOfEdge * distance(p, q));
    // Curves bulge from their chords.
    const auto near = nearest_curve(middle, reach + model_.max_bulge());
    if (!near) return false;
    const Anchor hints[1] = {{SurfaceModel::curve_anchor(near->edge), float(near->t), 0}};
    if (model_.place_on_curve(middle, hints).distance2 > reach * reach) return false;
    const auto [s, t] = model_.curve_ends(near->edge);
    return std::abs(dot(t - s, q - p)) >= kAlong * norm(t - s) * norm(q - p);
  }

  /// \return the share of the area that is off its patch
  double run(int patches) {
    find_facets_under();
    take_patches(patches);
    find_going_on();
    std::vector<std::int32_t> patch(mesh_.points.size(), kNone);
    for (const Triangle& t : mesh_.triangles)
      if (t.alive())
        for (VertexId v : t.v) patch[v] = t.patch;
    parallel_for(mesh_.points.size(), [&](std::size_t v) {
      mesh_.anchors[v] = {};
      if (patch[v] != kNone) anchor(VertexId(v), patch[v]);
    });
    return share_off_patches();
  }

 private:
  struct OnCurve {
    std::int32_t edge;
    double t, distance2;
  };

  std::optional<OnCurve> nearest_curve(const Vec3& p, double reach) const {
    std::optional<OnCurve> best;
    double bound2 = reach * reach;
    curves_.visit_near(p, bound2, [&](std::size_t slot) {
      const std::int32_t e = curves_.order()[slot];
      const auto [a, b] = model_.curve_ends(e);
      const ClosestOnSegment c = closest_on_segment(p, a, b);
      if (c.distance2 < bound2) best = {e, c.t, c.distance2}, bound2 = c.distance2;
    });
    return best;
  }

  /// The nearest facet that `accept` takes.
  template <class Accept>
  Anchor nearest_facet(const Vec3& p, Accept&& accept) const {
    Anchor best;
    double bound2 = std::numeric_limits<double>::infinity();
    facets_.visit_near(p, bound2, [&](std::size_t slot) {
      const std::int32_t f = facets_.order()[slot];
      if (!accept(f)) return;
      const auto [a, b, c] = model_.facet_corners(f);
      const ClosestOnTriangle r = closest_on_triangle(p, a, b, c);
      if (r.distance2 < bound2) best = {f, float(r.u), float(r.v)}, bound2 = r.distance2;
    });
    return best;
  }

  Vec3 centroid(const Triangle& t) const {
    return (mesh_.points[t.v[0]] + mesh_.points[t.v[1]] + mesh_.points[t.v[2]]) / 3;
  }
  Vec3 normal(const Triangle& t) const {
    const Vec3 a = mesh_.points[t.v[0]], b = mesh_.points[t.v[1]], c = mesh_.points[t.v[2]];
    return cross(b - a, c - a);
  }
  double area(const Triangle& t) const { return norm(normal(t)) / 2; }

  void find_facets_under() {
    under_.assign(mesh_.triangles.size(), kNone);
    parallel_for(under_.size(), [&](std::size_t i) {
      const Triangle& t = mesh_.triangles[i];
      if (!t.alive()) return;
      const Vec3 n = normal(t);
      under_[i] = nearest_facet(centroid(t), [&](std::int32_t f) {
                    const auto [x, y, z] = model_.facet_corners(f);
                    return dot(cross(y - x, z - x), n) > 0;  // not the other side of a thin wall
                  }).facet;
    });
  }

  double distance_to(const Vec3& p, std::int32_t facet) const {
    const auto [a, b, c] = model_.facet_corners(facet);
    return std::sqrt(closest_on_triangle(p, a, b, c).distance2);
  }

  /// A triangle beside a ridge may lie above the patch beyond as well; what is a good deal farther
  /// from its own patch than from another belongs to a piece that has no ridge where the model has.
  bool is_off_patch(std::size_t i) const {
    constexpr double kFarther = 2;  // tolerances
    const Triangle& t = mesh_.triangles[i];
    const std::int32_t under = under_[i];
    if (under == kNone || model_.patch_number(under) == t.patch) return false;
    const Vec3 p = centroid(t);
    const Anchor own =
        nearest_facet(p, [&](std::int32_t f) { return model_.patch_number(f) == t.patch; });
    return own.facet == kNone || distance_to(p, own.facet) > distance_to(p, under) +
                                                                 kFarther * tolerance_ +
                                                                 model_.max_bulge();
  }

  double share_off_patches() const {
    std::vector<char> off(mesh_.triangles.size());
    parallel_for(off.size(), [&](std::size_t t) { off[t] = is_off_patch(t); });
    double all = 0, sum = 0;
    for (std::size_t t = 0; t < off.size(); ++t) {
      if (!mesh_.triangles[t].alive()) continue;
      all += area(mesh_.triangles[t]);
      if (off[t]) sum += area(mesh_.triangles[t]);
    }
    return all > 0 ? sum / all : 0;
  }

  /// The patch of the model that most of each piece of the surface lies on.
  void take_patches(int pieces) {
    std::vector<std::map<int, double>> votes(static_cast<std::size_t>(pieces));
    for (std::size_t i = 0; i < under_.size(); ++i) {
      if (under_[i] == kNone) continue;
      const Triangle& t = mesh_.triangles[i];
      votes[std::size_t(t.patch)][model_.patch_number(under_[i])] += area(t);
    }
    for (Triangle& t : mesh_.triangles) {
      if (!t.alive()) continue;
      const auto& v = votes[std::size_t(t.patch)];
      const auto most = std::max_element(
          v.begin(), v.end(), [](const auto& x, const auto& y) { return x.second < y.second; });
      if (most != v.end()) t.patch = most->first;
    }
  }

  /// Where just two feature edges meet, a curve goes on, even if the mesh calls it a corner.
  void find_going_on() {
    std::vector<int> edges(mesh_.points.size(), 0);
    for_each_edge(sorted_edge_sides(mesh_.triangles), [&](const EdgeSide* begin, const EdgeSide*) {
      if (mesh_.triangles[begin->triangle].edge_tag[begin->k] & tag::kOnCurve)
        ++edges[begin->a], ++edges[begin->b];
    });
    curve_goes_on_.resize(edges.size());
    for (std::size_t v = 0; v < edges.size(); ++v) curve_goes_on_[v] = edges[v] == 2;
  }

  void anchor(VertexId v, int patch) {
    const Vec3 p = mesh_.points[v];
    Tag& tags = mesh_.vertex_tags[v];
    const double reach = std::numeric_limits<double>::infinity();
    Anchor& anchor = mesh_.anchors[v];
    const bool is_corner = tags & tag::kCorner;
    const auto corner = is_corner || !(tags & tag::kOnCurve)
                            ? model_.corner_near(p, kOnSurface * tolerance_)
                            : std::nullopt;
    if (corner)
      anchor = *corner;
    else if ((tags & tag::kOnCurve) && (!is_corner || curve_goes_on_[std::size_t(v)]))
      if (const auto near = nearest_curve(p, is_corner ? tolerance_ : reach))
        anchor = {SurfaceModel::curve_anchor(near->edge), float(near->t), 0};
    if (anchor.facet == kNone)
      anchor = nearest_facet(p, [&](std::int32_t f) { return model_.patch_number(f) == patch; });
    if (tags & (tag::kCorner | tag::kRequired)) return;
    const Anchor hints[1] = {anchor};
    const SurfacePoint at =
        (tags & tag::kOnCurve) ? model_.place_on_curve(p, hints) : model_.place(p, patch, hints);
    const double limit = kOnSurface * tolerance_;
    if (at.anchor.facet != kNone && at.distance2 > limit * limit) tags |= tag::kOffSurface;
  }

  TetMesh& mesh_;
  const SurfaceModel& model_;
  const double tolerance_;
  BoxTree facets_, curves_;
  std::vector<std::int32_t> under_;  ///< by triangle, the facet nearest to it that faces its way
  std::vector<char> curve_goes_on_;  ///< by vertex
};

}  // namespace

double attach_to(TetMesh& mesh, const SurfaceModel& model, const FeatureOptions& options,
                 double tolerance) {
  Attachment attachment(mesh, model, tolerance);
  FeatureOptions along = options;
  along.crease = std::numeric_limits<double>::infinity();
  along.may_be_ridge = [&](VertexId a, VertexId b) { return attachment.on_curve(a, b); };
  return attachment.run(classify_features(mesh, along));
}

OffVertex farthest_vertex(const TetMesh& mesh, const SurfaceModel& model) {
  const BoxTree tree(facet_boxes(model));
  const auto distance_of = [&](VertexId v) {
    double nearest2 = std::numeric_limits<double>::infinity();
    tree.visit_near(mesh.points[v], nearest2, [&](std::size_t slot) {
      const auto [a, b, c] = model.facet_corners(tree.order()[slot]);
      nearest2 = std::min(nearest2, closest_on_triangle(mesh.points[v], a, b, c).distance2);
    });
    return std::sqrt(nearest2);
  };
  const auto farther = [](const OffVertex& a, const OffVertex& b) {
    return b.distance > a.distance ? b : a;
  };
  return parallel_reduce(
      mesh.points.size(), OffVertex{},
      [&](std::size_t begin, std::size_t end) {
        OffVertex here;
        for (std::size_t v = begin; v < end; ++v)
          if (mesh.vertex_tags[v] & tag::kSurface)
            here = farther(here, {VertexId(v), distance_of(VertexId(v))});
        return here;
      },
      farther);
}

}  // namespace cavea
