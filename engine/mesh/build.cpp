#include "cavea/mesh/build.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cavea/base/atomic.h"
#include "cavea/base/error.h"
#include "cavea/mesh/faces.h"
#include "cavea/mesh/features.h"
#include "cavea/mesh/internal_sheets.h"
#include "cavea/mesh/orient_flat.h"
#include "cavea/mesh/peel_flat.h"
#include "cavea/mesh/renumber.h"

namespace cavea {
namespace {

// Volumes and qualities are made of cubes of coordinates, which overflow a double beyond 1e102.
constexpr double kLargestCoordinate = 1e100;

/// The first i in [0, n) that is bad, or n.
template <class Bad>
std::size_t first_bad(std::size_t n, Bad&& bad) {
  return parallel_reduce(
      n, n,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          if (bad(i)) return i;
        return n;
      },
      [](std::size_t a, std::size_t b) { return std::min(a, b); });
}

template <std::size_t N>
void check_indices(const std::vector<std::array<std::int32_t, N>>& list, std::size_t limit,
                   const char* entity) {
  const auto bad = [&](std::int32_t v) { return v < 0 || std::size_t(v) >= limit; };
  const std::size_t i = first_bad(
      list.size(), [&](std::size_t k) { return std::any_of(list[k].begin(), list[k].end(), bad); });
  if (i == list.size()) return;
  throw InputError(fmt::format("{} {} has vertex {}; there are {} vertices", entity, i + 1,
                               std::int64_t{*std::find_if(list[i].begin(), list[i].end(), bad)} + 1,
                               limit));
}

void check_indices(const std::vector<std::int32_t>& list, std::size_t limit, const char* entity) {
  for (const std::int32_t i : list)
    if (i < 0 || std::size_t(i) >= limit)
      throw InputError(
          fmt::format("{} {} is listed; there are {}", entity, std::int64_t{i} + 1, limit));
}

void check_count(const std::vector<std::int32_t>& refs, std::size_t n, const char* entity) {
  if (!refs.empty() && refs.size() != n)
    throw InputError(fmt::format("{} references for {} {}", refs.size(), n, entity));
}

void check_normals(const MeshData& data) {
  std::vector<std::int32_t> vertices, normals;
  for (const auto& [v, normal] : data.normal_at_vertices) {
    vertices.push_back(v);
    normals.push_back(normal);
  }
  check_indices(vertices, data.vertices.size(), "vertex with a normal");
  check_indices(normals, data.normals.size(), "normal");
}

void check_lists(const MeshData& data) {
  const std::size_t n = data.vertices.size();
  if (n > std::size_t(std::numeric_limits<VertexId>::max()))
    throw InputError(fmt::format("{} vertices; 32-bit numbers hold at most {}", n,
                                 std::numeric_limits<VertexId>::max()));
  check_indices(data.tets, n, "tet");
  check_indices(data.triangles, n, "triangle");
  check_indices(data.edges, n, "edge");
  check_indices(data.corners, n, "corner vertex");
  check_indices(data.required_vertices, n, "required vertex");
  check_indices(data.ridges, data.edges.size(), "ridge edge");
  check_indices(data.required_edges, data.edges.size(), "required edge");
  check_indices(data.required_triangles, data.triangles.size(), "required triangle");
  check_indices(data.required_tets, data.tets.size(), "required tet");
  check_normals(data);
  check_count(data.vertex_refs, n, "vertices");
  check_count(data.tet_refs, data.tets.size(), "tets");
  check_count(data.triangle_refs, data.triangles.size(), "triangles");
  check_count(data.edge_refs, data.edges.size(), "edges");
}

/// The vertex that a tet has twice, or kNone.
VertexId repeated_vertex(const std::array<std::int32_t, 4>& tet) {
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j)
      if (tet[i] == tet[j]) return tet[i];
  return kNone;
}

/// Sizes are kept as floats.
void check_sizes(const MeshData& data) {
  const std::size_t n = data.sizes.size();
  if (n != 0 && n != data.vertices.size())
    throw InputError(fmt::format("{} sizes for {} vertices", n, data.vertices.size()));
  const std::size_t bad = first_bad(n, [&](std::size_t v) {
    const float size = float(data.sizes[v]);
    return !(size > 0 && std::isfinite(size));
  });
  if (bad < n)
    throw InputError(fmt::format("the size of vertex {} is {}; it must be positive, as a float too",
                                 bad + 1, data.sizes[bad]));
}

void check_tets(const MeshData& data) {
  const std::size_t n = data.tets.size();
  if (n == 0) throw InputError("no tets");
  if (std::int64_t(n) >= kMaxTets)
    throw InputError(fmt::format("{} tets; at most {} are possible", n, kMaxTets - 1));
  const std::size_t bad =
      first_bad(n, [&](std::size_t t) { return repeated_vertex(data.tets[t]) != kNone; });
  if (bad < n)
    throw InputError(
        fmt::format("tet {} has vertex {} twice", bad + 1, repeated_vertex(data.tets[bad]) + 1));
}

void check_coordinates(const MeshData& data) {
  const std::size_t n = data.vertices.size();
  const auto too_large = [](double x) { return !(std::abs(x) <= kLargestCoordinate); };
  const std::size_t bad = first_bad(n, [&](std::size_t v) {
    const Vec3& p = data.vertices[v];
    return too_large(p.x) || too_large(p.y) || too_large(p.z);
  });
  if (bad == n) return;
  const Vec3& p = data.vertices[bad];
  throw InputError(fmt::format("vertex {} has coordinates ({}, {}, {}), {}", bad + 1, p.x, p.y, p.z,
                               is_finite(p) ? "too large" : "not finite"));
}

/// Moves the used vertices. \returns their new numbers, kNone for the unused.
std::vector<VertexId> take_vertices(MeshData& data, TetMesh& mesh) {
  const std::size_t n = data.vertices.size();
  std::vector<char> used(n, 0);
  parallel_for(data.tets.size(), [&](std::size_t t) {
    for (const std::int32_t v : data.tets[t])
      std::atomic_ref(used[v]).store(1, std::memory_order_relaxed);
  });
  Renumbering ids(n, [&](std::size_t v) { return used[v] != 0; });
  const auto take = [&](auto& from, auto& to) {
    if (from.empty()) return;
    ids.keep_in(from);
    to = std::move(from);
  };
  take(data.vertices, mesh.points);
  take(data.vertex_refs, mesh.vertex_refs);
  mesh.resize_vertices(ids.count);
  if (!data.sizes.empty())
    parallel_for(n, [&](std::size_t v) {
      if (ids.new_id[v] != kNone) mesh.sizes[ids.new_id[v]] = float(data.sizes[v]);
    });
  return std::move(ids.new_id);
}

std::vector<std::int32_t> unused_of(const std::vector<VertexId>& new_vertex) {
  std::vector<std::int32_t> unused;
  for (std::size_t v = 0; v < new_vertex.size(); ++v)
    if (new_vertex[v] == kNone) unused.push_back(std::int32_t(v));
  return unused;
}

struct FoundTets {
  std::int64_t turned = 0, flat = 0;
};

/// Gives the tets their new vertices and turns over those of negative volume.
FoundTets turn_tets(const std::vector<VertexId>& new_vertex, TetMesh& mesh) {
  return parallel_reduce(
      mesh.tets.size(), FoundTets{},
      [&](std::size_t begin, std::size_t end) {
        FoundTets here;
        for (std::size_t t = begin; t < end; ++t) {
          auto& tet = mesh.tets[t];
          for (VertexId& v : tet) v = new_vertex[v];
          mesh.tet_flags[t] = tet_flag::kAskAll;
          const auto [a, b, c, d] = mesh.corners(TetId(t));
          const int sign = orientation(a, b, c, d);
          if (sign < 0) std::swap(tet[2], tet[3]);
          here.turned += sign < 0;
          here.flat += sign == 0;
        }
        return here;
      },
      [](FoundTets a, const FoundTets& b) {
        return FoundTets{a.turned + b.turned, a.flat + b.flat};
      });
}

/// Moves the tets, turning over those of negative volume.
void take_tets(MeshData& data, const std::vector<VertexId>& new_vertex, TetMesh& mesh,
               BuildSummary& summary) {
  mesh.tets = std::move(data.tets);
  mesh.tet_refs = std::move(data.tet_refs);
  const std::size_t n = mesh.tets.size();
  FoundTets found;
  // New memory is slow to touch; the links, half of it, are not asked for yet.
  run_together([&] { mesh.links.resize(n); },
               [&] {
                 mesh.qualities.resize(n);
                 mesh.tet_refs.resize(n);
                 mesh.tet_flags.resize(n);
                 found = turn_tets(new_vertex, mesh);
               });
  summary.turned_tets = found.turned;
  summary.flat_tets = found.flat;
}

/// Which listed triangle, the first if several, lies on each slot of the surface's faces.
struct ListedTriangles {
  static constexpr std::uint32_t kUnlisted = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> at_slot;  ///< listed triangle at the first slot of its faces
  std::vector<std::uint32_t> slot_of;  ///< by listed triangle, the first slot of its faces
  std::vector<char> kept;              ///< by listed triangle
};

/// Those on faces inside a reference are kept if they are required, or all are to be.
ListedTriangles find_listed(const MeshData& data, const std::vector<VertexId>& new_vertex,
                            const TetMesh& mesh, const SurfaceFaces& faces, bool keep_internal) {
  const std::size_t n = data.triangles.size();
  ListedTriangles out{std::vector<std::uint32_t>(faces.slots(), ListedTriangles::kUnlisted),
                      std::vector<std::uint32_t>(n, ListedTriangles::kUnlisted),
                      std::vector<char>(n, 0)};
  const auto slots_of = [&](std::size_t i) {
    const auto& v = data.triangles[i];
    const std::array<VertexId, 3> k{new_vertex[v[0]], new_vertex[v[1]], new_vertex[v[2]]};
    if (sorted(k)[0] == kNone) return SurfaceFaces::Slots{0, 0};
    return faces.find(mesh, k);
  };
  parallel_for(n, [&](std::size_t i) {
    const auto [begin, end] = slots_of(i);
    if (begin == end) return;
    out.slot_of[i] = std::uint32_t(begin);
    atomic_min(out.at_slot[begin], std::uint32_t(i));
  });
  std::vector<char> is_required(n, 0);
  for (const std::int32_t i : data.required_triangles) is_required[std::size_t(i)] = 1;
  parallel_for(n, [&](std::size_t i) {
    const std::uint32_t slot = out.slot_of[i];
    if (slot == ListedTriangles::kUnlisted || out.at_slot[slot] != i) return;
    const FaceLink face = faces[slot];
    out.kept[i] = keep_internal || is_required[i] || is_surface_face(mesh, face.tet(), face.face());
  });
  return out;
}

/// Copies the listed triangles that are kept, in their order.
void take_triangles(const MeshData& data, const std::vector<VertexId>& new_vertex,
                    const SurfaceFaces& faces, const ListedTriangles& listed, TetMesh& mesh,
                    BuildSummary& summary) {
  const std::size_t n = data.triangles.size();
  const Renumbering ids(n, [&](std::size_t i) { return listed.kept[i] != 0; });
  mesh.triangles.resize(ids.count);
  parallel_for(n, [&](std::size_t i) {
    if (ids.new_id[i] == kNone) return;
    Triangle& s = mesh.triangles[ids.new_id[i]];
    for (int k = 0; k < 3; ++k) s.v[k] = new_vertex[data.triangles[i][k]];
    if (!data.triangle_refs.empty()) s.ref = data.triangle_refs[i];
    const FaceLink face = faces[listed.slot_of[i]];
    if (!is_surface_face(mesh, face.tet(), face.face())) s.tags = tag::kInternal;
  });
  for (const std::int32_t i : data.required_triangles)
    if (ids.new_id[i] != kNone) mesh.triangles[ids.new_id[i]].tags |= tag::kRequired;
  summary.dropped_triangles = std::int64_t(n - ids.count);
}

/// Appends a triangle on each face of the surface that none is listed on, by vertex numbers.
void make_triangles(const SurfaceFaces& faces, const ListedTriangles& listed, TetMesh& mesh,
                    BuildSummary& summary) {
  const std::size_t n = mesh.points.size();
  const auto for_each_unlisted = [&](std::size_t v, auto&& f) {
    faces.for_each(mesh, VertexId(v), [&](SurfaceFaces::Slots slots) {
      const FaceLink face = faces[slots.first];
      if (listed.at_slot[slots.first] == ListedTriangles::kUnlisted &&
          is_surface_face(mesh, face.tet(), face.face()))
        f(slots);
    });
  };
  std::vector<std::size_t> first(n, 0);
  parallel_for(
      n, [&](std::size_t v) { for_each_unlisted(v, [&](SurfaceFaces::Slots) { ++first[v]; }); });
  const std::size_t made = exclusive_scan(first), taken = mesh.triangles.size();
  mesh.triangles.resize(taken + made);
  parallel_for(n, [&](std::size_t v) {
    std::size_t next = taken + first[v];
    for_each_unlisted(v, [&](SurfaceFaces::Slots slots) {
      Triangle& s = mesh.triangles[next++];
      const FaceLink face = faces[slots.first], last = faces[slots.second - 1];
      s.v = face_vertices(mesh.tets[face.tet()], face.face());
      s.ref = std::min(mesh.tet_refs[face.tet()], mesh.tet_refs[last.tet()]);
    });
  });
  summary.made_triangles = std::int64_t(made);
}

/// The normals of used vertices, the first listed one of each; those without a direction are none.
void take_normals(const MeshData& data, const std::vector<VertexId>& new_vertex, TetMesh& mesh) {
  for (const auto& [v, normal] : data.normal_at_vertices)
    if (new_vertex[v] != kNone && norm2(data.normals[normal]) > 0)
      mesh.normals.push_back({new_vertex[v], data.normals[normal]});
  auto& all = mesh.normals;
  std::ranges::stable_sort(all, {}, &GivenNormal::vertex);
  const auto of_one = [](const GivenNormal& a, const GivenNormal& b) {
    return a.vertex == b.vertex;
  };
  all.erase(std::unique(all.begin(), all.end(), of_one), all.end());
}

/// Flat tets that hide vertices of the boundary go; the new numbers of vertices are kept in step.
void peel(const MeshData& data, std::vector<VertexId>& new_vertex, BuildResult& out) {
  if (!data.required_tets.empty()) return;
  std::vector<VertexId> kept;
  for (const auto* listed : {&data.corners, &data.required_vertices})
    for (const std::int32_t v : *listed) kept.push_back(new_vertex[v]);
  const Peeled peeled = peel_flat_tets(out.mesh, kept);
  out.summary.peeled_tets = peeled.tets;
  if (peeled.vertices.empty()) return;
  for (std::size_t v = 0; v < new_vertex.size(); ++v) {
    if (new_vertex[v] == kNone) continue;
    const auto at = std::ranges::lower_bound(peeled.vertices, new_vertex[v]);
    if (at != peeled.vertices.end() && *at == new_vertex[v]) {
      new_vertex[v] = kNone;
    } else {
      new_vertex[v] -= VertexId(at - peeled.vertices.begin());
    }
  }
}

}  // namespace

std::vector<std::string> BuildSummary::warnings() const {
  std::vector<std::string> out;
  const auto warn = [&](std::int64_t n, const char* one, const char* many) {
    if (n != 0) out.push_back(fmt::format("{} {}", n, n == 1 ? one : many));
  };
  warn(turned_tets, "tet of negative volume was turned over",
       "tets of negative volume were turned over");
  warn(flat_tets, "tet has no volume", "tets have no volume");
  warn(peeled_tets, "flat tet that hid a vertex of the boundary was taken off it",
       "flat tets that hid vertices of the boundary were taken off it");
  warn(unused_vertices, "vertex of no tet was dropped", "vertices of no tet were dropped");
  warn(made_triangles, "missing surface triangle was made", "missing surface triangles were made");
  warn(dropped_triangles, "triangle that is no surface face, or doubled, was dropped",
       "triangles that are no surface faces, or doubled, were dropped");
  warn(dropped_edges, "edge that is no edge of the surface was dropped",
       "edges that are no edges of the surface were dropped");
  return out;
}

BuildResult build(MeshData data, const BuildOptions& options) {
  check_lists(data);
  check_tets(data);
  check_coordinates(data);
  check_sizes(data);

  BuildResult out;
  TetMesh& mesh = out.mesh;
  std::vector<VertexId> new_vertex = take_vertices(data, mesh);
  out.summary.unused_vertices = std::int64_t(new_vertex.size() - mesh.points.size());
  take_tets(data, new_vertex, mesh, out.summary);
  link_faces(mesh);
  if (out.summary.flat_tets != 0) orient_flat_tets(mesh);

  const bool may_be_inside = options.keep_internal || !data.required_triangles.empty();
  const SurfaceFaces faces(mesh, may_be_inside ? FaceChoice::kAll : FaceChoice::kSurface);
  const ListedTriangles listed = find_listed(data, new_vertex, mesh, faces, options.keep_internal);
  take_triangles(data, new_vertex, faces, listed, mesh, out.summary);
  make_triangles(faces, listed, mesh, out.summary);
  attach_triangles(mesh, faces);
  peel(data, new_vertex, out);
  if (mesh.points.size() < new_vertex.size()) out.unused_vertices = unused_of(new_vertex);
  if (may_be_inside) orient_internal_sheets(mesh);
  tag_features(mesh, data, new_vertex, out.summary);
  take_normals(data, new_vertex, mesh);
  return out;
}

}  // namespace cavea
