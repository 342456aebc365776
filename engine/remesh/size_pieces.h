#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "cavea/geometry/predicates.h"
#include "cavea/mesh/wanted_tets.h"
#include "cavea/remesh/size_law.h"

namespace cavea {

inline double volume_of(const std::array<Vec3, 4>& tet) {
  return std::abs(volume6(tet[0], tet[1], tet[2], tet[3])) / 6;
}

namespace size_pieces_detail {

/// Where sizes differ by no more than this the rule of five points is good to a tenth.
constexpr double kSimilar = 2;

/// What is to be divided into fewer regular tets is not looked into.
constexpr double kDivided = 8;

/// Nor is it worth more where there is no more than this in a piece.
constexpr double kFewTets = 1;

/// Eight halvings of all edges: pieces of a 256th of the tet's edges, where sizes jump.
constexpr int kMostBisections = 24;

/// A piece of a tet, with the wanted sizes at its corners.
struct Piece {
  std::array<Vec3, 4> corners;
  std::array<double, 4> sizes;

  Vec3 center() const { return (corners[0] + corners[1] + corners[2] + corners[3]) / 4; }
};

template <class Visit>
class Pieces {
 public:
  Pieces(const TetMesh& mesh, TetId t, const SizeLaw& law, Visit& visit)
      : mesh_(mesh), t_(t), law_(law), visit_(visit) {}

  void run() const {
    Piece whole{mesh_.corners(t_), {}};
    for (int k = 0; k < 4; ++k) whole.sizes[k] = mesh_.sizes[mesh_.tets[t_][k]];
    // Its vertices know all there is to know of a tet that is about as small as wanted.
    const double least = std::ranges::min(whole.sizes), volume = volume_of(whole.corners);
    if (regular_tets(volume, least) <= kDivided) return visit_(volume, least);
    for (int k = 0; k < 4; ++k) whole.sizes[k] = size_at(whole.corners[k]);
    divide(whole, 0);
  }

 private:
  double size_at(const Vec3& p) const { return law_.at(mesh_, t_, p); }

  void divide(const Piece& piece, int depth) const {
    const double middle = size_at(piece.center());
    const double least = std::min(std::ranges::min(piece.sizes), middle),
                 most = std::max(std::ranges::max(piece.sizes), middle);
    const bool is_enough = depth == kMostBisections || most <= kSimilar * least ||
                           regular_tets(volume_of(piece.corners), least) <= kFewTets;
    is_enough ? visit_five_points(piece, middle) : bisect(piece, depth);
  }

  /// Exact for quadratic densities.
  void visit_five_points(const Piece& piece, double middle) const {
    const double volume = volume_of(piece.corners);
    visit_(0.8 * volume, middle);
    for (const double size : piece.sizes) visit_(0.05 * volume, size);
  }

  void bisect(const Piece& piece, int depth) const {
    const auto length2 = [&](const int* e) {
      return distance2(piece.corners[e[0]], piece.corners[e[1]]);
    };
    const int* longest = kEdgeVertices[0];
    for (const auto& e : kEdgeVertices)
      if (length2(e) > length2(longest)) longest = e;
    const Vec3 middle = (piece.corners[longest[0]] + piece.corners[longest[1]]) / 2;
    const double size = size_at(middle);
    for (int k = 0; k < 2; ++k) {
      Piece half = piece;
      half.corners[longest[k]] = middle;
      half.sizes[longest[k]] = size;
      divide(half, depth + 1);
    }
  }

  const TetMesh& mesh_;
  const TetId t_;
  const SizeLaw& law_;
  Visit& visit_;
};

}  // namespace size_pieces_detail

/// Calls visit(volume, size) for pieces that a tet's volume consists of, with the size that is
/// wanted in each.
template <class Visit>
void for_each_size(const TetMesh& mesh, TetId t, const SizeLaw& law, Visit&& visit) {
  size_pieces_detail::Pieces(mesh, t, law, visit).run();
}

/// The same for all tets of a mesh, or if these are many for some thousands of them, each with the
/// volume of several: looking sizes up takes time. \pre no holes
template <class Visit>
void for_each_size_about(const TetMesh& mesh, const SizeLaw& law, Visit&& visit) {
  constexpr std::size_t kSample = 5000;
  const std::size_t stride = std::max<std::size_t>(1, mesh.tets.size() / kSample);
  for (std::size_t t = 0; t < mesh.tets.size(); t += stride)
    for_each_size(mesh, TetId(t), law,
                  [&](double volume, double size) { visit(double(stride) * volume, size); });
}

}  // namespace cavea
