#include "cavea/surface/crossings.h"

#include <algorithm>

#include "cavea/base/parallel.h"
#include "cavea/geometry/box_tree.h"
#include "cavea/geometry/predicates.h"

namespace cavea {
namespace {

constexpr std::size_t kGrain = 256;

/// Sign of the volume of (a, b, c, d), 0 where rounding leaves it open.
int side(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return certainly_positive(a, b, c, d) ? 1 : certainly_positive(b, a, c, d) ? -1 : 0;
}

class Boundary {
 public:
  explicit Boundary(const TetMesh& mesh) : mesh_(mesh) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      if (mesh.triangles[t].alive() && mesh.triangles[t].sides[1].is_unset())
        ids_.push_back(TriangleId(t));
  }

  std::vector<Crossing> crossings() const {
    std::vector<Box> boxes(ids_.size());
    parallel_for(boxes.size(), [&](std::size_t i) {
      for (VertexId v : triangle(i).v) boxes[i].add(mesh_.points[v]);
    });
    const BoxTree tree(boxes);
    std::vector<std::vector<Crossing>> found((ids_.size() + kGrain - 1) / kGrain);
    parallel_for(
        found.size(),
        [&](std::size_t k) {
          for (std::size_t i = k * kGrain; i < std::min(ids_.size(), (k + 1) * kGrain); ++i)
            tree.visit_overlapping(boxes[i], [&](std::size_t slot) {
              const auto j = std::size_t(tree.order()[slot]);
              if (i < j) test(i, j, found[k]);
            });
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
  const Triangle& triangle(std::size_t i) const { return mesh_.triangles[ids_[i]]; }

  void test(std::size_t i, std::size_t j, std::vector<Crossing>& found) const {
    for (const auto& [through, of] : {std::pair(i, j), std::pair(j, i)})
      for (int k = 0; k < 3; ++k) {
        const VertexId p = triangle(of).v[k], q = triangle(of).v[(k + 1) % 3];
        if (!passes(p, q, triangle(through))) continue;
        found.push_back({ids_[i], ids_[j], (mesh_.points[p] + mesh_.points[q]) / 2});
        return;
      }
  }

  /// Whether the edge pq passes through the inside of a triangle that has neither of them.
  bool passes(VertexId p, VertexId q, const Triangle& t) const {
    const auto& x = mesh_.points;
    for (VertexId v : t.v)
      if (v == p || v == q) return false;
    const auto& [a, b, c] = t.v;
    const int above = side(x[a], x[b], x[c], x[p]);
    if (above == 0 || side(x[a], x[b], x[c], x[q]) != -above) return false;
    const int turn = side(x[p], x[q], x[a], x[b]);
    return turn != 0 && side(x[p], x[q], x[b], x[c]) == turn &&
           side(x[p], x[q], x[c], x[a]) == turn;
  }

  const TetMesh& mesh_;
  std::vector<TriangleId> ids_;
};

}  // namespace

std::vector<Crossing> find_crossings(const TetMesh& mesh) { return Boundary(mesh).crossings(); }

}  // namespace cavea
