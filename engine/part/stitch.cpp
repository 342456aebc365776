#include <algorithm>

#include "cavea/base/parallel.h"
#include "cavea/part/extract.h"

namespace cavea {
namespace {

/// New ids of one part's entities.
struct NewIds {
  std::vector<VertexId> vertex;
  std::vector<TetId> tet;
  std::vector<TriangleId> triangle;
  std::int32_t vertices = 0, tets = 0, triangles = 0;  ///< how many this part adds
  std::vector<FaceLink> cut_face;                      ///< new face at each cut
};

class Stitch {
 public:
  Stitch(std::vector<Part>& parts, std::size_t vertices, std::size_t triangles)
      : parts_(parts),
        ids_(parts.size()),
        shared_vertex_(vertices, kNone),
        shared_triangle_(triangles, kNone),
        vertex_owner_(vertices, kNone) {}

  TetMesh run() {
    own_shared_vertices();
    parallel_tasks(parts_.size(), [&](std::size_t p) { count(p); });
    offset();
    parallel_tasks(parts_.size(), [&](std::size_t p) { publish_shared(p); });
    parallel_tasks(parts_.size(), [&](std::size_t p) { adopt_shared(p); });
    parallel_tasks(parts_.size(), [&](std::size_t p) { write(p); });
    return std::move(out_);
  }

 private:
  /// The lowest part that has a shared vertex owns it.
  void own_shared_vertices() {
    for (std::size_t p = 0; p < parts_.size(); ++p)
      for (VertexId v : parts_[p].shared_vertices)
        if (vertex_owner_[v] == kNone) vertex_owner_[v] = std::int32_t(p);
  }
  bool shared(const Part& part, std::size_t v) const {
    return v >= part.own_vertices && v < part.own_vertices + part.shared_vertices.size();
  }
  VertexId whole_id(const Part& part, std::size_t v) const {
    return part.shared_vertices[v - part.own_vertices];
  }

  /// Numbers the living entities of a part from 0.
  void count(std::size_t p) {
    const Part& part = parts_[p];
    const TetMesh& m = part.mesh;
    NewIds& n = ids_[p];
    n.vertex.assign(m.points.size(), kNone);
    for (std::size_t v = 0; v < m.points.size(); ++v) {
      const bool mine = shared(part, v) ? vertex_owner_[whole_id(part, v)] == std::int32_t(p)
                                        : m.vertex_alive(VertexId(v));
      if (mine) n.vertex[v] = n.vertices++;
    }
    n.tet.assign(m.tets.size(), kNone);
    for (std::size_t t = 0; t < m.tets.size(); ++t)
      if (m.tet_alive(TetId(t))) n.tet[t] = n.tets++;
    n.triangle.assign(m.triangles.size(), kNone);
    for (std::size_t t = 0; t < m.triangles.size(); ++t) {
      const Triangle& s = m.triangles[t];
      const bool mine = t < part.shared_triangles ? s.sides[0].is_tet() : s.alive();
      if (mine) n.triangle[t] = n.triangles++;
    }
  }

  void offset() {
    std::int32_t v = 0, t = 0, s = 0;
    for (NewIds& n : ids_) {
      auto shift = [](std::vector<std::int32_t>& ids, std::int32_t by) {
        for (std::int32_t& id : ids)
          if (id != kNone) id += by;
      };
      shift(n.vertex, v), shift(n.tet, t), shift(n.triangle, s);
      v += n.vertices, t += n.tets, s += n.triangles;
    }
    out_.resize_vertices(std::size_t(v));
    out_.resize_tets(std::size_t(t));
    out_.triangles.resize(std::size_t(s));
  }

  /// Owners tell the new ids of shared vertices and triangles, and the new faces at cuts.
  void publish_shared(std::size_t p) {
    const Part& part = parts_[p];
    NewIds& n = ids_[p];
    for (std::size_t i = 0; i < part.shared_vertices.size(); ++i)
      if (const VertexId id = n.vertex[part.own_vertices + i]; id != kNone)
        shared_vertex_[part.shared_vertices[i]] = id;
    for (std::size_t i = 0; i < part.shared_triangles; ++i)
      if (n.triangle[i] != kNone) shared_triangle_[part.triangle_of[i]] = n.triangle[i];
    n.cut_face.resize(part.partners.size());
    for (std::size_t t = 0; t < part.mesh.tets.size(); ++t)
      if (part.mesh.tet_alive(TetId(t)))
        for (int f = 0; f < 4; ++f)
          if (const FaceLink link = part.mesh.links[t][f]; link.is_cut())
            n.cut_face[std::size_t(link.cut())] = FaceLink::to_tet(n.tet[t], f);
  }

  void adopt_shared(std::size_t p) {
    const Part& part = parts_[p];
    NewIds& n = ids_[p];
    for (std::size_t i = 0; i < part.shared_vertices.size(); ++i)
      n.vertex[part.own_vertices + i] = shared_vertex_[part.shared_vertices[i]];
    for (std::size_t i = 0; i < part.shared_triangles; ++i)
      n.triangle[i] = shared_triangle_[part.triangle_of[i]];
  }

  FaceLink renamed(std::size_t p, FaceLink link) const {
    const NewIds& n = ids_[p];
    if (link.is_tet()) return FaceLink::to_tet(n.tet[link.tet()], link.face());
    if (link.is_triangle()) return FaceLink::to_triangle(n.triangle[link.triangle()]);
    if (!link.is_cut()) return link;
    const Part::Partner partner = parts_[p].partners[std::size_t(link.cut())];
    return ids_[std::size_t(partner.part)].cut_face[std::size_t(partner.cut)];
  }

  void write(std::size_t p) {
    write_vertices(p);
    write_tets(p);
    write_triangles(p);
    parts_[p].mesh = {};
  }

  void write_vertices(std::size_t p) {
    const Part& part = parts_[p];
    const TetMesh& m = part.mesh;
    for (std::size_t v = 0; v < m.points.size(); ++v) {
      const VertexId to = ids_[p].vertex[v];
      const bool is_shared = shared(part, v);
      if (to == kNone || (is_shared && vertex_owner_[whole_id(part, v)] != std::int32_t(p)))
        continue;
      out_.points[to] = m.points[v];
      out_.sizes[to] = m.sizes[v];
      out_.vertex_tags[to] = Tag((m.vertex_tags[v] & ~(tag::kFrozen | tag::kWasInterface)) |
                                 (is_shared ? tag::kWasInterface : 0));
      out_.vertex_refs[to] = m.vertex_refs[v];
      out_.vertex_tets[to] = ids_[p].tet[m.vertex_tets[v]];
      out_.anchors[to] = m.anchors[v];
    }
  }

  void write_tets(std::size_t p) {
    const TetMesh& m = parts_[p].mesh;
    for (std::size_t t = 0; t < m.tets.size(); ++t) {
      const TetId to = ids_[p].tet[t];
      if (to == kNone) continue;
      for (int k = 0; k < 4; ++k) {
        out_.tets[to][k] = ids_[p].vertex[m.tets[t][k]];
        out_.links[to][k] = renamed(p, m.links[t][k]);
      }
      out_.qualities[to] = m.qualities[t];
      out_.tet_refs[to] = m.tet_refs[t];
      std::uint8_t flags = m.tet_flags[t];
      if (flags & tet_flag::kAskLater)
        flags = std::uint8_t((flags | tet_flag::kAskAll) & ~tet_flag::kAskLater);
      out_.tet_flags[to] = flags;
    }
  }

  /// Each part writes its own side of a shared triangle; the rest comes from its owner.
  void write_triangles(std::size_t p) {
    const TetMesh& m = parts_[p].mesh;
    for (std::size_t t = 0; t < m.triangles.size(); ++t) {
      if (!m.triangles[t].alive()) continue;
      const bool is_shared = t < parts_[p].shared_triangles;
      Triangle s = m.triangles[t];
      Triangle& to = out_.triangles[ids_[p].triangle[t]];
      for (FaceLink& side : s.sides) side = side.is_tet() ? renamed(p, side) : FaceLink();
      if (is_shared && !s.sides[0].is_tet()) {
        to.sides[1] = s.sides[1];
        continue;
      }
      for (VertexId& v : s.v) v = ids_[p].vertex[v];
      s.tags &= Tag(~tag::kFrozen);
      to.v = s.v, to.ref = s.ref, to.patch = s.patch, to.tags = s.tags;
      to.edge_tag = s.edge_tag, to.edge_ref = s.edge_ref;
      to.sides[0] = s.sides[0];
      if (!is_shared) to.sides[1] = s.sides[1];
    }
  }

  std::vector<Part>& parts_;
  std::vector<NewIds> ids_;
  std::vector<VertexId> shared_vertex_;
  std::vector<TriangleId> shared_triangle_;
  std::vector<std::int32_t> vertex_owner_;
  TetMesh out_;
};

}  // namespace

TetMesh stitch_parts(std::vector<Part>& parts, std::size_t vertices, std::size_t triangles) {
  return Stitch(parts, vertices, triangles).run();
}

}  // namespace cavea
