#include "cavea/remesh/asking.h"

#include <algorithm>

#include "cavea/base/parallel.h"

namespace cavea {

void ask_all(TetMesh& mesh, std::uint8_t what) {
  for (std::uint8_t& flags : mesh.tet_flags) flags |= what;
}

void ask_nothing(TetMesh& mesh) {
  parallel_for(mesh.tets.size(), [&](std::size_t t) { mesh.tet_flags[t] &= tet_flag::kRequired; });
}

bool is_nothing_asked(const TetMesh& mesh) {
  return std::ranges::none_of(mesh.tet_flags,
                              [](std::uint8_t flags) { return flags & tet_flag::kAskAll; });
}

void ask_changed_lengths(TetMesh& mesh, const std::vector<float>& sizes_before) {
  const auto has_changed = [&](VertexId v) { return mesh.sizes[v] != sizes_before[v]; };
  parallel_for(mesh.tets.size(), [&](std::size_t t) {
    if (mesh.tet_alive(TetId(t)) && std::ranges::any_of(mesh.tets[t], has_changed))
      mesh.tet_flags[t] |= tet_flag::kAskLength;
  });
}

}  // namespace cavea
