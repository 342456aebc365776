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
  /// Where the mesh is Delaunay, cavities have a dozen or two. Where it is filled with needles, the
  /// first cavities take hubs of hundreds, and are what rids it of them: with 512 a third of them
  /// was refused on a CAD part, and what followed took three times as long.
  static constexpr std::size_t kMostTets = 4096;
  /// Flatter tets are hard to repair; where the mesh is Delaunay, hardly any is.
  static constexpr double kLeastQuality = 1e-4;

  explicit DelaunayCavity(const TetMesh& mesh);

  /// \param first tets that the cavity must have
  /// \param admit(tet, k): k is the one vertex that no tet before it had, 4 for the first ones;
  /// kAccept takes it, kBreaksFeature leaves it out, all else ends the search with that verdict; of
  /// the first ones only acceptance will do
  template <class Admit>
  Verdict grow(const Vec3& p, std::span<const TetId> first, Admit&& admit) {
    found_.assign(first.begin(), first.end());
    first_ = found_.size();
    number_.clear();
    for (std::size_t i = 0; i < first_; ++i) number_[found_[i]] = std::int32_t(i);
    for (std::size_t i = 0; i < first_; ++i)
      if (const Verdict v = admit(found_[i], 4); v != Verdict::kAccept) return v;
    behind_.clear();
    for (std::size_t i = 0; i < found_.size(); ++i) {
      std::array<std::int32_t, 4> behind{kOut, kOut, kOut, kOut};
      for (int f = 0; f < 4; ++f) {
        const FaceLink link = mesh_.links[found_[i]][f];
        if (!link.is_tet()) continue;
        std::int32_t& number = number_[link.tet()];
        if (number == IdMap::kNew) {
          const Verdict v = ask(p, link, admit);
          if (v != Verdict::kAccept && v != Verdict::kBreaksFeature) return v;
          number = v == Verdict::kAccept ? std::int32_t(found_.size()) - 1 : kOut;
        }
        behind[std::size_t(f)] = number;
      }
      behind_.push_back(behind);
    }
    forget_qualities();
    restore();
    return Verdict::kAccept;
  }

  /// Back to all that was grown, as if nothing had been left out.
  void restore();

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
    for (const std::int32_t i : order_) {
      if (sees(p, std::size_t(i), least_quality, is_open, cavity)) continue;
      if (std::size_t(i) < first_) return false;
      is_in_[std::size_t(i)] = false;
      all = false;
    }
    if (!all) keep_connected();
    return true;
  }

  /// Whether a vertex of the cavity would have no tets any more, other than those that it removes.
  /// \pre the new tets are in `cavity`
  bool encloses_vertex(const Cavity& cavity);
  /// Tells the cavity what its new tets link to, if its vertices are not too many. \pre no triangle
  /// was open, encloses_vertex() has been asked
  void link(Cavity& cavity);

  const std::vector<TetId>& tets() const { return tets_; }
  bool contains(TetId t) const { return is_in(number_.at(t)); }

 private:
  /// What is not a number of a tet that was found.
  static constexpr std::int32_t kOut = -2;
  static constexpr double kUnknown = 2;  ///< no quality
  /// Where the mesh is Delaunay, hardly any cavity has more.
  static constexpr std::int32_t kMostVertices = 64;

  void forget_qualities();
  void keep_connected();
  void number_vertices(const Cavity& cavity);

  /// What is met for the first time: kBreaksFeature if it stays out.
  template <class Admit>
  Verdict ask(const Vec3& p, FaceLink link, Admit&& admit) {
    const TetId t = link.tet();
    if (!in_sphere(p, mesh_.corners(t))) return Verdict::kBreaksFeature;
    const Verdict v = admit(t, link.face());
    if (v != Verdict::kAccept) return v;
    if (found_.size() >= kMostTets) return Verdict::kTooLarge;
    found_.push_back(t);
    return v;
  }

  bool is_in(std::int32_t number) const { return number >= 0 && is_in_[std::size_t(number)]; }

  template <class IsOpen>
  bool sees(const Vec3& p, std::size_t i, double least_quality, IsOpen&& is_open, Cavity& cavity) {
    const TetId t = found_[i];
    const auto& k = mesh_.tets[t];
    unsigned on_hull = 0;
    for (int f = 0; f < 4; ++f) {
      if (is_in(behind_[i][std::size_t(f)])) continue;
      const FaceLink link = mesh_.links[t][f];
      if (link.is_triangle() && is_open(link.triangle())) continue;
      const int* fv = kFaceVertices[f];
      const VertexId a = k[fv[0]], b = k[fv[2]], c = k[fv[1]];
      double& q = qualities_[i][std::size_t(f)];
      if (q == kUnknown) q = tet_quality(mesh_.points[a], mesh_.points[b], mesh_.points[c], p);
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
  std::vector<TetId> found_;  ///< the first ones before all others
  std::size_t first_ = 0;
  IdMap number_;                                     ///< in found_; kOut if it was not taken
  std::vector<std::array<std::int32_t, 4>> behind_;  ///< numbers behind the faces of what was found
  std::vector<char> is_in_;                          ///< what was found and not left out
  std::vector<std::int32_t> order_, connected_;      ///< the numbers of these
  std::vector<TetId> tets_;                          ///< and these themselves
  /// Of the new tet on each face, once it was asked for: what is left out only adds faces.
  std::vector<std::array<double, 4>> qualities_;
  std::vector<FaceLink> bases_;   ///< faces on which the new tets stand
  std::vector<VertexId> hidden_;  ///< on no new tet of the tet that has them
  IdMap marked_;                  ///< vertices of the new tets, numbered
  std::int32_t vertices_ = 0;
  std::vector<std::array<std::int32_t, 3>> corners_;  ///< numbers of each new tet's vertices
  std::vector<FaceLink> beside_;  ///< new tet and its face at an edge, by the numbers of its ends
};

}  // namespace cavea
