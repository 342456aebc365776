#include <fmt/format.h>

#include <bit>
#include <functional>
#include <limits>

#include "cavea/base/atomic.h"
#include "cavea/base/collect.h"
#include "cavea/base/error.h"
#include "cavea/base/prefetch.h"
#include "cavea/base/scatter.h"
#include "cavea/geometry/tet_block.h"
#include "cavea/mesh/build.h"
#include "cavea/mesh/faces.h"

namespace cavea {
namespace {

/// Where a vertex is in its tet, without a branch, which would mostly be guessed wrong.
int position_in(const std::array<VertexId, 4>& tet, VertexId v) {
  return int(tet[1] == v) + 2 * int(tet[2] == v) + 3 * int(tet[3] == v);
}

/// A face of a bucket, of which the bucket's vertex is the lowest.
struct BucketFace {
  std::uint64_t key;  ///< the second and third vertex
  std::int32_t code;
  bool odd;

  /// Face f of tet t, whose lowest vertex is `at` in the tet.
  BucketFace(const std::array<VertexId, 4>& tet, int at, int f, TetId t) : code(4 * t + f) {
    const auto [second, third] = kOthers[std::size_t(at)][std::size_t(f)];
    const VertexId a = tet[second], b = tet[third];
    key = std::uint64_t(std::min(a, b)) << 32 | std::uint64_t(std::max(a, b));
    odd = b < a;
  }

 private:
  /// By a vertex and a face at it, the other vertices of the face in its order.
  static constexpr auto kOthers = [] {
    std::array<std::array<std::array<std::uint8_t, 2>, 4>, 4> others{};
    for (std::size_t f = 0; f < 4; ++f)
      for (std::size_t i = 0; i < 3; ++i)
        others[std::size_t(kFaceVertices[f][i])][f] = {std::uint8_t(kFaceVertices[f][(i + 1) % 3]),
                                                       std::uint8_t(kFaceVertices[f][(i + 2) % 3])};
    return others;
  }();
};

struct LinkFault {
  std::array<TetId, 3> tets{kNone, kNone, kNone};  ///< three on a face, or two on its same side

  bool found() const { return tets[0] != kNone; }
  [[noreturn]] void raise() const {
    if (tets[2] != kNone)
      throw InputError(
          fmt::format("tets {}, {} and {} share one face", tets[0] + 1, tets[1] + 1, tets[2] + 1));
    throw InputError(fmt::format("tets {} and {} lie on the same side of their common face",
                                 tets[0] + 1, tets[1] + 1));
  }
};

/// The tets by the lowest vertices of their faces: three faces have that of the tet, the fourth has
/// the second lowest. Twice the tet for those three, one more for the fourth.
Buckets tets_by_faces(const TetMesh& mesh) {
  return Buckets(mesh.tets.size(), mesh.points.size(), [&](std::size_t t, auto&& put) {
    const auto& v = mesh.tets[t];
    if (v[0] == kNone) return;
    const auto [low, high] = std::minmax(v[0], v[1]);
    const auto [other_low, other_high] = std::minmax(v[2], v[3]);
    const bool first = low < other_low;
    put(first ? low : other_low, static_cast<std::uint32_t>(2 * t));
    put(first ? std::min(high, other_low) : std::min(low, other_high),
        static_cast<std::uint32_t>(2 * t + 1));
  });
}

/// Calls f for each face of a bucket.
template <class F>
void for_each_face(const TetMesh& mesh, VertexId lowest, std::span<const std::uint32_t> bucket,
                   F&& f) {
  for (const std::uint32_t value : bucket) {
    const TetId t = TetId(value >> 1);
    const auto& v = mesh.tets[t];
    if (value & 1) {
      const int first = int(std::ranges::min_element(v) - v.begin());
      f(BucketFace(v, position_in(v, lowest), first, t));
      continue;
    }
    const int at = position_in(v, lowest);
    for (int k = 1; k < 4; ++k) f(BucketFace(v, at, (at + k) & 3, t));
  }
}

void link(TetMesh& mesh, FaceLink p, FaceLink q) {
  mesh.links[p.tet()][p.face()] = q;
  mesh.links[q.tet()][q.face()] = p;
}

/// Links the faces of a bucket two by two; what is wrong first by vertices, if anything is.
LinkFault link_sorted(TetMesh& mesh, VertexId lowest, std::span<const std::uint32_t> bucket) {
  std::vector<BucketFace> faces;
  for_each_face(mesh, lowest, bucket, [&](const BucketFace& face) { faces.push_back(face); });
  std::sort(faces.begin(), faces.end(), [](const BucketFace& a, const BucketFace& b) {
    return a.key != b.key ? a.key < b.key : a.code < b.code;
  });
  for (std::size_t i = 0; i + 1 < faces.size(); ++i) {
    const BucketFace &a = faces[i], &b = faces[i + 1];
    if (a.key != b.key) continue;
    const FaceLink p = FaceLink::from_code(a.code), q = FaceLink::from_code(b.code);
    if (i + 2 < faces.size() && faces[i + 2].key == a.key)
      return {{p.tet(), q.tet(), faces[i + 2].code >> 2}};
    // A flat tet has no side; build() orients it by its neighbours.
    if (a.odd == b.odd && !is_flat(mesh, p.tet()) && !is_flat(mesh, q.tet()))
      return {{p.tet(), q.tet(), kNone}};
    link(mesh, p, q);
    ++i;
  }
  return {};
}

/// Links the faces of a small bucket where nothing is out of the ordinary: each is looked for in a
/// table of those before it, which is sooner than sorting them. Whether it is there cannot be
/// guessed, so nothing branches on that.
/// \return whether all was ordinary; if not, some may be linked all the same
bool link_few(TetMesh& mesh, VertexId lowest, std::span<const std::uint32_t> bucket) {
  // A vertex is the lowest of 22 faces on the average, but the first ones are of all faces at them.
  constexpr std::size_t kMost = 128;
  constexpr std::uint64_t kEmpty = ~std::uint64_t{0};  // no vertex is so high
  const std::size_t most = 3 * bucket.size();
  if (most > kMost) return false;
  if (most == 0) return true;
  // Half of the faces are the second of their kind: a quarter of the slots are taken at the end.
  std::array<std::uint64_t, 2 * kMost> keys;
  std::array<std::int32_t, 2 * kMost> first;
  std::array<std::uint8_t, 2 * kMost> seen;  // a bit for each direction
  const std::size_t slots = std::bit_ceil(2 * most);
  std::fill_n(keys.begin(), slots, kEmpty);
  std::fill_n(first.begin(), slots, 0);
  std::fill_n(seen.begin(), slots, std::uint8_t{0});
  const int unused_bits = std::countl_zero(slots - 1);
  std::array<std::array<std::int32_t, 2>, kMost> pairs;
  std::size_t paired = 0;
  unsigned twice = 0;
  for_each_face(mesh, lowest, bucket, [&](const BucketFace& face) {
    std::size_t k = face.key * kScatterStart >> unused_bits;
    while (keys[k] != face.key && keys[k] != kEmpty) k = (k + 1) & (slots - 1);
    const bool found = keys[k] != kEmpty;
    const auto direction = std::uint8_t(1u << unsigned(face.odd));
    twice |= seen[k] & direction;
    seen[k] |= direction;
    keys[k] = face.key;
    pairs[paired] = {first[k], face.code};
    paired += found;
    first[k] = face.code;
  });
  for (std::size_t i = 0; i < paired; ++i)
    link(mesh, FaceLink::from_code(pairs[i][0]), FaceLink::from_code(pairs[i][1]));
  return twice == 0;
}

/// The tets of a bucket are all over the mesh: each is asked for while those before it are linked.
void fetch_ahead(const TetMesh& mesh, const Buckets& buckets, std::size_t key) {
  constexpr std::size_t kAhead = 2;
  if (key + kAhead >= buckets.keys()) return;
  for (const std::uint32_t value : buckets.of(key + kAhead)) {
    prefetch(&mesh.tets[value >> 1]);
    prefetch(&mesh.links[value >> 1]);
  }
}

LinkFault link_all(TetMesh& mesh) {
  const Buckets buckets = tets_by_faces(mesh);
  return parallel_reduce(
      buckets.keys(), LinkFault{},
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
          fetch_ahead(mesh, buckets, v);
          if (link_few(mesh, VertexId(v), buckets.of(v))) continue;
          const LinkFault fault = link_sorted(mesh, VertexId(v), buckets.of(v));
          if (fault.found()) return fault;
        }
        return LinkFault{};
      },
      [](const LinkFault& a, const LinkFault& b) { return a.found() ? a : b; });
}

/// The smallest tet of each vertex.
void set_vertex_tets(TetMesh& mesh) {
  constexpr TetId kNoneYet = std::numeric_limits<TetId>::max();
  const std::size_t n = mesh.points.size();
  mesh.vertex_tets.assign(n, kNoneYet);
  parallel_for(mesh.tets.size(), [&](std::size_t t) {
    if (!mesh.tet_alive(TetId(t))) return;
    for (const VertexId v : mesh.tets[t]) atomic_min(mesh.vertex_tets[v], TetId(t));
  });
  parallel_for(n, [&](std::size_t v) {
    if (mesh.vertex_tets[v] == kNoneYet) mesh.vertex_tets[v] = kNone;
  });
}

void set_qualities(TetMesh& mesh) {
  parallel_ranges(mesh.tets.size(), kReduceBlock, [&](std::size_t begin, std::size_t end) {
    TetBlock block;
    for (std::size_t from = begin; from < end; from += TetBlock::kMost) {
      const std::size_t to = std::min(end, from + TetBlock::kMost);
      block.clear();
      for (std::size_t t = from; t < to; ++t)
        block.add(mesh.tet_alive(TetId(t)) ? mesh.corners(TetId(t)) : std::array<Vec3, 4>{});
      const TetBlock::Row& qualities = block.qualities();
      for (std::size_t t = from; t < to; ++t)
        if (mesh.tet_alive(TetId(t))) mesh.qualities[t] = float(qualities[t - from]);
    }
  });
}

struct AttachFault {
  TriangleId triangle = kNone;
  std::size_t faces = 0;
};

/// Makes v counter-clockwise from outside of sides[0].
void orient(const TetMesh& mesh, Triangle& s) {
  const FaceLink side = s.sides[0];
  if (is_odd(s.v) == is_odd(face_vertices(mesh.tets[side.tet()], side.face()))) return;
  std::swap(s.v[1], s.v[2]);
  std::swap(s.edge_tag[1], s.edge_tag[2]);
  std::swap(s.edge_ref[1], s.edge_ref[2]);
}

/// Finds the sides of a triangle. \returns how many faces it covers, if that cannot be.
std::size_t find_sides(const TetMesh& mesh, const SurfaceFaces& faces, Triangle& s) {
  const auto [begin, end] = faces.find(mesh, s.v);
  if (end - begin == 0 || end - begin > 2) return end - begin;
  s.sides = {faces[begin], FaceLink{}};
  if (end - begin == 2) {
    s.sides[1] = faces[begin + 1];
    const std::int32_t r0 = mesh.tet_refs[s.sides[0].tet()], r1 = mesh.tet_refs[s.sides[1].tet()];
    if ((r0 == r1) != bool(s.tags & tag::kInternal)) return 2;
    if (r1 < r0) std::swap(s.sides[0], s.sides[1]);
  }
  orient(mesh, s);
  return 1;
}

AttachFault find_all_sides(TetMesh& mesh, const SurfaceFaces& faces) {
  return parallel_reduce(
      mesh.triangles.size(), AttachFault{},
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          if (!mesh.triangles[i].alive()) continue;
          const std::size_t found = find_sides(mesh, faces, mesh.triangles[i]);
          if (found != 1) return AttachFault{TriangleId(i), found};
        }
        return AttachFault{};
      },
      [](const AttachFault& a, const AttachFault& b) { return a.triangle != kNone ? a : b; });
}

/// Points the covered faces to their triangles. \returns the number of faces covered twice.
std::int64_t link_triangles(TetMesh& mesh) {
  return parallel_reduce(
      mesh.triangles.size(), std::int64_t{0},
      [&](std::size_t begin, std::size_t end) {
        std::int64_t twice = 0;
        for (std::size_t i = begin; i < end; ++i) {
          if (!mesh.triangles[i].alive()) continue;
          for (const FaceLink side : mesh.triangles[i].sides) {
            if (!side.is_tet()) continue;
            std::atomic_ref link(mesh.links[side.tet()][side.face()]);
            twice += link.exchange(FaceLink::to_triangle(TriangleId(i))).is_triangle();
          }
        }
        return twice;
      },
      std::plus<std::int64_t>{});
}

}  // namespace

void link_faces(TetMesh& mesh) {
  parallel_for(mesh.tets.size(), [&](std::size_t t) { mesh.links[t] = {}; });
  if (const LinkFault fault = link_all(mesh); fault.found()) fault.raise();
  set_vertex_tets(mesh);
  set_qualities(mesh);
}

namespace {

/// The codes of the faces of a choice, ascending. Mostly they are few of all, which are asked once.
std::vector<std::uint32_t> chosen_faces(const TetMesh& mesh, FaceChoice choice) {
  // Most meshes have one reference: then nobody need look up that of each neighbour.
  const bool one_reference =
      std::ranges::adjacent_find(mesh.tet_refs, std::not_equal_to{}) == mesh.tet_refs.end();
  const auto is_chosen = [&](TetId t, int f) {
    if (choice == FaceChoice::kAll) return true;
    return one_reference ? mesh.links[t][f].is_unset() : is_surface_face(mesh, t, f);
  };
  return collect_in_order<std::uint32_t>(mesh.tets.size(), [&](std::size_t t, auto& codes) {
    if (!mesh.tet_alive(TetId(t))) return;
    for (int f = 0; f < 4; ++f)
      if (is_chosen(TetId(t), f)) codes.push_back(std::uint32_t(4 * t) + unsigned(f));
  });
}

/// The faces of a choice by their smallest vertices.
Buckets faces_by_vertices(const TetMesh& mesh, FaceChoice choice) {
  const std::vector<std::uint32_t> codes = chosen_faces(mesh, choice);
  return Buckets(codes.size(), mesh.points.size(), [&](std::size_t i, auto&& put) {
    const std::uint32_t code = codes[i];
    put(sorted(face_vertices(mesh.tets[code >> 2], int(code & 3)))[0], code);
  });
}

}  // namespace

SurfaceFaces::SurfaceFaces(const TetMesh& mesh, FaceChoice choice)
    : faces_(faces_by_vertices(mesh, choice)) {
  parallel_for(faces_.keys(), [&](std::size_t v) {
    const auto codes = faces_.of(v);
    std::sort(codes.begin(), codes.end(), [&](std::uint32_t a, std::uint32_t b) {
      const auto ka = sorted(face_vertices(mesh.tets[a >> 2], static_cast<int>(a & 3)));
      const auto kb = sorted(face_vertices(mesh.tets[b >> 2], static_cast<int>(b & 3)));
      return ka != kb ? ka < kb : a < b;
    });
  });
}

SurfaceFaces::Slots SurfaceFaces::find(const TetMesh& mesh,
                                       std::array<VertexId, 3> vertices) const {
  const auto wanted = sorted(vertices);
  const std::size_t end = faces_.end_of(wanted[0]);
  std::size_t low = faces_.begin_of(wanted[0]), high = end;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (key(mesh, middle) < wanted)
      low = middle + 1;
    else
      high = middle;
  }
  while (high < end && key(mesh, high) == wanted) ++high;
  return {low, high};
}

void attach_triangles(TetMesh& mesh, const SurfaceFaces& faces) {
  if (const AttachFault fault = find_all_sides(mesh, faces); fault.triangle != kNone)
    throw InternalError(
        fmt::format("triangle {} covers {} faces of the surface", fault.triangle, fault.faces));
  if (const std::int64_t twice = link_triangles(mesh); twice != 0)
    throw InternalError(fmt::format("{} faces are covered by two triangles", twice));
}

void attach_triangles(TetMesh& mesh) {
  const bool internal = std::ranges::any_of(
      mesh.triangles, [](const Triangle& s) { return (s.tags & tag::kInternal) != 0; });
  attach_triangles(mesh, SurfaceFaces(mesh, internal ? FaceChoice::kAll : FaceChoice::kSurface));
}

}  // namespace cavea
