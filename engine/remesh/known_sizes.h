#pragma once
#include <vector>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// What a surface wants at the anchors of a mesh's vertices, kept while these stay: from round to
/// round most do, and to look for what is opposite takes long.
class KnownSizes {
 public:
  /// To be called before vertices are asked for.
  void make_room(std::size_t vertices) { known_.resize(vertices); }
  void forget() { known_.clear(); }

  /// The size of a vertex; size_at(anchor) is a function of the anchor alone. Different vertices
  /// may be asked for at once.
  template <class F>
  double operator()(VertexId v, const Anchor& anchor, F&& size_at) {
    Known& k = known_[std::size_t(v)];
    if (k.size < 0 || !is_same(k.at, anchor)) k = {anchor, size_at(anchor)};
    return k.size;
  }

 private:
  struct Known {
    Anchor at;
    double size = -1;  ///< none yet
  };
  static bool is_same(const Anchor& a, const Anchor& b) {
    return a.facet == b.facet && a.u == b.u && a.v == b.v;
  }

  std::vector<Known> known_;
};

}  // namespace cavea
