#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

#include "cavea/base/ids.h"
#include "cavea/base/parallel.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Whether an array that keeps so many items holds much more memory than they need.
template <class T>
bool leaves_much_unused(const std::vector<T>& all, std::size_t kept) {
  constexpr std::size_t kSpareShare = 4;
  return all.capacity() > kept + kept / kSpareShare;
}

/// New numbers of the items that are kept, in their order.
struct Renumbering {
  std::vector<std::int32_t> new_id;  ///< kNone for an item that is not kept
  std::size_t count = 0;             ///< of the kept ones

  /// keep(i) is asked once for each i in [0, n); n fits in 31 bits.
  template <class Keep>
  Renumbering(std::size_t n, Keep&& keep) : new_id(n) {
    std::vector<char> kept(n);
    parallel_for(n, [&](std::size_t i) {
      kept[i] = keep(i);
      new_id[i] = kept[i];
    });
    count = std::size_t(exclusive_scan(new_id));
    parallel_for(n, [&](std::size_t i) {
      if (!kept[i]) new_id[i] = kNone;
    });
  }

  std::int32_t operator[](std::int32_t old_id) const { return new_id[old_id]; }

  /// The kept ones of an array of the items.
  template <class T>
  std::vector<T> kept_of(const std::vector<T>& all) const {
    std::vector<T> out(count);
    parallel_for(all.size(), [&](std::size_t i) {
      if (new_id[i] != kNone) out[new_id[i]] = all[i];
    });
    return out;
  }

  /// Drops what is not kept. In place, as new memory is slow to touch, unless much would be left
  /// unused: then that is given back.
  template <class T>
  void keep_in(std::vector<T>& all) const {
    if (count == all.size()) return;
    if (leaves_much_unused(all, count)) {
      all = kept_of(all);
      return;
    }
    // Each block closes its own holes, then the blocks move together.
    const std::size_t n = all.size(), blocks = (n + kReduceBlock - 1) / kReduceBlock;
    std::vector<std::size_t> left(blocks);
    parallel_for(
        blocks,
        [&](std::size_t b) {
          std::size_t to = b * kReduceBlock;
          for (std::size_t i = to; i < std::min(n, (b + 1) * kReduceBlock); ++i)
            if (new_id[i] != kNone) all[to++] = all[i];
          left[b] = to - b * kReduceBlock;
        },
        1);
    std::size_t to = 0;
    for (std::size_t b = 0; b < blocks; to += left[b++]) {
      const auto from = all.begin() + std::ptrdiff_t(b * kReduceBlock);
      if (to != b * kReduceBlock)
        std::copy(from, from + std::ptrdiff_t(left[b]), all.begin() + std::ptrdiff_t(to));
    }
    all.resize(count);
  }
};

/// Of the living vertices, tets, or triangles of a mesh.
inline Renumbering living_vertices(const TetMesh& mesh) {
  return {mesh.points.size(), [&](std::size_t v) { return mesh.vertex_alive(VertexId(v)); }};
}
inline Renumbering living_tets(const TetMesh& mesh) {
  return {mesh.tets.size(), [&](std::size_t t) { return mesh.tet_alive(TetId(t)); }};
}
inline Renumbering living_triangles(const TetMesh& mesh) {
  return {mesh.triangles.size(), [&](std::size_t i) { return mesh.triangles[i].alive(); }};
}

/// Moves what a mesh keeps to its new numbers, and tells all that name it. Ids has the new number
/// of an old one, kNone for what goes, and keep_in(array). Numbers of cuts stay as they are.
template <class Ids>
void renumber(TetMesh& mesh, const Ids& vertices, const Ids& tets, const Ids& triangles) {
  vertices.keep_in(mesh.points);
  vertices.keep_in(mesh.sizes);
  vertices.keep_in(mesh.vertex_tags);
  vertices.keep_in(mesh.vertex_refs);
  vertices.keep_in(mesh.vertex_tets);
  vertices.keep_in(mesh.anchors);
  tets.keep_in(mesh.tets);
  tets.keep_in(mesh.links);
  tets.keep_in(mesh.qualities);
  tets.keep_in(mesh.tet_refs);
  tets.keep_in(mesh.tet_flags);
  triangles.keep_in(mesh.triangles);
  for (GivenNormal& given : mesh.normals) given.vertex = vertices[given.vertex];
  std::erase_if(mesh.normals, [](const GivenNormal& given) { return given.vertex == kNone; });
  const auto renumbered = [&](FaceLink link) {
    if (link.is_tet()) return FaceLink::to_tet(tets[link.tet()], link.face());
    if (link.is_triangle()) return FaceLink::to_triangle(triangles[link.triangle()]);
    return link;
  };
  parallel_for(mesh.points.size(),
               [&](std::size_t v) { mesh.vertex_tets[v] = tets[mesh.vertex_tets[v]]; });
  parallel_for(mesh.tets.size(), [&](std::size_t t) {
    for (VertexId& v : mesh.tets[t]) v = vertices[v];
    for (FaceLink& link : mesh.links[t]) link = renumbered(link);
  });
  parallel_for(mesh.triangles.size(), [&](std::size_t i) {
    Triangle& s = mesh.triangles[i];
    for (VertexId& v : s.v) v = vertices[v];
    for (FaceLink& side : s.sides) side = renumbered(side);
  });
}

}  // namespace cavea
