#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "cavea/base/id_map.h"
#include "cavea/cavity/cavity.h"
#include "cavea/cavity/verdict.h"

namespace cavea {

/// Whether p is inside the circumsphere of a positive tet or about on it: where points of lattices
/// are on common spheres and in common planes, the cavity is then what p sees all of. Whatever this
/// says, the cavity is proven by the qualities of its new tets.
inline bool in_sphere(const Vec3& p, const std::array<Vec3, 4>& tet) {
  constexpr double kOnSphere = 1e-9;  // rounding of points a thousandth of the mesh apart is 1e-12
  const Vec3 a = tet[0] - p, b = tet[1] - p, c = tet[2] - p, d = tet[3] - p;
  const Vec3 ab = cross(a, b), cd = cross(c, d);
  const double a2 = norm2(a), b2 = norm2(b), c2 = norm2(c), d2 = norm2(d);
  const double far2 = std::max(std::max(a2, b2), std::max(c2, d2));
  return a2 * dot(b, cd) - b2 * dot(a, cd) + c2 * dot(d, ab) - d2 * dot(c, ab) >
         -kOnSphere * far2 * far2 * std::sqrt(far2);
}

/// The cavity of the Delaunay kernel (Bowyer 1981, Watson 1981): what is reached from the first
/// tets through tets whose circumsphere contains the vertex, without crossing surface triangles,
/// made smaller until the vertex sees all its faces. So the mesh need not be Delaunay before, and
/// is as far as possible after. Tets of positive volume on all faces of the cavity cover each of
/// its points exactly once, whatever its shape: the sum of their oriented faces is its boundary.
class DelaunayCavity {
 public:
  /// Larger cavities are those of a mesh that is far from Delaunay.
  static constexpr std::size_t kMostTets = 512;
  /// Flatter tets are hard to repair; where the mesh is Delaunay, hardly any is.
  static constexpr double kLeastQuality = 1e-4;

  explicit DelaunayCavity(const TetMesh& mesh);

  /// \param first tets that the cavity must have
  /// \param admit(tet, k): k is the one vertex that no tet before it had, 4 for the first ones;
  /// kAccept takes it, kBreaksFeature leaves it out, all else ends the search with that verdict; of
  /// the first ones only acceptance will do
  template <class Admit>
  Verdict grow(const Vec3& p, std::span<const TetId> first, Admit&& admit) {
    first_.assign(first.begin(), first.end());
    tets_ = first_;
    taken_.clear();
    for (const TetId t : tets_) taken_[t] = kIn;
    for (const TetId t : tets_)
      if (const Verdict v = admit(t, 4); v != Verdict::kAccept) return v;
    inner_.clear();
    for (std::size_t i = 0; i < tets_.size(); ++i) {
      std::uint8_t inner = 0;
      for (int f = 0; f < 4; ++f) {
        const FaceLink link = mesh_.links[tets_[i]][f];
        if (!link.is_tet()) continue;
        std::int32_t& state = taken_[link.tet()];
        if (state == IdMap::kNew) {
          const Verdict v = ask(p, link, admit);
          if (v != Verdict::kAccept && v != Verdict::kBreaksFeature) return v;
          state = v == Verdict::kAccept ? kIn : kOut;
        }
        inner |= std::uint8_t(state << f);
      }
      inner_.push_back(inner);
    }
    inner_is_known_ = true;
    return Verdict::kAccept;
  }

  /// Leaves out tets with a face on which the vertex has no tet of at least this quality, once, and
  /// what is then not reached from the first ones any more; the new tets of what is left come into
  /// `cavity`, their fourth vertex unset. `is_open(triangle)` says whether a triangle is to vanish,
  /// so that its face needs no tet. \param all whether none was left out
  /// \return false if one of the first ones had to be
  template <class IsOpen>
  bool shrink_once(const Vec3& p, double least_quality, IsOpen&& is_open, Cavity& cavity,
                   bool& all) {
    all = true;
    cavity.tets.clear();
    bases_.clear();
    hidden_.clear();
    for (std::size_t i = 0; i < tets_.size(); ++i) {
      if (sees(p, i, least_quality, is_open, cavity)) continue;
      if (is_first(tets_[i])) return false;
      taken_[tets_[i]] = kOut;
      all = inner_is_known_ = false;
    }
    if (!all) keep_connected();
    return true;
  }

  /// Whether a vertex of the cavity would have no tets any more. \pre the new tets are in `cavity`
  bool encloses_vertex(const Cavity& cavity);
  /// Tells the cavity what its new tets link to, if its vertices are not too many. \pre no triangle
  /// was open, encloses_vertex() has been asked
  void link(Cavity& cavity);

  const std::vector<TetId>& tets() const { return tets_; }
  bool contains(TetId t) const { return taken_.at(t) == kIn; }

 private:
  static constexpr std::int32_t kOut = 0, kIn = 1;
  /// Where the mesh is Delaunay, hardly any cavity has more.
  static constexpr std::int32_t kMostVertices = 64;

  bool is_first(TetId t) const;
  void keep_connected();
  void number_vertices(const Cavity& cavity);

  /// What is met for the first time: kBreaksFeature if it stays out.
  template <class Admit>
  Verdict ask(const Vec3& p, FaceLink link, Admit&& admit) {
    const TetId t = link.tet();
    if (!in_sphere(p, mesh_.corners(t))) return Verdict::kBreaksFeature;
    const Verdict v = admit(t, link.face());
    if (v != Verdict::kAccept) return v;
    if (tets_.size() == kMostTets) return Verdict::kTooLarge;
    tets_.push_back(t);
    return v;
  }

  bool is_inner(std::size_t i, int f) const {
    if (inner_is_known_) return inner_[i] >> f & 1;
    const FaceLink link = mesh_.links[tets_[i]][f];
    return link.is_tet() && contains(link.tet());
  }

  template <class IsOpen>
  bool sees(const Vec3& p, std::size_t i, double least_quality, IsOpen&& is_open, Cavity& cavity) {
    const TetId t = tets_[i];
    const auto& k = mesh_.tets[t];
    unsigned on_hull = 0;
    for (int f = 0; f < 4; ++f) {
      if (is_inner(i, f)) continue;
      const FaceLink link = mesh_.links[t][f];
      if (link.is_triangle() && is_open(link.triangle())) continue;
      const int* fv = kFaceVertices[f];
      const VertexId a = k[fv[0]], b = k[fv[2]], c = k[fv[1]];
      const double q = tet_quality(mesh_.points[a], mesh_.points[b], mesh_.points[c], p);
      if (q < least_quality) return false;
      on_hull |= 15u & ~(1u << f);
      bases_.push_back(FaceLink::to_tet(t, f));
      cavity.tets.push_back({{a, b, c, kNone}, mesh_.tet_refs[t], float(q)});
    }
    for (int j = 0; j < 4; ++j)
      if (!(on_hull >> j & 1)) hidden_.push_back(k[j]);
    return true;
  }

  const TetMesh& mesh_;
  std::vector<TetId> first_, tets_, connected_;
  std::vector<std::uint8_t> inner_;  ///< a bit for each face of tets_: whether it has both sides
  bool inner_is_known_ = false;      ///< until one is left out
  std::vector<FaceLink> bases_;      ///< faces on which the new tets stand
  std::vector<VertexId> hidden_;     ///< on no new tet of the tet that has them
  IdMap taken_;                      ///< kIn, or kOut if it was left out
  IdMap marked_;  ///< vertices of the new tets, numbered; tets that are connected
  std::int32_t vertices_ = 0;
  std::vector<std::array<std::int32_t, 3>> corners_;  ///< numbers of each new tet's vertices
  std::vector<FaceLink> beside_;  ///< new tet and its face at an edge, by the numbers of its ends
};

}  // namespace cavea
