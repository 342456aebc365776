#include "cavea/mesh/copy.h"

#include <tuple>
#include <utility>

#include "cavea/base/parallel.h"

namespace cavea {
namespace {

/// The arrays of a structure, the largest first; of a const mesh or not.
auto structure(auto& m) {
  return std::tie(m.links, m.tets, m.points, m.qualities, m.tet_refs, m.vertex_refs, m.vertex_tets);
}

auto labels(auto& m) {
  return std::tie(m.triangles, m.anchors, m.tet_flags, m.sizes, m.vertex_tags, m.normals);
}

/// Copies the arrays of one tuple to those of another, a task each.
template <class From, class To>
void copy_all(const From& from, const To& to) {
  constexpr std::size_t n = std::tuple_size_v<From>;
  parallel_tasks(n, [&](std::size_t task) {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      ((I == task ? void(std::get<I>(to) = std::get<I>(from)) : void()), ...);
    }
    (std::make_index_sequence<n>());
  });
}

}  // namespace

TetMesh copy_of(const TetMesh& mesh) {
  TetMesh copy;
  copy_all(std::tuple_cat(structure(mesh), labels(mesh)),
           std::tuple_cat(structure(copy), labels(copy)));
  return copy;
}

void copy_structure(const TetMesh& from, TetMesh& to) { copy_all(structure(from), structure(to)); }

void move_structure(TetMesh& from, TetMesh& to) {
  // A tuple of references moves by copying what they refer to.
  std::apply(
      [&](auto&... target) {
        std::apply([&](auto&... source) { ((target = std::move(source)), ...); }, structure(from));
      },
      structure(to));
}

void copy_labels(const TetMesh& from, TetMesh& to) { copy_all(labels(from), labels(to)); }

}  // namespace cavea
