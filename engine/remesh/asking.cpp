#include "cavea/remesh/asking.h"

#include <algorithm>

#include "cavea/base/parallel.h"

namespace cavea {
namespace {

template <class Ask>
void ask_lengths_where(TetMesh& m, Ask&& ask) {
  parallel_for(m.tets.size(), [&](std::size_t t) {
    if (m.tet_alive(TetId(t)) && std::ranges::any_of(m.tets[t], ask))
      m.tet_flags[t] |= tet_flag::kAskLength;
  });
}

}  // namespace

void ask_all(TetMesh& mesh, std::uint8_t what) {
  for (std::uint8_t& flags : mesh.tet_flags) flags |= what;
}

void ask_below(TetMesh& mesh, double quality) {
  parallel_for(mesh.tets.size(), [&](std::size_t t) {
    if (mesh.qualities[t] < quality) mesh.tet_flags[t] |= tet_flag::kAskAll;
  });
}

void ask_nothing(TetMesh& mesh) {
  parallel_for(mesh.tets.size(), [&](std::size_t t) { mesh.tet_flags[t] &= tet_flag::kRequired; });
}

bool is_nothing_asked(const TetMesh& mesh) {
  return std::ranges::none_of(mesh.tet_flags,
                              [](std::uint8_t flags) { return flags & tet_flag::kAskAll; });
}

void ask_lengths(TetMesh& mesh) {
  ask_lengths_where(mesh, [](VertexId) { return true; });
}

void ask_changed_lengths(TetMesh& mesh, const std::vector<float>& sizes_before) {
  ask_lengths_where(mesh, [&](VertexId v) { return mesh.sizes[v] != sizes_before[v]; });
}

}  // namespace cavea
