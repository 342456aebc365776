#include "cavea/part/order.h"

#include <algorithm>
#include <memory>
#include <tuple>
#include <utility>

#include "cavea/base/buckets.h"
#include "cavea/base/ids_where.h"
#include "cavea/base/parallel.h"
#include "cavea/mesh/renumber.h"
#include "cavea/partition/curve.h"

namespace cavea {
namespace {

/// Numbers in another order.
class Order {
 public:
  /// \param kept the old numbers of the items that stay, in their new order
  /// \param n how many items there are
  Order(std::vector<std::int32_t> kept, std::size_t n) : kept_(std::move(kept)), new_id_(n, kNone) {
    parallel_for(kept_.size(), [&](std::size_t i) { new_id_[kept_[i]] = std::int32_t(i); });
  }

  std::int32_t operator[](std::int32_t old_id) const { return new_id_[old_id]; }

  /// In place, as new memory is slow to touch, unless much would be left unused: then that is given
  /// back.
  template <class T>
  void keep_in(std::vector<T>& all) const {
    if (leaves_much_unused(all, kept_.size())) {
      std::vector<T> moved(kept_.size());
      gather(all, moved.data());
      all = std::move(moved);
      return;
    }
    // Unset: all threads touch the new memory as they fill it, in place of one that clears it.
    const auto moved = std::make_unique_for_overwrite<T[]>(kept_.size());
    gather(all, moved.get());
    all.resize(kept_.size());
    parallel_for(kept_.size(), [&](std::size_t i) { all[i] = moved[i]; });
  }

 private:
  template <class T>
  void gather(const std::vector<T>& all, T* to) const {
    parallel_for(kept_.size(), [&](std::size_t i) { to[i] = all[kept_[i]]; });
  }

  std::vector<std::int32_t> kept_, new_id_;
};

Order along_curve(const TetMesh& mesh) {
  struct Key {
    std::uint64_t place;
    VertexId vertex;
    bool operator<(const Key& other) const {
      return std::tie(place, vertex) < std::tie(other.place, other.vertex);
    }
  };
  const std::vector<std::uint64_t> places = curve_keys(mesh.points);
  std::vector<VertexId> kept =
      ids_where(mesh.points.size(), [&](VertexId v) { return mesh.vertex_alive(v); });
  std::vector<Key> keys(kept.size());
  parallel_for(keys.size(), [&](std::size_t i) { keys[i] = {places[kept[i]], kept[i]}; });
  parallel_sort(keys.begin(), keys.end());
  parallel_for(keys.size(), [&](std::size_t i) { kept[i] = keys[i].vertex; });
  return {std::move(kept), mesh.points.size()};
}

/// Of n items by their lowest vertices, then as they were.
/// \param vertices_of those of an item, the first of them kNone where there is no item
template <class VerticesOf>
Order by_lowest(std::size_t n, const TetMesh& mesh, const Order& vertices,
                VerticesOf&& vertices_of) {
  Buckets at(n, mesh.points.size(), [&](std::size_t i, auto&& put) {
    const auto& corners = vertices_of(i);
    if (corners[0] == kNone) return;
    VertexId lowest = vertices[corners[0]];
    for (const VertexId v : corners) lowest = std::min(lowest, vertices[v]);
    put(lowest, std::uint32_t(i));
  });
  std::vector<std::int32_t> kept(at.size());
  parallel_for(at.keys(), [&](std::size_t v) {
    std::ranges::sort(at.of(v));
    std::ranges::copy(at.of(v), kept.begin() + std::ptrdiff_t(at.begin_of(v)));
  });
  return {std::move(kept), n};
}

}  // namespace

void sort_along_curve(TetMesh& mesh, std::vector<std::int32_t>* of_tet) {
  const Order vertices = along_curve(mesh);
  const Order tets = by_lowest(
      mesh.tets.size(), mesh, vertices, [&](std::size_t t) -> const auto& { return mesh.tets[t]; });
  const Order triangles = by_lowest(
      mesh.triangles.size(), mesh,
      vertices, [&](std::size_t i) -> const auto& { return mesh.triangles[i].v; });
  renumber(mesh, vertices, tets, triangles);
  if (of_tet) tets.keep_in(*of_tet);
}

}  // namespace cavea
