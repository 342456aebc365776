#include "cavea/surface/crossings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "cavea/base/ids_where.h"
#include "cavea/base/parallel.h"
#include "cavea/geometry/box_tree.h"
#include "cavea/geometry/predicates.h"
#include "cavea/surface/touching.h"

namespace cavea {
namespace {

/// Triangles a task, and so many neighbours in the tree that look for others together.
constexpr std::size_t kGrain = 256, kTogether = 8;

/// Whether an edge that passes through a triangle is there farther from its border, and has ends
/// farther from its plane, than those of sheets that only touch.
bool is_deep(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& t) {
  double largest = 0;
  for (const Vec3& x : t)
    largest = std::max({largest, std::abs(x.x), std::abs(x.y), std::abs(x.z)});
  const double rounding = kTouching * largest;
  const Vec3 normal = normalized(cross(t[1] - t[0], t[2] - t[0]));
  const double above = dot(normal, p - t[0]), below = dot(normal, q - t[0]);
  if (std::min(std::abs(above), std::abs(below)) <= rounding) return false;
  const Vec3 at = p + above / (above - below) * (q - p);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 inward = normalized(cross(normal, t[(k + 1) % 3] - t[k]));
    if (dot(inward, at - t[k]) <= rounding) return false;
  }
  return true;
}

/// Whether edge k of a triangle passes through the inside of one that has neither of its ends.
bool passes(const PlacedTriangle& of, std::size_t k, const PlacedTriangle& t) {
  const std::size_t next = (k + 1) % 3;
  for (const VertexId v : t.v)
    if (v == of.v[k] || v == of.v[next]) return false;
  const Vec3 &p = of.corners[k], &q = of.corners[next];
  const auto& [a, b, c] = t.corners;
  const int above = certain_side(a, b, c, p);
  if (above == 0 || certain_side(a, b, c, q) != -above) return false;
  const int turn = certain_side(p, q, a, b);
  return turn != 0 && certain_side(p, q, b, c) == turn && certain_side(p, q, c, a) == turn &&
         is_deep(p, q, t.corners);
}

/// The middle of an edge of one triangle that passes through the other, if there is any.
std::optional<Vec3> crossing_of(const PlacedTriangle& a, const PlacedTriangle& b) {
  int common = 0;
  for (const VertexId v : a.v) common += int(std::ranges::count(b.v, v));
  if (common > 1) return {};  // no edge has neither of them
  for (const auto& [through, of] : {std::pair(&a, &b), std::pair(&b, &a)})
    for (std::size_t k = 0; k < 3; ++k)
      if (passes(*of, k, *through)) return (of->corners[k] + of->corners[(k + 1) % 3]) / 2;
  return {};
}

PlacedTriangle placed(const TetMesh& mesh, TriangleId t) {
  const auto& v = mesh.triangles[t].v;
  return {v, {mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]}};
}

class Boundary {
 public:
  explicit Boundary(const TetMesh& mesh)
      : mesh_(mesh), triangles_(ids_where(mesh.triangles.size(), [&](TriangleId t) {
          return mesh.triangles[t].is_exterior();
        })) {
    std::vector<Box> boxes(triangles_.size());
    parallel_for(boxes.size(),
                 [&](std::size_t i) { boxes[i] = box_of(placed(mesh, triangles_[i]).corners); });
    tree_.emplace(boxes);
    const std::vector<TriangleId> ids = triangles_;
    boxes_.resize(boxes.size());
    parallel_for(boxes.size(), [&](std::size_t slot) {
      const auto i = std::size_t(tree_->order()[slot]);
      triangles_[slot] = ids[i], boxes_[slot] = boxes[i];
    });
  }

  std::vector<Crossing> crossings() const {
    std::vector<std::vector<Crossing>> found((triangles_.size() + kGrain - 1) / kGrain);
    parallel_for(
        found.size(),
        [&](std::size_t k) {
          const std::size_t end = std::min(triangles_.size(), (k + 1) * kGrain);
          for (std::size_t i = k * kGrain; i < end; i += kTogether)
            look_around(i, std::min(end, i + kTogether), found[k]);
        },
        1);
    std::vector<Crossing> all;
    for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
    std::sort(all.begin(), all.end(), [](const Crossing& x, const Crossing& y) {
      return std::pair(x.a, x.b) < std::pair(y.a, y.b);
    });
    return all;
  }

 private:
  /// Tests the triangles of some slots with all of later slots.
  void look_around(std::size_t begin, std::size_t end, std::vector<Crossing>& found) const {
    Box around;
    for (std::size_t i = begin; i < end; ++i) around.add(boxes_[i]);
    tree_->visit_overlapping(around, [&](std::size_t j) {
      if (j <= begin || !boxes_[j].overlaps(around)) return;
      for (std::size_t i = begin; i < std::min(j, end); ++i)
        if (boxes_[i].overlaps(boxes_[j])) test(i, j, found);
    });
  }

  void test(std::size_t i, std::size_t j, std::vector<Crossing>& found) const {
    const auto [a, b] = std::minmax(triangles_[i], triangles_[j]);
    if (const auto where = crossing_of(placed(mesh_, a), placed(mesh_, b)))
      found.push_back({a, b, *where});
  }

  const TetMesh& mesh_;
  std::vector<TriangleId> triangles_;  ///< in the order of the slots, as their boxes
  std::vector<Box> boxes_;
  std::optional<BoxTree> tree_;
};

}  // namespace

std::vector<Crossing> find_crossings(const TetMesh& mesh) { return Boundary(mesh).crossings(); }

bool would_cross(const TetMesh& mesh, std::span<const PlacedTriangle> triangles,
                 std::span<const TriangleId> replaced) {
  Box around;
  std::vector<Box> boxes;
  for (const PlacedTriangle& t : triangles) {
    boxes.push_back(box_of(t.corners));
    for (const Vec3& p : t.corners) around.add(p);
  }
  const auto crosses = [&](const PlacedTriangle& other, std::size_t count) {
    const Box box = box_of(other.corners);
    if (!box.overlaps(around)) return false;
    for (std::size_t i = 0; i < count; ++i)
      if (boxes[i].overlaps(box) && crossing_of(triangles[i], other)) return true;
    return false;
  };
  for (std::size_t i = 0; i < triangles.size(); ++i)
    if (crosses(triangles[i], i)) return true;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mesh.triangles[t].is_exterior() &&
        std::ranges::find(replaced, TriangleId(t)) == replaced.end() &&
        crosses(placed(mesh, TriangleId(t)), triangles.size()))
      return true;
  return false;
}

}  // namespace cavea
