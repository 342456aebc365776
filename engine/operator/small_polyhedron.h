#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "cavea/geometry/vec3.h"

namespace cavea {

/// A polyhedron of at most 12 vertices, given as tets that fill it, and the search for the
/// tetrahedra without new vertices that fill it best: the small polyhedron reconnection of Marot
/// and Remacle (2020, arXiv 2009.00508), by branch and bound. All tables have a fixed size;
/// vertices are numbered from 0 in the order in which they come.
///
/// Faces are counted as a chain: each tet adds its four, oriented outwards, and a face seen from
/// both sides cancels. Tets of positive volume whose chain is that of the polyhedron cover each of
/// its points exactly once, so neither overlaps nor volumes need a test.
class SmallPolyhedron {
 public:
  static constexpr int kMaxVertices = 12;
  using Tet = std::array<std::uint8_t, 4>;

  void clear();
  int vertices() const { return vertices_; }
  /// \pre vertices() < kMaxVertices
  int add_vertex(const Vec3& point);
  /// Adds a tet of positive volume to the polyhedron. \pre outside of the tets that are there
  void add_tet(const Tet& tet);
  /// Vertices on the boundary, a bit each.
  std::uint32_t boundary() const;
  /// Largest quality that a tet on an outer face can have; `a, b, c` counter-clockwise from
  /// outside.
  float ceiling(int a, int b, int c) const;
  /// The same for all outer faces: no filling has a better worst quality.
  float ceiling() const;

  /// Looks for the filling with the largest worst quality above `threshold` (at least kFlat); false
  /// if there is none, or none was found within the bounds of the search. All vertices on the
  /// boundary and those of `kept` (a bit each) are in it, and of the others all but one at most.
  bool search(float threshold, std::uint32_t kept);
  std::span<const Tet> filling() const { return {best_.data(), std::size_t(best_size_)}; }

 private:
  static constexpr int kFaces = 220, kMaxTets = 40, kMaxFront = kFaces;
  /// An unordered triple of vertices and +1 or -1: whether the order is an even permutation of the
  /// sorted one.
  struct Side {
    std::uint8_t face;
    std::int8_t sign;
  };
  struct Candidate {
    float quality;
    std::uint8_t apex;
  };
  struct Candidates {
    std::array<Candidate, kMaxVertices> of;
    int size = 0;
  };
  /// Faces of the chain that the search has dealt with.
  static constexpr std::int8_t kClosed = 2;

  static Side side(int a, int b, int c);
  static std::array<std::uint8_t, 3> corners(Side side);
  /// Outer faces of the tet from the inner side of a face to x, but for that face.
  static std::array<Side, 3> other_faces(int x, const std::array<std::uint8_t, 3>& face);
  float best_on(int face) const;
  int faces() const;
  bool fits(const std::array<Side, 3>& others) const;
  Candidates candidates(int face) const;
  int most_constrained_face(Candidates& candidates) const;
  void branch(int face, const Candidate& candidate, float worst);
  void descend(float worst);
  void complete(float worst);

  int vertices_ = 0;
  std::array<Vec3, kMaxVertices> points_;
  /// Of the tet with its apex at a vertex over the face's sorted triple.
  std::array<std::array<float, kMaxVertices>, kFaces> quality_;
  std::array<std::int8_t, kFaces> chain_;  ///< of the polyhedron; in the search, what is not filled

  // the search
  std::array<std::uint8_t, kMaxFront> front_;  ///< the open faces are among these
  int front_size_ = 0, nodes_ = 0;
  std::array<Tet, kMaxTets> tets_, best_;
  int size_ = 0, best_size_ = 0;
  float bound_ = 0;
  std::uint32_t needed_ = 0;
};

}  // namespace cavea
