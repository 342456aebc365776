#include "cavea/subdivide/pattern.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace cavea {
namespace {

constexpr int kLocalEdge[4][4] = {{-1, 0, 1, 2}, {0, -1, 3, 4}, {1, 3, -1, 5}, {2, 4, 5, -1}};

constexpr unsigned edge_bit(int i, int j) { return 1u << kLocalEdge[i][j]; }
/// Local id of the vertex on edge (i, j).
constexpr int mid(int i, int j) { return 4 + kLocalEdge[i][j]; }
/// The split edges of the face opposite corner f, when all three are.
constexpr unsigned face_edges(int f) {
  const auto& k = kFaceVertices[f];
  return edge_bit(k[0], k[1]) | edge_bit(k[1], k[2]) | edge_bit(k[2], k[0]);
}

/// Twice the coordinates of a local id in the unit tet.
struct Place {
  int x[3] = {0, 0, 0};
};

constexpr Place place_of(int local) {
  Place p;
  auto add = [&p](int corner, int amount) {
    if (corner > 0) p.x[corner - 1] += amount;
  };
  if (local < 4) {
    add(local, 2);
  } else {
    add(kEdgeVertices[local - 4][0], 1);
    add(kEdgeVertices[local - 4][1], 1);
  }
  return p;
}

/// Eight times the volume of a tet of local ids, in volumes of the split tet.
constexpr int eighths(int a, int b, int c, int d) {
  const Place o = place_of(a);
  int m[3][3] = {};
  for (int k = 0; k < 3; ++k) {
    const Place p = place_of(k == 0 ? b : k == 1 ? c : d);
    for (int i = 0; i < 3; ++i) m[k][i] = p.x[i] - o.x[i];
  }
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}
static_assert(eighths(0, 1, 2, 3) == 8);

class PatternMaker {
 public:
  PatternMaker(const SplitTet& tet, const std::vector<Vec3>& points) : tet_(tet), points_(points) {}

  TetPattern make() {
    if (tet_.mask == 63) {
      regular();
    } else if (std::popcount(tet_.mask) == 5) {
      all_but_one();
    } else if (const int face = full_face(); face == 4) {
      bisect();
    } else if (tet_.mask == face_edges(face)) {
      one_face();
    } else {
      face_and_edge(face);
    }
    return pattern_;
  }

 private:
  void add(int a, int b, int c, int d) {
    pattern_.tets[pattern_.count++] = {std::uint8_t(a), std::uint8_t(b), std::uint8_t(c),
                                       std::uint8_t(d)};
  }
  /// Adds a tet in the orientation that makes it positive.
  void add_turned(int a, int b, int c, int d) {
    if (eighths(a, b, c, d) < 0) std::swap(c, d);
    add(a, b, c, d);
  }
  /// Adds the tet that corner c and the vertices on its three edges make.
  void add_corner(int c) {
    const int i = (c + 1) % 4, j = (c + 2) % 4, k = (c + 3) % 4;
    add_turned(c, mid(c, i), mid(c, j), mid(c, k));
  }
  bool smaller(int i, int j) const { return tet_.vertices[i] < tet_.vertices[j]; }
  double diagonal2(int i, int j) const {
    return distance2(points_[tet_.vertices[i]], points_[tet_.vertices[j]]);
  }
  int full_face() const {
    int f = 0;
    while (f < 4 && (tet_.mask & face_edges(f)) != face_edges(f)) ++f;
    return f;
  }

  /// Where no face has three split edges: bisects the edges one after the other, by falling
  /// (larger end, smaller end). Of two edges from one corner the one with the larger other end
  /// comes first, so that the later one's vertex is joined to the first one's, and the diagonal is
  /// at the smaller of the other ends, on whichever side of the face; and no order can be cyclic.
  void bisect() {
    add(0, 1, 2, 3);
    auto key = [&](int e) {
      const VertexId a = tet_.vertices[kEdgeVertices[e][0]], b = tet_.vertices[kEdgeVertices[e][1]];
      return std::pair(std::max(a, b), std::min(a, b));
    };
    for (unsigned left = tet_.mask; left != 0;) {
      int largest = std::countr_zero(left);
      for (int e = largest + 1; e < 6; ++e)
        if ((left >> e & 1) && key(e) > key(largest)) largest = e;
      bisect_edge(largest);
      left &= ~(1u << largest);
    }
  }
  void bisect_edge(int e) {
    const int i = kEdgeVertices[e][0], j = kEdgeVertices[e][1];
    for (int t = pattern_.count - 1; t >= 0; --t) {
      auto& tet = pattern_.tets[t];
      const auto at_i = std::find(tet.begin(), tet.end(), i);
      const auto at_j = std::find(tet.begin(), tet.end(), j);
      if (at_i == tet.end() || at_j == tet.end()) continue;
      auto& other = pattern_.tets[pattern_.count++] = tet;
      other[at_i - tet.begin()] = std::uint8_t(4 + e);
      *at_j = std::uint8_t(4 + e);
    }
  }

  /// Three split edges round a face: its four triangles, each joined to the opposite corner.
  void one_face() {
    const int d = full_face(), a = kFaceVertices[d][0], b = kFaceVertices[d][1],
              c = kFaceVertices[d][2];
    add_turned(d, a, mid(a, b), mid(a, c));
    add_turned(d, b, mid(b, c), mid(a, b));
    add_turned(d, c, mid(a, c), mid(b, c));
    add_turned(d, mid(a, b), mid(b, c), mid(a, c));
  }

  /// Joins the apex to what is left of a face without its corner x: the quadrilateral p, q and the
  /// vertices on xp and xq.
  void add_quad(int apex, int x, int p, int q) {
    if (smaller(q, p)) std::swap(p, q);
    add_turned(apex, p, q, mid(x, q));
    add_turned(apex, p, mid(x, q), mid(x, p));
  }

  /// Four split edges, three of them round a face abc and one from c to v: the corner c is cut off,
  /// the rest joined to the vertex on ab, which sees all of it whatever the diagonals.
  void face_and_edge(int v) {
    int c = 0;
    while (c == v || !(tet_.mask & edge_bit(v, c))) ++c;
    int a = 0;
    while (a == v || a == c) ++a;
    const int b = 6 - v - c - a, apex = mid(a, b);
    add_corner(c);
    add_turned(apex, mid(c, v), mid(c, a), mid(c, b));
    add_quad(apex, c, v, a);
    add_quad(apex, c, v, b);
  }

  /// All but edge ab: the corners c and d are cut off; a prism with edge ab is left, whose outer
  /// diagonals meet in its smaller end s, and a pyramid at the vertex on cd.
  void all_but_one() {
    const int e = std::countr_one(tet_.mask);
    int s = kEdgeVertices[e][0], o = kEdgeVertices[e][1];
    const int c = kEdgeVertices[e][2], d = kEdgeVertices[e][3];
    if (smaller(o, s)) std::swap(s, o);
    add_corner(c);
    add_corner(d);
    add_turned(s, o, mid(o, c), mid(o, d));
    std::array<int, 4> quad = {mid(s, c), mid(s, d), mid(o, d), mid(o, c)};
    if (diagonal2(quad[1], quad[3]) < diagonal2(quad[0], quad[2]))
      std::rotate(quad.begin(), quad.begin() + 1, quad.end());
    for (const int apex : {s, mid(c, d)}) {
      add_turned(apex, quad[0], quad[1], quad[2]);
      add_turned(apex, quad[0], quad[2], quad[3]);
    }
  }

  /// All six: the four corners, and the octahedron left in four round its shortest diagonal.
  void regular() {
    for (int c = 0; c < 4; ++c) add_corner(c);
    int best = 0;
    for (int e = 1; e < 3; ++e)
      if (diagonal2(4 + e, 9 - e) < diagonal2(4 + best, 9 - best)) best = e;
    // Edges e and 5 - e are opposite; the other two pairs alternate round the diagonal.
    const int p = 4 + best, q = 9 - best, r = 4 + (best + 1) % 3, s = 4 + (best + 2) % 3;
    const int ring[4] = {r, s, 13 - r, 13 - s};
    for (int k = 0; k < 4; ++k) add_turned(p, q, ring[k], ring[(k + 1) % 4]);
  }

  const SplitTet& tet_;
  const std::vector<Vec3>& points_;
  TetPattern pattern_;
};

}  // namespace

TetPattern tet_pattern(const SplitTet& tet, const std::vector<Vec3>& points) {
  return PatternMaker(tet, points).make();
}

std::array<unsigned, 4> face_masks() {
  std::array<unsigned, 4> masks{};
  for (int f = 0; f < 4; ++f) masks[f] = (15u & ~(1u << f)) | face_edges(f) << 4;
  return masks;
}

TrianglePattern triangle_pattern(const SplitTriangle& triangle) {
  TrianglePattern pattern;
  auto add = [&](int a, int b, int c) {
    pattern.triangles[pattern.count++] = {std::uint8_t(a), std::uint8_t(b), std::uint8_t(c)};
  };
  auto next = [](int i) { return (i + 1) % 3; };
  switch (std::popcount(triangle.mask)) {
    case 0:
      add(0, 1, 2);
      break;
    case 1: {
      const int i = std::countr_zero(triangle.mask), j = next(i), k = next(j);
      add(i, j, 3 + i);
      add(i, 3 + i, k);
      break;
    }
    case 2: {
      const int x = std::countr_one(triangle.mask), p = next(x), q = next(p);
      add(x, 3 + q, 3 + p);
      const bool at_p = triangle.vertices[p] < triangle.vertices[q];
      add(p, q, at_p ? 3 + p : 3 + q);
      add(at_p ? p : q, 3 + p, 3 + q);
      break;
    }
    default:
      for (int i = 0; i < 3; ++i) add(i, 3 + next(next(i)), 3 + next(i));
      add(3, 4, 5);
  }
  return pattern;
}

}  // namespace cavea
