#include "cavea/surface/sheets.h"

#include <algorithm>
#include <cmath>

#include "cavea/base/parallel.h"
#include "cavea/geometry/closest.h"
#include "cavea/surface/touching.h"

namespace cavea {
namespace {

constexpr std::size_t kGrain = 64;

std::vector<Box> boxes_of(std::span<const Sheets::Corners> triangles) {
  std::vector<Box> boxes(triangles.size());
  parallel_for(boxes.size(), [&](std::size_t t) {
    for (const Vec3& p : triangles[t]) boxes[t].add(p);
  });
  return boxes;
}

/// The least dot(n, m) of all m in the box, bit for bit: rounding keeps the order.
double least_dot(const Vec3& n, const Box& box) {
  return std::min(n.x * box.low.x, n.x * box.high.x) + std::min(n.y * box.low.y, n.y * box.high.y) +
         std::min(n.z * box.low.z, n.z * box.high.z);
}

double square(double x) { return x * x; }

double most_dot(const Vec3& n, const Box& box) { return -least_dot(-n, box); }

}  // namespace

Sheets::Sheets(std::vector<Corners> triangles, std::vector<std::array<std::int32_t, 3>> vertices,
               std::vector<char> one_sided)
    : triangles_(std::move(triangles)),
      vertices_(std::move(vertices)),
      one_sided_(std::move(one_sided)),
      normals_(triangles_.size()),
      tree_(boxes_of(triangles_)) {
  parallel_for(normals_.size(), [&](std::size_t t) {
    const auto& [a, b, c] = triangles_[t];
    normals_[t] = normalized(cross(b - a, c - a));
  });
  std::vector<Box> of_triangle(normals_.size());
  parallel_for(normals_.size(), [&](std::size_t t) {
    of_triangle[t].add(normals_[t]);
    if (!one_sided_[t]) of_triangle[t].add(-normals_[t]);
  });
  normals_of_node_ = tree_.node_boxes(of_triangle);
  if (triangles_.empty()) return;
  const Box& all = tree_.box_of(0);
  const Vec3 largest = {std::max(-all.low.x, all.high.x), std::max(-all.low.y, all.high.y),
                        std::max(-all.low.z, all.high.z)};
  rounding2_ = square(kTouching) * norm2(largest);
}

bool Sheets::apart(std::size_t s, std::size_t t) const {
  for (const std::int32_t v : vertices_[s])
    if (std::find(vertices_[t].begin(), vertices_[t].end(), v) != vertices_[t].end()) return false;
  return true;
}

bool Sheets::may_face(std::size_t t, std::size_t s, const Facing& facing) const {
  const double cosine = dot(normals_[s], normals_[t]);
  // Which way the normal of an interface points is chance.
  const double turned = one_sided_[s] && one_sided_[t] ? cosine : -std::abs(cosine);
  return turned <= facing.normals_cosine && apart(s, t);
}

bool Sheets::some_may_face(std::size_t t, std::size_t node, const Facing& facing) const {
  const Box& normals = normals_of_node_[node];
  return least_dot(normals_[t], normals) <= facing.normals_cosine ||
         (!one_sided_[t] && least_dot(-normals_[t], normals) <= facing.normals_cosine);
}

template <class Place>
bool Sheets::some_may_be_opposite(std::size_t t, const Place& place, double height,
                                  std::size_t node, const Facing& facing) const {
  // Most of what is near is the sheet of t itself, which turns away from it nowhere, or is aside of
  // the cone ahead, or, in thin bodies, on their other side, behind the plane of t.
  const Box& below = tree_.box_of(node);
  const double ahead = most_dot(facing.side * normals_[t], below) - height;
  return ahead >= 0 && square(ahead) >= square(facing.cone_cosine) * below.distance2(place) &&
         some_may_face(t, node, facing);
}

void Sheets::improve(std::size_t t, const Vec3& place, std::size_t s, const Facing& facing,
                     Hit& hit) const {
  const auto& [a, b, c] = triangles_[s];
  const ClosestOnTriangle near = closest_on_triangle(place, a, b, c);
  if (!(near.distance2 < hit.distance2)) return;
  const Vec3 to = a + near.u * (b - a) + near.v * (c - a) - place;
  if (!facing.touching && norm2(to) <= rounding2_) return;
  if (dot(to, facing.side * normals_[t]) >= facing.cone_cosine * norm(to))
    hit = {std::int32_t(s), near.distance2};
}

template <class Place>
Sheets::Hit Sheets::nearest(std::size_t t, const Place& around, std::span<const Vec3> places,
                            const Facing& facing, double reach) const {
  double height = std::numeric_limits<double>::infinity();
  for (const Vec3& p : places) height = std::min(height, dot(facing.side * normals_[t], p));
  Hit hit{-1, reach * reach};
  tree_.visit_near(
      around, hit.distance2,
      [&](std::size_t node) { return some_may_be_opposite(t, around, height, node, facing); },
      [&](std::size_t slot) {
        const auto s = std::size_t(tree_.order()[slot]);
        if (!may_face(t, s, facing)) return;
        for (const Vec3& p : places) improve(t, p, s, facing, hit);
      });
  return hit;
}

double Sheets::distance2(const Vec3& place, double bound2) const {
  tree_.visit_near(place, bound2, [&](std::size_t slot) {
    const auto& [a, b, c] = triangles_[std::size_t(tree_.order()[slot])];
    bound2 = std::min(bound2, closest_on_triangle(place, a, b, c).distance2);
  });
  return bound2;
}

double Sheets::opposite(std::size_t t, const Vec3& place, const Facing& facing,
                        double reach) const {
  const Hit hit = nearest(t, place, {&place, 1}, facing, reach);
  return hit.triangle < 0 ? kNothing : std::sqrt(hit.distance2);
}

Sheets::Hit Sheets::nearest_of_triangle(std::size_t t, const Facing& facing, double reach) const {
  const auto& [a, b, c] = triangles_[t];
  const Vec3 places[] = {a, b, c, (a + b + c) / 3};
  return nearest(t, box_of(triangles_[t]), places, facing, reach);
}

std::vector<double> Sheets::all_opposite(const Facing& facing,
                                         const std::function<double(std::size_t)>& reach) const {
  std::vector<Hit> hits(triangles_.size());
  parallel_for(
      hits.size(),
      [&](std::size_t t) {
        if (const double r = reach(t); r > 0) hits[t] = nearest_of_triangle(t, facing, r);
      },
      kGrain);
  std::vector<double> nearest(hits.size(), kNothing);
  for (std::size_t t = 0; t < hits.size(); ++t) {
    if (hits[t].triangle < 0) continue;
    const double d = std::sqrt(hits[t].distance2);
    for (const std::size_t s : {t, std::size_t(hits[t].triangle)})
      nearest[s] = std::min(nearest[s], d);
  }
  return nearest;
}

}  // namespace cavea
