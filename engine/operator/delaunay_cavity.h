#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "cavea/cavity/cavity.h"
#include "cavea/cavity/verdict.h"

namespace cavea {

/// A set of ids that is cleared in no time, and as small as what is in it: it stays in the L1
/// cache, whatever the mesh.
class IdSet {
 public:
  void clear() {
    used_ = 0;
    if ((epoch_ += 2) != 0) return;
    slots_.assign(slots_.size(), {});
    epoch_ = 2;
  }
  /// False if it was in.
  bool insert(std::int32_t id) {
    Slot& s = slot(id);
    const bool was_in = s.stamp & 1;
    s.stamp = epoch_ | 1;
    return !was_in;
  }
  void erase(std::int32_t id) { slot(id).stamp = epoch_; }
  bool contains(std::int32_t id) const { return slots_[find(id)].stamp == (epoch_ | 1); }

 private:
  static constexpr std::size_t kFirstSize = 128;
  struct Slot {
    std::uint32_t stamp = 0;  ///< the epoch, which is even; and 1 if the id is in
    std::int32_t id = 0;
  };

  bool is_free(const Slot& s) const { return (s.stamp & ~1u) != epoch_; }
  /// Where the id is, or the free slot where it would be.
  std::size_t find(std::int32_t id) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = (std::uint32_t(id) * 0x9E3779B1u) >> 16 & mask;
    while (!is_free(slots_[i]) && slots_[i].id != id) i = (i + 1) & mask;
    return i;
  }
  Slot& slot(std::int32_t id) {
    std::size_t i = find(id);
    if (is_free(slots_[i])) {
      if (2 * ++used_ > slots_.size()) {
        grow();
        i = find(id);
      }
      slots_[i] = {epoch_, id};
    }
    return slots_[i];
  }
  void grow();

  std::vector<Slot> slots_ = std::vector<Slot>(kFirstSize);  ///< open addressing; a power of two
  std::size_t used_ = 0;
  std::uint32_t epoch_ = 2;
};

/// Whether p is inside the circumsphere of a positive tet or about on it: where points of lattices
/// are on common spheres and in common planes, the cavity is then what p sees all of. Whatever this
/// says, the cavity is proven by the qualities of its new tets.
bool in_sphere(const Vec3& p, const std::array<Vec3, 4>& tet);

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
  /// \param admit(tet): kAccept takes it, kBreaksFeature leaves it out, all else ends the search
  /// with that verdict; of the first ones only acceptance will do
  template <class Admit>
  Verdict grow(const Vec3& p, std::span<const TetId> first, Admit&& admit) {
    first_.assign(first.begin(), first.end());
    tets_ = first_;
    taken_.clear();
    marked_.clear();  // what has been asked
    for (const TetId t : tets_) taken_.insert(t), marked_.insert(t);
    for (const TetId t : tets_)
      if (const Verdict v = admit(t); v != Verdict::kAccept) return v;
    for (std::size_t i = 0; i < tets_.size(); ++i)
      for (const FaceLink link : mesh_.links[tets_[i]]) {
        if (!link.is_tet() || !marked_.insert(link.tet())) continue;
        const TetId t = link.tet();
        if (!in_sphere(p, mesh_.corners(t))) continue;
        const Verdict v = admit(t);
        if (v == Verdict::kBreaksFeature) continue;
        if (v != Verdict::kAccept) return v;
        if (tets_.size() == kMostTets) return Verdict::kTooLarge;
        taken_.insert(t);
        tets_.push_back(t);
      }
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
    for (const TetId t : tets_) {
      if (sees(p, t, least_quality, is_open, cavity)) continue;
      if (is_first(t)) return false;
      taken_.erase(t);
      all = false;
    }
    if (!all) keep_connected();
    return true;
  }

  /// Whether a vertex of the cavity would have no tets any more. \pre the new tets are in `cavity`
  bool encloses_vertex(const Cavity& cavity);

  const std::vector<TetId>& tets() const { return tets_; }
  bool contains(TetId t) { return taken_.contains(t); }

 private:
  bool is_first(TetId t) const;
  void keep_connected();

  template <class IsOpen>
  bool sees(const Vec3& p, TetId t, double least_quality, IsOpen&& is_open, Cavity& cavity) {
    const auto& k = mesh_.tets[t];
    for (int f = 0; f < 4; ++f) {
      const FaceLink link = mesh_.links[t][f];
      if (link.is_tet() && taken_.contains(link.tet())) continue;
      if (link.is_triangle() && is_open(link.triangle())) continue;
      const int* fv = kFaceVertices[f];
      const VertexId a = k[fv[0]], b = k[fv[2]], c = k[fv[1]];
      const double q = tet_quality(mesh_.points[a], mesh_.points[b], mesh_.points[c], p);
      if (q < least_quality) return false;
      cavity.tets.push_back({{a, b, c, kNone}, mesh_.tet_refs[t], float(q)});
    }
    return true;
  }

  const TetMesh& mesh_;
  std::vector<TetId> first_, tets_, connected_;
  IdSet taken_, marked_;
};

}  // namespace cavea
