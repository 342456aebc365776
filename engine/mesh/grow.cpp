#include "cavea/mesh/grow.h"

#include <functional>
#include <vector>

#include "cavea/base/parallel.h"

namespace cavea {

void grow(TetMesh& mesh, std::size_t tets, std::size_t vertices, std::size_t spare_share) {
  std::vector<std::function<void()>> tasks;
  const auto add = [&]<class T>(std::vector<T>& all, std::size_t n, const T& hole) {
    tasks.push_back([=, &all] {
      if (n > all.capacity()) all.reserve(n + n / spare_share);
      all.resize(n, hole);
    });
  };
  // The largest first.
  add(mesh.tets, tets, {kNone, kNone, kNone, kNone});
  add(mesh.links, tets, {});
  add(mesh.points, vertices, {});
  add(mesh.qualities, tets, {});
  add(mesh.tet_refs, tets, {});
  add(mesh.anchors, vertices, {});
  add(mesh.tet_flags, tets, {});
  add(mesh.sizes, vertices, {});
  add(mesh.vertex_refs, vertices, {});
  add(mesh.vertex_tets, vertices, kNone);
  add(mesh.vertex_tags, vertices, {});
  parallel_tasks(tasks.size(), [&](std::size_t i) { tasks[i](); });
}

}  // namespace cavea
