#include "cavea/mesh/orient_flat.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "cavea/base/error.h"
#include "cavea/mesh/faces.h"

namespace cavea {
namespace {

bool agrees(const TetMesh& mesh, TetId t, int f) {
  const FaceLink behind = mesh.links[t][f];
  return is_odd(face_vertices(mesh.tets[t], f)) !=
         is_odd(face_vertices(mesh.tets[behind.tet()], behind.face()));
}

void turn_over(TetMesh& mesh, TetId t) {
  std::swap(mesh.tets[t][2], mesh.tets[t][3]);
  std::swap(mesh.links[t][2], mesh.links[t][3]);
  for (const int f : {2, 3}) {
    const FaceLink behind = mesh.links[t][f];
    if (behind.is_tet()) mesh.links[behind.tet()][behind.face()] = FaceLink::to_tet(t, f);
  }
}

/// The flat tets, breadth first from those that have a neighbour with volume. Serial: they are few.
class FlatTets {
 public:
  explicit FlatTets(TetMesh& mesh) : mesh_(mesh) {
    for (TetId t = 0; t < TetId(mesh.tets.size()); ++t)
      if (is_flat(mesh, t)) all_.push_back(t);
    settled_.resize(all_.size(), 0);
  }

  void orient() {
    for (const TetId t : all_)
      if (settled_face(t) != 4) settle(t);
    spread();
    for (const TetId t : all_) {  // a component of nothing but flat tets starts anywhere
      settle(t);
      spread();
    }
  }

  void verify() const {
    for (const TetId t : all_)
      for (int f = 0; f < 4; ++f)
        if (mesh_.links[t][f].is_tet() && !agrees(mesh_, t, f))
          throw InputError(fmt::format("tets {} and {} lie on the same side of their common face",
                                       std::min(t, mesh_.links[t][f].tet()) + 1,
                                       std::max(t, mesh_.links[t][f].tet()) + 1));
  }

 private:
  bool is_settled(TetId t) const {
    const auto at = std::lower_bound(all_.begin(), all_.end(), t);
    return at == all_.end() || *at != t || settled_[at - all_.begin()];
  }
  /// The first face of t with a settled tet behind it, or 4.
  int settled_face(TetId t) const {
    int f = 0;
    while (f < 4 && !(mesh_.links[t][f].is_tet() && is_settled(mesh_.links[t][f].tet()))) ++f;
    return f;
  }
  void settle(TetId t) {
    char& settled = settled_[std::lower_bound(all_.begin(), all_.end(), t) - all_.begin()];
    if (settled) return;
    const int f = settled_face(t);
    if (f != 4 && !agrees(mesh_, t, f)) turn_over(mesh_, t);
    settled = 1;
    queue_.push_back(t);
  }
  void spread() {
    for (; next_ < queue_.size(); ++next_)
      for (int f = 0; f < 4; ++f) {
        const FaceLink behind = mesh_.links[queue_[next_]][f];
        if (behind.is_tet() && !is_settled(behind.tet())) settle(behind.tet());
      }
  }

  TetMesh& mesh_;
  std::vector<TetId> all_;  ///< sorted
  std::vector<char> settled_;
  std::vector<TetId> queue_;
  std::size_t next_ = 0;
};

}  // namespace

void orient_flat_tets(TetMesh& mesh) {
  FlatTets flat(mesh);
  flat.orient();
  flat.verify();
}

}  // namespace cavea
