#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "cavea/base/ids.h"
#include "cavea/geometry/quality.h"
#include "cavea/geometry/vec3.h"

namespace cavea {

/// Face i of a tet lies opposite its vertex i; in this order it is seen counter-clockwise from
/// outside when the volume is positive.
inline constexpr int kFaceVertices[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
/// The six edges of a tet, and for each the two other vertices so that (first, second, third,
/// fourth) is an even permutation: the tet keeps its orientation.
inline constexpr int kEdgeVertices[6][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2},
                                            {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}};

/// What lies behind a face of a tet, in 32 bits:
///  - a tet (code 4 * tet + face of that tet, not negative),
///  - a surface triangle: the exterior, or a neighbour of other reference, reached through the
///    triangle's sides,
///  - in a part only: the interface to another part, numbered in the part's list of cut faces.
class FaceLink {
 public:
  FaceLink() = default;
  static FaceLink to_tet(TetId t, int face) { return FaceLink(4 * t + face); }
  static FaceLink to_triangle(TriangleId t) { return FaceLink(-2 - t); }
  static FaceLink to_cut(std::int32_t k) { return FaceLink(kFirstCut - k); }
  static FaceLink from_code(std::int32_t code) { return FaceLink(code); }

  bool is_tet() const { return code_ >= 0; }
  bool is_triangle() const { return code_ < kUnset && code_ > kFirstCut; }
  bool is_cut() const { return code_ <= kFirstCut; }
  bool is_unset() const { return code_ == kUnset; }
  TetId tet() const { return code_ >> 2; }
  int face() const { return code_ & 3; }
  TriangleId triangle() const { return -2 - code_; }
  std::int32_t cut() const { return kFirstCut - code_; }
  std::int32_t code() const { return code_; }
  friend bool operator==(FaceLink, FaceLink) = default;

 private:
  static constexpr std::int32_t kUnset = -1;
  static constexpr std::int32_t kFirstCut = -(std::int32_t{1} << 30);
  explicit FaceLink(std::int32_t code) : code_(code) {}
  std::int32_t code_ = kUnset;
};

/// Tags of vertices, surface triangles and their edges; a set of bits.
using Tag = std::uint16_t;
namespace tag {
inline constexpr Tag kSurface = 1;  ///< vertex: on a surface triangle
inline constexpr Tag kRidge = 2;    ///< sharp edge; vertex: on one
inline constexpr Tag kReferenceEdge =
    4;  ///< edge between references or given in the input; vertex: on one
inline constexpr Tag kCorner = 8;     ///< vertex that must neither move nor vanish
inline constexpr Tag kRequired = 16;  ///< must stay exactly as it is
inline constexpr Tag kNonManifold =
    32;                             ///< edge of three or more surface triangles; vertex: on one
inline constexpr Tag kFrozen = 64;  ///< vertex or triangle shared with another part
/// Vertex of a required edge or tet inside the volume: an edge between two of them is not touched.
inline constexpr Tag kOnRequiredEdge = 128;
/// Vertex that stands on the straight edge because the place on the surface was not reachable.
inline constexpr Tag kOffSurface = 256;
/// Vertex that was on the interface between parts in the last round; the next cut avoids it.
inline constexpr Tag kWasInterface = 512;
/// Edge or vertex in which the volume touches itself: not all of its tets are reached from one of
/// them through faces, so local operations see a part of them only and leave it as it is.
inline constexpr Tag kPinched = 1024;
/// Triangle between tets of one reference, kept on request.
inline constexpr Tag kInternal = 2048;
/// Vertex that was on the interface between parts in a round of the last phase; for statistics.
inline constexpr Tag kMetInterface = 4096;
/// Vertex inside, among tets that are not good, that a seed may take the place of.
inline constexpr Tag kReplaceable = 8192;
/// Ridge or corner that the input lists.
inline constexpr Tag kGiven = 16384;
/// What makes an edge part of a feature curve; vertex: on one.
inline constexpr Tag kOnCurve = kRidge | kReferenceEdge | kNonManifold;
/// What makes a surface edge one that patches end at.
inline constexpr Tag kFeature = kOnCurve | kRequired;

/// Whether nothing binds a vertex of these tags: it is inside of the volume, and what it has are at
/// most tags of parts.
constexpr bool is_unbound(Tag of_vertex) {
  return (of_vertex & ~(kWasInterface | kMetInterface)) == 0;
}
}  // namespace tag

/// Where a surface vertex stands on the frozen input surface: a facet of the snapshot and the
/// barycentric coordinates of its second and third vertex.
struct Anchor {
  std::int32_t facet = kNone;
  float u = 0, v = 0;
};

/// A triangle of the exterior boundary or of an interface between references.
struct Triangle {
  std::array<VertexId, 3> v{kNone, kNone, kNone};  ///< counter-clockwise from outside of sides[0]
  /// The tet faces it covers; sides[1] is unset on the exterior boundary.
  std::array<FaceLink, 2> sides{};
  std::int32_t ref = 0;
  std::int32_t patch = 0;         ///< smooth piece of the snapshot that it belongs to
  std::array<Tag, 3> edge_tag{};  ///< of the edge opposite each vertex
  std::array<std::int32_t, 3> edge_ref{};
  Tag tags = 0;

  bool alive() const { return v[0] != kNone; }
  /// Of the exterior boundary, which has tets on one side only.
  bool is_exterior() const { return alive() && sides[1].is_unset(); }
};

/// The surface's normal at a vertex as the input says; not of unit length, of either direction.
struct GivenNormal {
  VertexId vertex = kNone;
  Vec3 normal;
};

/// A tetrahedral mesh with its surface triangles, as arrays. Ids of removed entities stay as holes
/// (alive() is false) until compact(). All vectors of one kind of entity have the same length.
struct TetMesh {
  // vertices
  std::vector<Vec3> points;
  std::vector<float> sizes;  ///< wanted edge length at the vertex; 0 where not yet known
  std::vector<Tag> vertex_tags;
  std::vector<std::int32_t> vertex_refs;
  std::vector<TetId> vertex_tets;  ///< one tet of the ball, kNone for a removed vertex
  std::vector<Anchor> anchors;

  // tetrahedra
  std::vector<std::array<VertexId, 4>> tets;  ///< [0] is kNone for a removed tet
  std::vector<std::array<FaceLink, 4>> links;
  std::vector<float> qualities;
  std::vector<std::int32_t> tet_refs;
  std::vector<std::uint8_t> tet_flags;

  // surface
  std::vector<Triangle> triangles;
  /// By vertex, at most one each; for the surface model, after which they are out of date.
  std::vector<GivenNormal> normals;

  bool vertex_alive(VertexId v) const { return vertex_tets[v] != kNone; }
  bool tet_alive(TetId t) const { return tets[t][0] != kNone; }

  std::array<Vec3, 4> corners(TetId t) const {
    const auto& k = tets[t];
    return {points[k[0]], points[k[1]], points[k[2]], points[k[3]]};
  }
  double compute_quality(TetId t) const {
    const auto [a, b, c, d] = corners(t);
    return tet_quality(a, b, c, d);
  }
  /// Local index of vertex v in tet t; 4 if it is none of its vertices.
  int local_index(TetId t, VertexId v) const {
    const auto& k = tets[t];
    return k[0] == v ? 0 : k[1] == v ? 1 : k[2] == v ? 2 : k[3] == v ? 3 : 4;
  }
  /// The face behind face f of tet t, through a surface triangle if there is one; unset at the
  /// exterior boundary and a cut at the interface of a part.
  FaceLink across(TetId t, int f) const {
    const FaceLink link = links[t][f];
    if (!link.is_triangle()) return link;
    const Triangle& s = triangles[link.triangle()];
    return s.sides[0] == FaceLink::to_tet(t, f) ? s.sides[1] : s.sides[0];
  }

  void resize_vertices(std::size_t n) {
    points.resize(n);
    sizes.resize(n);
    vertex_tags.resize(n);
    vertex_refs.resize(n);
    vertex_tets.resize(n, kNone);
    anchors.resize(n);
  }
  void resize_tets(std::size_t n) {
    tets.resize(n, {kNone, kNone, kNone, kNone});
    links.resize(n);
    qualities.resize(n);
    tet_refs.resize(n);
    tet_flags.resize(n);
  }
  void reserve_vertices(std::size_t n) {
    points.reserve(n);
    sizes.reserve(n);
    vertex_tags.reserve(n);
    vertex_refs.reserve(n);
    vertex_tets.reserve(n);
    anchors.reserve(n);
  }
  void reserve_tets(std::size_t n) {
    tets.reserve(n);
    links.reserve(n);
    qualities.reserve(n);
    tet_refs.reserve(n);
    tet_flags.reserve(n);
  }
};

namespace tet_flag {
inline constexpr std::uint8_t kRequired = 1;  ///< the tet must stay exactly as it is
/// New, or a vertex has moved, since the quality operators last asked all its edges and faces.
inline constexpr std::uint8_t kAskSwap = 2;
inline constexpr std::uint8_t kAskMove = 4;    ///< same, for the relocation of its vertices
inline constexpr std::uint8_t kAskLength = 8;  ///< same, for split and collapse of its edges
inline constexpr std::uint8_t kAskAll = kAskSwap | kAskMove | kAskLength;
/// Something was refused because the interface of the part is near: ask all again when it has
/// moved.
inline constexpr std::uint8_t kAskLater = 16;
/// Refused so when it was last asked.
inline constexpr std::uint8_t kBlocked = 32;
}  // namespace tet_flag

}  // namespace cavea
