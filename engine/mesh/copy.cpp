#include "cavea/mesh/copy.h"

#include <functional>
#include <iterator>

#include "cavea/base/parallel.h"

namespace cavea {

TetMesh copy_of(const TetMesh& mesh) {
  TetMesh copy;
  // The largest first.
  const std::function<void()> tasks[] = {
      [&] { copy.links = mesh.links; },
      [&] { copy.tets = mesh.tets; },
      [&] { copy.triangles = mesh.triangles; },
      [&] { copy.points = mesh.points; },
      [&] { copy.qualities = mesh.qualities; },
      [&] { copy.tet_refs = mesh.tet_refs; },
      [&] { copy.anchors = mesh.anchors; },
      [&] { copy.tet_flags = mesh.tet_flags; },
      [&] { copy.sizes = mesh.sizes; },
      [&] { copy.vertex_refs = mesh.vertex_refs; },
      [&] { copy.vertex_tets = mesh.vertex_tets; },
      [&] { copy.vertex_tags = mesh.vertex_tags; },
      [&] { copy.normals = mesh.normals; },
  };
  parallel_tasks(std::size(tasks), [&](std::size_t k) { tasks[k](); });
  return copy;
}

}  // namespace cavea
