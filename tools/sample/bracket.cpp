#include "bracket.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "cavea/geometry/predicates.h"

namespace cavea::sample {
namespace {

// Millimetres.
constexpr double kEnd = 20;        // radius of the rounded ends, half the width
constexpr double kBore = 8;        // radius of both bores
constexpr double kBushing = 11;    // outer radius of the bushing
constexpr double kThickness = 10;  // of both lugs
constexpr double kArm = 35;        // from the axis of a bore to the inner edge
constexpr double kUprightAxis = kThickness + kArm;

constexpr int kAround = 24;  // bricks around a bore: 15 degrees each
constexpr int kAcross = 6;   // bricks across the width
// Where the layers lie, as fractions: uneven on purpose.
constexpr std::array<double, 4> kLayers = {0, 0.2, 0.6, 1};
constexpr std::array<double, 4> kArmRows = {0, 0.15, 0.55, 1};
constexpr std::array<double, 4> kRings = {0, 0.2, 0.55, 1};  // outside the bushing

constexpr int kBody = 1, kBushingRef = 2;  // references of tets

/// References of triangles, less one.
enum Surface {
  kBottom,
  kTop,
  kRightSide,
  kLeftSide,
  kBack,
  kFront,
  kEndA,
  kEndB,
  kBoreA,
  kBoreB,
  kBushingOutside,
  kSurfaces
};

struct Point2 {
  double u = 0, v = 0;
};
using Embedding = std::function<Vec3(Point2, double)>;

/// Cosine of k times 15 degrees.
double cosine(int k) {
  k = ((k % kAround) + kAround) % kAround;
  if (k > 12) k = kAround - k;
  if (k > 6) return -cosine(12 - k);
  const double root2 = std::sqrt(2.0), root6 = std::sqrt(6.0);
  const std::array<double, 7> table = {
      1, (root6 + root2) / 4, std::sqrt(3.0) / 2, root2 / 2, 0.5, (root6 - root2) / 4, 0};
  return table[k];
}

Point2 on_circle(double radius, int k) { return {radius * cosine(k), radius * cosine(k - 6)}; }

/// The outline of a lug around its bore: a half circle for u < 0, half a square for u > 0.
Point2 on_outline(int k) {
  const Point2 p = on_circle(kEnd, k);
  if (p.u < 0) return p;
  const int from_axis =
      std::abs(k <= 12 ? k : k - kAround);  // 0 at the arm, 6 at the tangent point
  const double sign = p.v < 0 ? -1 : 1;
  if (from_axis <= 3) return {kEnd, sign * kEnd * from_axis / 3};
  return {kEnd * (6 - from_axis) / 3, sign * kEnd};
}

/// Ring 0 is the bore, ring 1 the outside of the bushing, the last one the outline.
Point2 on_ring(int ring, int k) {
  if (ring == 0) return on_circle(kBore, k);
  const Point2 a = on_circle(kBushing, k), b = on_outline(k);
  const double t = kRings[ring - 1];
  return {a.u + t * (b.u - a.u), a.v + t * (b.v - a.v)};
}

unsigned surfaces_at(const Vec3& p) {
  constexpr double kOn = 1e-5;  // coordinates are rounded to 1e-6
  const auto on = [](double a, double b) { return std::abs(a - b) < kOn; };
  const double radius_a = std::hypot(p.x, p.y), radius_b = std::hypot(p.z - kUprightAxis, p.y);
  const bool lug_a = p.x<kArm + kOn, lug_b = p.z> kThickness - kOn;
  unsigned set = 0;
  const auto add = [&set](bool is, Surface s) { set |= is ? 1u << s : 0u; };
  add(on(p.z, 0), kBottom);
  add(on(p.z, kThickness) && lug_a, kTop);
  add(on(p.y, kEnd), kRightSide);
  add(on(p.y, -kEnd), kLeftSide);
  add(on(p.x, kArm + kThickness), kBack);
  add(on(p.x, kArm) && lug_b, kFront);
  add(on(radius_a, kEnd) && p.x < kOn, kEndA);
  add(on(radius_b, kEnd) && p.z > kUprightAxis - kOn, kEndB);
  add(on(radius_a, kBore) && lug_a, kBoreA);
  add(on(radius_b, kBore) && lug_b, kBoreB);
  add(on(radius_a, kBushing) && lug_a, kBushingOutside);
  return set;
}

/// Collects bricks, gives vertices of equal (rounded) position one number, cuts bricks into tets.
class Builder {
 public:
  using Brick = std::array<int, 8>;  // corner i at (i & 1, i >> 1 & 1, i >> 2)

  void add_brick(const std::array<Vec3, 8>& corners, int ref) {
    Brick b{};
    for (int i = 0; i < 8; ++i) b[i] = vertex(corners[i]);
    // All diagonals start at the smallest vertex of their face, so neighbours agree: a cone from
    // the brick's smallest vertex over the three faces that do not hold it.
    const int apex = static_cast<int>(std::min_element(b.begin(), b.end()) - b.begin());
    for (int axis = 0; axis < 3; ++axis) add_cone(b, apex, axis, ref);
  }

  /// One layered block: plan(i, j) for i in [0, ni], j in [0, nj].
  void add_block(int ni, int nj, const std::function<Point2(int, int)>& plan,
                 const Embedding& embed, const std::function<int(int, int)>& ref) {
    for (int i = 0; i < ni; ++i)
      for (int j = 0; j < nj; ++j)
        for (std::size_t k = 0; k + 1 < kLayers.size(); ++k) {
          std::array<Vec3, 8> corners;
          for (int c = 0; c < 8; ++c)
            corners[c] = embed(plan(i + (c & 1), j + (c >> 1 & 1)),
                               kThickness * kLayers[k + static_cast<std::size_t>(c >> 2)]);
          add_brick(corners, ref(i, j));
        }
  }

  Bracket finish() {
    add_triangles();
    return std::move(bracket_);
  }

 private:
  int vertex(const Vec3& where) {
    const Vec3 p = rounded(where);
    const auto [it, is_new] =
        ids_.try_emplace({p.x, p.y, p.z}, static_cast<int>(bracket_.mesh.vertices.size()));
    if (is_new) {
      bracket_.mesh.vertices.push_back(p);
      bracket_.mesh.vertex_refs.push_back(0);
      bracket_.surfaces_of_vertex.push_back(surfaces_at(p));
    }
    return it->second;
  }

  void add_cone(const Brick& b, int apex, int axis, int ref) {
    const int far = (apex ^ (1 << axis)) & (1 << axis), s = 1 << (axis + 1) % 3,
              t = 1 << (axis + 2) % 3;
    std::array<int, 4> face = {b[far], b[far | s], b[far | s | t], b[far | t]};
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    add_tet({b[apex], face[0], face[1], face[2]}, ref);
    add_tet({b[apex], face[0], face[2], face[3]}, ref);
  }

  void add_tet(std::array<std::int32_t, 4> t, int ref) {
    const auto& p = bracket_.mesh.vertices;
    if (volume6(p[t[0]], p[t[1]], p[t[2]], p[t[3]]) < 0) std::swap(t[2], t[3]);
    bracket_.mesh.tets.push_back(t);
    bracket_.mesh.tet_refs.push_back(ref);
  }

  /// Faces of one tet only, and faces between references.
  void add_triangles() {
    std::map<std::array<int, 3>, std::pair<std::array<std::int32_t, 3>, int>> open;
    const auto& mesh = bracket_.mesh;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
      for (const auto& f : {std::array{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}) {
        const std::array<std::int32_t, 3> v = {mesh.tets[t][f[0]], mesh.tets[t][f[1]],
                                               mesh.tets[t][f[2]]};
        std::array<int, 3> key = {v[0], v[1], v[2]};
        std::sort(key.begin(), key.end());
        const auto [it, is_new] = open.try_emplace(key, v, mesh.tet_refs[t]);
        if (is_new) continue;
        if (it->second.second != mesh.tet_refs[t]) add_triangle(v);
        open.erase(it);
      }
    for (const auto& [key, face] : open) add_triangle(face.first);
  }

  void add_triangle(const std::array<std::int32_t, 3>& v) {
    const auto& on = bracket_.surfaces_of_vertex;
    const unsigned common = on[v[0]] & on[v[1]] & on[v[2]];
    int surface = 0;
    while (surface < kSurfaces && !(common >> surface & 1)) ++surface;
    bracket_.mesh.triangles.push_back(v);
    bracket_.mesh.triangle_refs.push_back(surface + 1);
  }

  Bracket bracket_;
  std::map<std::array<double, 3>, int> ids_;
};

void add_lug(Builder& builder, const Embedding& embed, int bushing_ref) {
  builder.add_block(
      static_cast<int>(kRings.size()), kAround, [](int ring, int k) { return on_ring(ring, k); },
      embed, [=](int ring, int) { return ring == 0 ? bushing_ref : kBody; });
  const auto arm = [](int i, int j) {
    return Point2{kEnd + kArmRows[i] * (kArm - kEnd), kEnd * (2.0 * j / kAcross - 1)};
  };
  builder.add_block(static_cast<int>(kArmRows.size()) - 1, kAcross, arm, embed,
                    [](int, int) { return kBody; });
}

}  // namespace

Vec3 rounded(const Vec3& p) {
  constexpr double kPerMillimetre = 1e6;
  // + 0.0 turns -0 into 0, which would be another key and another text.
  const auto round = [](double x) { return std::round(x * kPerMillimetre) / kPerMillimetre + 0.0; };
  return {round(p.x), round(p.y), round(p.z)};
}

int fixed_axis(unsigned surfaces) {
  switch (surfaces) {
    case 0:
      return 3;
    case 1u << kBottom:
    case 1u << kTop:
      return 2;
    case 1u << kRightSide:
    case 1u << kLeftSide:
      return 1;
    case 1u << kBack:
    case 1u << kFront:
      return 0;
    default:
      return -1;
  }
}

Bracket make_bracket() {
  Builder builder;
  add_lug(
      builder,
      [](Point2 p, double w) {
        return Vec3{p.u, p.v, w};
      },
      kBushingRef);
  add_lug(
      builder,
      [](Point2 p, double w) {
        return Vec3{kArm + w, p.v, kUprightAxis - p.u};
      },
      kBody);
  const auto corner = [](int i, int j) {
    return Point2{kArm + kThickness * kLayers[i], kEnd * (2.0 * j / kAcross - 1)};
  };
  builder.add_block(
      static_cast<int>(kLayers.size()) - 1, kAcross, corner,
      [](Point2 p, double w) {
        return Vec3{p.u, p.v, w};
      },
      [](int, int) { return kBody; });
  return builder.finish();
}

}  // namespace cavea::sample
