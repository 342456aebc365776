#include "cavea/surface/crossings.h"

#include <algorithm>
#include <array>
#include <optional>

#include "cavea/base/parallel.h"
#include "cavea/geometry/box_tree.h"
#include "cavea/geometry/predicates.h"

namespace cavea {
namespace {

/// Triangles a task, and so many neighbours in the tree that look for others together.
constexpr std::size_t kGrain = 256, kTogether = 8;

/// Sign of the volume of (a, b, c, d), 0 where rounding leaves it open.
int side(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return certainly_positive(a, b, c, d) ? 1 : certainly_positive(b, a, c, d) ? -1 : 0;
}

class Boundary {
 public:
  explicit Boundary(const TetMesh& mesh) {
    std::vector<Face> faces;
    std::vector<Box> boxes;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Triangle& s = mesh.triangles[t];
      if (!s.alive() || !s.sides[1].is_unset()) continue;
      const Face& f = faces.emplace_back(Face{
          TriangleId(t), s.v, {mesh.points[s.v[0]], mesh.points[s.v[1]], mesh.points[s.v[2]]}});
      Box& box = boxes.emplace_back();
      for (const Vec3& p : f.corner) box.add(p);
    }
    tree_.emplace(boxes);
    faces_.resize(faces.size()), boxes_.resize(faces.size());
    parallel_for(faces.size(), [&](std::size_t slot) {
      faces_[slot] = faces[std::size_t(tree_->order()[slot])];
      boxes_[slot] = boxes[std::size_t(tree_->order()[slot])];
    });
  }

  std::vector<Crossing> crossings() const {
    std::vector<std::vector<Crossing>> found((faces_.size() + kGrain - 1) / kGrain);
    parallel_for(
        found.size(),
        [&](std::size_t k) {
          const std::size_t end = std::min(faces_.size(), (k + 1) * kGrain);
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
  struct Face {
    TriangleId id;
    std::array<VertexId, 3> v;
    std::array<Vec3, 3> corner;
  };

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
    const bool in_order = faces_[i].id < faces_[j].id;
    const Face &a = faces_[in_order ? i : j], &b = faces_[in_order ? j : i];
    int common = 0;
    for (const VertexId v : a.v) common += int(std::ranges::count(b.v, v));
    if (common > 1) return;  // no edge has neither of them
    for (const auto& [through, of] : {std::pair(&a, &b), std::pair(&b, &a)})
      for (int k = 0; k < 3; ++k) {
        if (!passes(*of, k, *through)) continue;
        found.push_back({a.id, b.id, (of->corner[k] + of->corner[(k + 1) % 3]) / 2});
        return;
      }
  }

  /// Whether an edge passes through the inside of a triangle that has neither of its ends.
  static bool passes(const Face& of, int k, const Face& t) {
    for (const VertexId v : t.v)
      if (v == of.v[k] || v == of.v[(k + 1) % 3]) return false;
    const Vec3 &p = of.corner[k], &q = of.corner[(k + 1) % 3];
    const auto& [a, b, c] = t.corner;
    const int above = side(a, b, c, p);
    if (above == 0 || side(a, b, c, q) != -above) return false;
    const int turn = side(p, q, a, b);
    return turn != 0 && side(p, q, b, c) == turn && side(p, q, c, a) == turn;
  }

  std::vector<Face> faces_;  ///< in the order of the slots
  std::vector<Box> boxes_;
  std::optional<BoxTree> tree_;
};

}  // namespace

std::vector<Crossing> find_crossings(const TetMesh& mesh) { return Boundary(mesh).crossings(); }

}  // namespace cavea
