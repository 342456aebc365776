#include "cavea/subdivide/subdivide.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "cavea/base/atomic.h"
#include "cavea/base/error.h"
#include "cavea/base/parallel.h"
#include "cavea/mesh/faces.h"
#include "cavea/mesh/renumber.h"
#include "cavea/subdivide/children.h"
#include "cavea/subdivide/pattern.h"
#include "cavea/subdivide/settle.h"
#include "cavea/subdivide/split_edges.h"

namespace cavea {
namespace {

/// Turns counts into first ids, with one past the last at the end. \throw InputError when the last
/// is beyond `most`.
void number(std::vector<std::int32_t>& counts, std::int64_t most, const char* what) {
  const std::int64_t total = parallel_reduce(
      counts.size(), std::int64_t{0},
      [&](std::size_t begin, std::size_t end) {
        std::int64_t sum = 0;
        for (std::size_t i = begin; i < end; ++i) sum += counts[i];
        return sum;
      },
      [](std::int64_t a, std::int64_t b) { return a + b; });
  if (total > most)
    throw InputError(
        fmt::format("subdivision makes {} {}; at most {} can be held", total, what, most));
  counts.push_back(0);
  exclusive_scan(counts);
}

class Subdivision {
 public:
  Subdivision(const TetMesh& mesh, const SplitTest& split)
      : mesh_(mesh), edges_(mesh, split), vertices_(living_vertices(mesh)) {}

  TetMesh run(const Placement& place, double least_share) {
    make_vertices(place);
    make_tets();
    make_triangles();
    link_tets();
    link_triangles();
    set_vertex_tets();
    settle({mesh_, edges_, first_child_, first_new_, least_share}, out_);
    parallel_for(out_.tets.size(),
                 [&](std::size_t t) { out_.qualities[t] = float(out_.compute_quality(TetId(t))); });
    return std::move(out_);
  }

 private:
  void make_vertices(const Placement& place) {
    const std::size_t total = vertices_.count + edges_.size();
    constexpr std::size_t kMost = std::numeric_limits<VertexId>::max();
    if (total > kMost)
      throw InputError(
          fmt::format("subdivision makes {} vertices; at most {} can be held", total, kMost));
    first_new_ = VertexId(vertices_.count);
    out_.resize_vertices(total);
    parallel_for(mesh_.points.size(), [&](std::size_t v) { copy_vertex(VertexId(v)); });
    parallel_for(edges_.size(), [&](std::size_t k) {
      const NewVertex made = place(edges_.edge(mesh_, k));
      const std::size_t v = first_new_ + k;
      out_.points[v] = made.point;
      out_.sizes[v] = made.size;
      out_.vertex_tags[v] = made.tags;
      out_.vertex_refs[v] = made.ref;
      out_.anchors[v] = made.anchor;
    });
  }

  void copy_vertex(VertexId from) {
    const VertexId to = vertices_[from];
    if (to == kNone) return;
    out_.points[to] = mesh_.points[from];
    out_.sizes[to] = mesh_.sizes[from];
    out_.vertex_tags[to] = mesh_.vertex_tags[from];
    out_.vertex_refs[to] = mesh_.vertex_refs[from];
    out_.anchors[to] = mesh_.anchors[from];
  }

  /// The vertex of the result on edge (a, b) of the mesh; kNone if it is not split.
  VertexId vertex_on(VertexId a, VertexId b) const {
    const std::int32_t rank = edges_.find(a, b);
    return rank == kNone ? kNone : first_new_ + rank;
  }

  SplitTet split_tet(std::size_t t) const {
    SplitTet tet;
    const auto& v = mesh_.tets[t];
    for (int i = 0; i < 4; ++i) tet.vertices[i] = vertices_[v[i]];
    for (int e = 0; e < 6; ++e) {
      const VertexId m = vertex_on(v[kEdgeVertices[e][0]], v[kEdgeVertices[e][1]]);
      tet.vertices[4 + e] = m;
      tet.mask |= unsigned(m != kNone) << e;
    }
    return tet;
  }

  void make_tets() {
    first_child_.resize(mesh_.tets.size());
    parallel_for(mesh_.tets.size(), [&](std::size_t t) {
      first_child_[t] =
          mesh_.tet_alive(TetId(t)) ? tet_pattern(split_tet(t), out_.points).count : 0;
    });
    number(first_child_, kMaxTets, "tets");
    out_.resize_tets(first_child_.back());
    const std::array<unsigned, 4> faces = face_masks();
    parallel_for(mesh_.tets.size(), [&](std::size_t t) {
      if (mesh_.tet_alive(TetId(t))) make_children(TetId(t), faces);
    });
  }

  void make_children(TetId t, const std::array<unsigned, 4>& faces) {
    const SplitTet tet = split_tet(t);
    const TetPattern pattern = tet_pattern(tet, out_.points);
    const std::uint8_t asks = tet.mask ? tet_flag::kAskAll : 0;
    for (int k = 0; k < pattern.count; ++k) {
      const TetId child = first_child_[t] + k;
      for (int i = 0; i < 4; ++i) out_.tets[child][i] = tet.vertices[pattern.tets[k][i]];
      out_.tet_refs[child] = mesh_.tet_refs[t];
      out_.tet_flags[child] = mesh_.tet_flags[t] | asks;
    }
    link_siblings(first_child_[t], pattern, faces);
  }

  /// Links the children's common faces to each other. A face that lies on face f of the parent is
  /// noted as cut f, until link_tets().
  void link_siblings(TetId first, const TetPattern& pattern, const std::array<unsigned, 4>& faces) {
    struct Open {
      unsigned mask;
      FaceLink face;
    };
    std::array<Open, 32> open;
    int count = 0;
    for (int k = 0; k < pattern.count; ++k) {
      unsigned all = 0;
      for (const std::uint8_t local : pattern.tets[k]) all |= 1u << local;
      for (int i = 0; i < 4; ++i) {
        const FaceLink here = FaceLink::to_tet(first + k, i);
        FaceLink& link = out_.links[first + k][i];
        const unsigned mask = all & ~(1u << pattern.tets[k][i]);
        for (int f = 0; f < 4; ++f)
          if ((mask & ~faces[f]) == 0) link = FaceLink::to_cut(f);
        if (link.is_cut()) continue;
        int o = 0;
        while (o < count && open[o].mask != mask) ++o;
        if (o == count) {
          open[count++] = {mask, here};
        } else {
          link = open[o].face;
          out_.links[link.tet()][link.face()] = here;
        }
      }
    }
  }

  SplitTriangle split_triangle(const Triangle& from) const {
    SplitTriangle triangle;
    for (int i = 0; i < 3; ++i) {
      triangle.vertices[i] = vertices_[from.v[i]];
      const VertexId m = vertex_on(from.v[(i + 1) % 3], from.v[(i + 2) % 3]);
      triangle.vertices[3 + i] = m;
      triangle.mask |= unsigned(m != kNone) << i;
    }
    return triangle;
  }

  void make_triangles() {
    first_triangle_.resize(mesh_.triangles.size());
    parallel_for(mesh_.triangles.size(), [&](std::size_t s) {
      const Triangle& from = mesh_.triangles[s];
      first_triangle_[s] = from.alive() ? triangle_pattern(split_triangle(from)).count : 0;
    });
    // A triangle code has the range of a tet's face: two surface triangles a tet are its bound.
    number(first_triangle_, 2 * kMaxTets - 2, "triangles");
    out_.triangles.resize(first_triangle_.back());
    parallel_for(mesh_.triangles.size(), [&](std::size_t s) {
      if (mesh_.triangles[s].alive()) make_child_triangles(TriangleId(s));
    });
  }

  void make_child_triangles(TriangleId s) {
    const Triangle& from = mesh_.triangles[s];
    const SplitTriangle triangle = split_triangle(from);
    const TrianglePattern pattern = triangle_pattern(triangle);
    for (int k = 0; k < pattern.count; ++k) {
      const auto& locals = pattern.triangles[k];
      Triangle& child = out_.triangles[first_triangle_[s] + k];
      child = from;
      for (int i = 0; i < 3; ++i) {
        child.v[i] = triangle.vertices[locals[i]];
        const int old_edge = parent_edge(locals[(i + 1) % 3], locals[(i + 2) % 3]);
        child.edge_tag[i] = old_edge == 3 ? Tag{0} : from.edge_tag[old_edge];
        child.edge_ref[i] = old_edge == 3 ? 0 : from.edge_ref[old_edge];
      }
    }
  }

  /// The edge of a triangle that two of its local ids lie on; 3 if there is none.
  static int parent_edge(int a, int b) {
    int i = 0;
    // Edge i holds the two corners but i, and the vertex 3 + i.
    auto on = [&](int local) { return local < 3 ? local != i : local == 3 + i; };
    while (i < 3 && !(on(a) && on(b))) ++i;
    return i;
  }

  void link_tets() {
    parallel_for(mesh_.tets.size(), [&](std::size_t t) {
      for (TetId child = first_child_[t]; child < first_child_[t + 1]; ++child)
        for (int i = 0; i < 4; ++i)
          if (FaceLink& link = out_.links[child][i]; link.is_cut())
            link = behind(mesh_.links[t][link.cut()], face_vertices(out_.tets[child], i));
    });
  }

  /// What lies behind a child's face: the piece with the same vertices of what lies behind its
  /// parent's. Reads no links of the result, which others write at the same time.
  FaceLink behind(FaceLink parent, const std::array<VertexId, 3>& face) const {
    if (parent.is_unset()) return {};
    if (parent.is_tet()) return find_child_face(parent.tet(), face);
    if (parent.is_triangle()) {
      const TriangleId s = parent.triangle();
      const TriangleId child =
          find_triangle(out_, first_triangle_[s], first_triangle_[s + 1], face);
      if (child == kNone) throw InternalError(fmt::format("triangle {} is not on its face", s));
      return FaceLink::to_triangle(child);
    }
    if (std::ranges::any_of(face, [&](VertexId v) { return v >= first_new_; })) refuse(parent);
    return parent;
  }

  [[noreturn]] static void refuse(FaceLink cut) {
    throw InternalError(fmt::format("cut face {} of a part is to be split", cut.cut()));
  }

  FaceLink find_child_face(TetId parent, const std::array<VertexId, 3>& face) const {
    const FaceLink found = find_face(out_, first_child_[parent], first_child_[parent + 1], face);
    if (found.is_unset())
      throw InternalError(fmt::format("tet {} does not have its neighbour's face", parent));
    return found;
  }

  void link_triangles() {
    parallel_for(mesh_.triangles.size(), [&](std::size_t s) {
      const bool split = first_triangle_[s + 1] > first_triangle_[s] + 1;
      for (TriangleId child = first_triangle_[s]; child < first_triangle_[s + 1]; ++child) {
        for (FaceLink& side : out_.triangles[child].sides) {
          if (side.is_tet()) side = find_child_face(side.tet(), out_.triangles[child].v);
          if (side.is_cut() && split) refuse(side);
        }
      }
    });
  }

  /// The smallest tet of each vertex.
  void set_vertex_tets() {
    std::ranges::fill(out_.vertex_tets, std::numeric_limits<TetId>::max());
    parallel_for(out_.tets.size(), [&](std::size_t t) {
      for (const VertexId v : out_.tets[t]) atomic_min(out_.vertex_tets[v], TetId(t));
    });
  }

  const TetMesh& mesh_;
  const SplitEdges edges_;
  const Renumbering vertices_;
  VertexId first_new_ = 0;                  ///< the vertex on the first split edge
  std::vector<TetId> first_child_;          ///< of each tet, and one past the last
  std::vector<TriangleId> first_triangle_;  ///< of each triangle, and one past the last
  TetMesh out_;
};

}  // namespace

NewVertex straight_midpoint(const TetMesh& mesh, const MeshEdge& edge) {
  NewVertex made;
  made.point = (mesh.points[edge.a] + mesh.points[edge.b]) * 0.5;
  const float sa = mesh.sizes[edge.a], sb = mesh.sizes[edge.b];
  made.size = sa > 0 && sb > 0 ? (sa + sb) / 2 : std::max(sa, sb);
  if (edge.triangle == kNone) return made;
  constexpr Tag kAlongEdge = tag::kOnCurve | tag::kPinched;
  made.tags = tag::kSurface | (mesh.triangles[edge.triangle].edge_tag[edge.side] & kAlongEdge);
  made.anchor = mesh.anchors[edge.a];
  return made;
}

TetMesh subdivide(const TetMesh& mesh, const SplitTest& split, const Placement& place,
                  double least_volume_share) {
  return Subdivision(mesh, split).run(place, least_volume_share);
}

}  // namespace cavea
