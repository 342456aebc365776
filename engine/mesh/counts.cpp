
#include <bit>

#include "cavea/base/parallel.h"
#include "cavea/geometry/box.h"
#include "cavea/mesh/statistics.h"
#include "cavea/mesh/surface_edges.h"
#include "cavea/mesh/union_find.h"

namespace cavea {
namespace {

struct VertexSum {
  std::int64_t vertices = 0, corners = 0, required = 0;
  Box box;

  void add(const VertexSum& b) {
    vertices += b.vertices;
    corners += b.corners;
    required += b.required;
    box.add(b.box);
  }
};

struct ExteriorSum {
  double area2 = 0, volume6 = 0;

  void add(const ExteriorSum& b) { area2 += b.area2, volume6 += b.volume6; }
};

struct TetSum {
  std::int64_t tets = 0;
  double volume = 0;
  std::map<std::int32_t, std::int64_t> of_ref;
  std::map<std::int32_t, double> volume_of_ref;

  void add(const TetSum& b) {
    tets += b.tets;
    volume += b.volume;
    for (const auto& [ref, n] : b.of_ref) of_ref[ref] += n;
    for (const auto& [ref, v] : b.volume_of_ref) volume_of_ref[ref] += v;
  }
};

/// Sums what add(sum, begin, end) adds over blocks of [0, n), in their order.
template <class Sum, class Add>
Sum sum_up_blocks(std::size_t n, Add&& add) {
  return parallel_reduce(
      n, Sum{},
      [&](std::size_t begin, std::size_t end) {
        Sum here;
        add(here, begin, end);
        return here;
      },
      [](Sum a, const Sum& b) {
        a.add(b);
        return a;
      });
}

/// Sums add_one(sum, i) over i in [0, n); the shape of the sum depends on n alone.
template <class Sum, class AddOne>
Sum sum_up(std::size_t n, AddOne&& add_one) {
  return sum_up_blocks<Sum>(n, [&](Sum& here, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) add_one(here, i);
  });
}

VertexSum sum_vertices(const TetMesh& mesh) {
  return sum_up<VertexSum>(mesh.points.size(), [&](VertexSum& sum, std::size_t v) {
    if (!mesh.vertex_alive(VertexId(v))) return;
    ++sum.vertices;
    sum.corners += (mesh.vertex_tags[v] & tag::kCorner) != 0;
    sum.required += (mesh.vertex_tags[v] & tag::kRequired) != 0;
    sum.box.add(mesh.points[v]);
  });
}

TetSum sum_tets(const TetMesh& mesh) {
  return sum_up_blocks<TetSum>(
      mesh.tets.size(), [&](TetSum& sum, std::size_t begin, std::size_t end) {
        // Tets of one reference mostly follow each other: it is looked up where it changes.
        std::int64_t* tets_of_ref = nullptr;
        double* volume_of_ref = nullptr;
        std::int32_t last_ref = 0;
        for (std::size_t t = begin; t < end; ++t) {
          if (!mesh.tet_alive(TetId(t))) continue;
          if (const std::int32_t ref = mesh.tet_refs[t]; !tets_of_ref || ref != last_ref)
            last_ref = ref, tets_of_ref = &sum.of_ref[ref], volume_of_ref = &sum.volume_of_ref[ref];
          const auto [a, b, c, d] = mesh.corners(TetId(t));
          const double volume = volume6(a, b, c, d) / 6;
          ++sum.tets;
          sum.volume += volume;
          ++*tets_of_ref;
          *volume_of_ref += volume;
        }
      });
}

struct Number {
  std::int64_t n = 0;
  void add(const Number& b) { n += b.n; }
};

/// How many sets hold the items for which counts(i) is true.
template <class Counts>
std::int64_t count_roots(std::size_t n, UnionFind& sets, Counts&& counts) {
  return sum_up<Number>(n,
                        [&](Number& sum, std::size_t i) {
                          sum.n += counts(i) && sets.is_root(std::int32_t(i));
                        })
      .n;
}

std::int64_t count_components(const TetMesh& mesh) {
  UnionFind sets(mesh.tets.size());
  parallel_for(mesh.tets.size(), [&](std::size_t t) {
    if (!mesh.tet_alive(TetId(t))) return;
    // Each face once. Behind which a tet of lower id is cannot be guessed: a bit for each.
    unsigned lower = 0, triangles = 0;
    for (int f = 0; f < 4; ++f) {
      const FaceLink link = mesh.links[t][f];
      lower |= unsigned(link.is_tet() && link.tet() < TetId(t)) << f;
      triangles |= unsigned(link.is_triangle()) << f;
    }
    for (; lower != 0; lower &= lower - 1)
      sets.join(TetId(t), mesh.links[t][std::countr_zero(lower)].tet());
    for (; triangles != 0; triangles &= triangles - 1)
      if (const FaceLink behind = mesh.across(TetId(t), std::countr_zero(triangles));
          behind.is_tet())
        sets.join(TetId(t), behind.tet());
  });
  return count_roots(mesh.tets.size(), sets,
                     [&](std::size_t t) { return mesh.tet_alive(TetId(t)); });
}

std::int64_t count_boundary_components(const TetMesh& mesh, const SurfaceEdges& edges) {
  UnionFind sets(mesh.triangles.size());
  parallel_for(edges.vertices(), [&](std::size_t a) {
    edges.for_each_at(mesh, VertexId(a), [&](VertexId, SurfaceEdges::Uses uses) {
      TriangleId first = kNone;
      for (const std::uint32_t use : uses) {
        const TriangleId i = SurfaceEdges::decode(use).triangle;
        if (!mesh.triangles[i].is_exterior()) continue;
        if (first == kNone) first = i;
        sets.join(first, i);
      }
    });
  });
  return count_roots(mesh.triangles.size(), sets,
                     [&](std::size_t i) { return mesh.triangles[i].is_exterior(); });
}

std::int64_t count_ridges(const TetMesh& mesh, const SurfaceEdges& edges) {
  return sum_up<Number>(edges.vertices(),
                        [&](Number& sum, std::size_t a) {
                          edges.for_each_at(
                              mesh, VertexId(a), [&](VertexId, SurfaceEdges::Uses uses) {
                                const auto [triangle, k] = SurfaceEdges::decode(uses[0]);
                                sum.n += (mesh.triangles[triangle].edge_tag[k] & tag::kRidge) != 0;
                              });
                        })
      .n;
}

}  // namespace

Counts count(const TetMesh& mesh) {
  Counts out;
  const VertexSum vertices = sum_vertices(mesh);
  out.vertices = vertices.vertices;
  out.corners = vertices.corners;
  out.required_vertices = vertices.required;
  if (!vertices.box.empty()) {
    out.box_min = vertices.box.low;
    out.box_max = vertices.box.high;
  }
  TetSum tets = sum_tets(mesh);
  out.tets = tets.tets;
  out.volume = tets.volume;
  out.tets_of_ref = std::move(tets.of_ref);
  out.volume_of_ref = std::move(tets.volume_of_ref);
  for (const Triangle& s : mesh.triangles)
    if (s.alive()) ++out.triangles, ++out.triangles_of_ref[s.ref];
  out.components = count_components(mesh);
  const SurfaceEdges edges(mesh);
  out.boundary_components = count_boundary_components(mesh, edges);
  out.ridges = count_ridges(mesh, edges);
  return out;
}

double box_diagonal(const TetMesh& mesh) {
  const Box box = sum_vertices(mesh).box;
  return box.empty() ? 0 : distance(box.low, box.high);
}

double thickness(const TetMesh& mesh) {
  if (mesh.triangles.empty()) return 0;
  const Vec3 origin = mesh.points[mesh.triangles[0].v[0]];  // near, or the sum loses digits
  const auto sum =
      sum_up<ExteriorSum>(mesh.triangles.size(), [&](ExteriorSum& here, std::size_t i) {
        const Triangle& t = mesh.triangles[i];
        if (!t.is_exterior()) return;
        const Vec3 a = mesh.points[t.v[0]], b = mesh.points[t.v[1]], c = mesh.points[t.v[2]];
        const Vec3 normal = cross(b - a, c - a);
        here.area2 += norm(normal);
        here.volume6 += dot(a - origin, normal);
      });
  return sum.area2 > 0 ? 2 * sum.volume6 / sum.area2 : 0;
}

}  // namespace cavea
