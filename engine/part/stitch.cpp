#include <algorithm>
#include <span>

#include "cavea/base/parallel.h"
#include "cavea/part/extract.h"

namespace cavea {
namespace {

/// Whole-mesh ids of the local entities of one kind in one part; kNone for those that are gone.
struct Ids {
  std::vector<std::int32_t> of_local;
  std::vector<std::int32_t> free;  ///< ids of those that are gone, ascending
  std::int32_t missing = 0;        ///< new ones for which there is none

  /// \param was ids that the first local entities had
  template <class Lives>
  void assign(std::span<const std::int32_t> was, std::size_t count, Lives&& lives) {
    of_local.assign(count, kNone);
    for (std::size_t i = 0; i < was.size(); ++i) {
      if (lives(i))
        of_local[i] = was[i];
      else
        free.push_back(was[i]);
    }
    std::size_t used = 0;
    for (std::size_t i = was.size(); i < count; ++i) {
      if (!lives(i)) continue;
      of_local[i] = used < free.size() ? free[used++] : kMissing;
      missing += of_local[i] == kMissing;
    }
    free.erase(free.begin(), free.begin() + std::ptrdiff_t(used));
  }

  /// Gives the missing ones ids from `next` on; returns the next after them.
  std::int32_t append(std::int32_t next) {
    if (missing > 0)
      for (std::int32_t& id : of_local)
        if (id == kMissing) id = next++;
    return next;
  }

 private:
  static constexpr std::int32_t kMissing = -2;
};

struct NewIds {
  Ids vertices, tets, triangles;
  std::vector<FaceLink> cut_face;  ///< new face at each cut
};

class Stitch {
 public:
  Stitch(TetMesh& mesh, std::vector<Part>& parts, std::vector<std::int32_t>& part_of_tet)
      : mesh_(mesh),
        parts_(parts),
        part_of_tet_(part_of_tet),
        ids_(parts.size()),
        vertex_owner_(mesh.points.size(), kNone) {}

  void run() {
    own_shared_vertices();
    parallel_tasks(parts_.size(), [&](std::size_t p) { assign_ids(p); });
    append();
    parallel_tasks(parts_.size(), [&](std::size_t p) { publish_cuts(p); });
    parallel_tasks(parts_.size(), [&](std::size_t p) { write(p); });
  }

 private:
  /// The lowest part that has a shared vertex owns it.
  void own_shared_vertices() {
    for (std::size_t p = 0; p < parts_.size(); ++p)
      for (VertexId v : parts_[p].shared_vertices)
        if (vertex_owner_[v] == kNone) vertex_owner_[v] = std::int32_t(p);
  }
  static bool shared(const Part& part, std::size_t v) {
    return v >= part.own_vertices.size() &&
           v < part.own_vertices.size() + part.shared_vertices.size();
  }

  void assign_ids(std::size_t p) {
    const Part& part = parts_[p];
    const TetMesh& m = part.mesh;
    std::vector<VertexId> vertices = part.own_vertices;
    vertices.insert(vertices.end(), part.shared_vertices.begin(), part.shared_vertices.end());
    ids_[p].vertices.assign(vertices, m.points.size(), [&](std::size_t v) {
      return shared(part, v) || m.vertex_alive(VertexId(v));
    });
    ids_[p].tets.assign(part.tets, m.tets.size(),
                        [&](std::size_t t) { return m.tet_alive(TetId(t)); });
    ids_[p].triangles.assign(part.triangles, m.triangles.size(), [&](std::size_t t) {
      return t < part.shared_triangles || m.triangles[t].alive();
    });
  }

  void append() {
    auto v = VertexId(mesh_.points.size());
    auto t = TetId(mesh_.tets.size());
    auto s = TriangleId(mesh_.triangles.size());
    for (NewIds& n : ids_)
      v = n.vertices.append(v), t = n.tets.append(t), s = n.triangles.append(s);
    mesh_.resize_vertices(std::size_t(v));
    mesh_.resize_tets(std::size_t(t));
    mesh_.triangles.resize(std::size_t(s));
    part_of_tet_.resize(std::size_t(t), kIdle);
  }

  /// Tells the new faces at cuts.
  void publish_cuts(std::size_t p) {
    const Part& part = parts_[p];
    NewIds& n = ids_[p];
    n.cut_face.resize(part.partners.size());
    for (std::size_t t = 0; t < part.mesh.tets.size(); ++t)
      if (part.mesh.tet_alive(TetId(t)))
        for (int f = 0; f < 4; ++f)
          if (const FaceLink link = part.mesh.links[t][f]; link.is_cut())
            n.cut_face[std::size_t(link.cut())] = FaceLink::to_tet(n.tets.of_local[t], f);
  }

  FaceLink renamed(std::size_t p, FaceLink link) const {
    const NewIds& n = ids_[p];
    if (link.is_tet()) return FaceLink::to_tet(n.tets.of_local[link.tet()], link.face());
    if (link.is_triangle()) return FaceLink::to_triangle(n.triangles.of_local[link.triangle()]);
    if (!link.is_cut()) return link;
    const Part::Partner partner = parts_[p].partners[std::size_t(link.cut())];
    if (partner.part == kIdle) return FaceLink::from_code(partner.cut);
    return ids_[std::size_t(partner.part)].cut_face[std::size_t(partner.cut)];
  }

  void write(std::size_t p) {
    write_vertices(p);
    write_tets(p);
    write_triangles(p);
    parts_[p] = {};
  }

  /// The tags of local vertex v, which is vertex `to` of the mesh.
  Tag stitched_tags(std::size_t p, std::size_t v, VertexId to) const {
    const Part& part = parts_[p];
    Tag tags = Tag(part.mesh.vertex_tags[v] & ~(tag::kFrozen | tag::kWasInterface));
    if (shared(part, v)) tags |= tag::kWasInterface;
    const bool was_there = v < part.own_vertices.size() + part.shared_vertices.size();
    // The mesh may be a part itself, whose interface stays frozen.
    return was_there ? Tag(tags | (mesh_.vertex_tags[to] & tag::kFrozen)) : tags;
  }

  void write_vertices(std::size_t p) {
    const Part& part = parts_[p];
    const TetMesh& m = part.mesh;
    const Ids& ids = ids_[p].vertices;
    for (const VertexId v : ids.free) mesh_.vertex_tets[v] = kNone, mesh_.vertex_tags[v] = 0;
    for (std::size_t v = 0; v < m.points.size(); ++v) {
      const VertexId to = ids.of_local[v];
      const bool is_shared = shared(part, v);
      if (to == kNone || (is_shared && vertex_owner_[to] != std::int32_t(p))) continue;
      mesh_.points[to] = m.points[v];
      mesh_.sizes[to] = m.sizes[v];
      mesh_.vertex_tags[to] = stitched_tags(p, v, to);
      mesh_.vertex_refs[to] = m.vertex_refs[v];
      mesh_.vertex_tets[to] = ids_[p].tets.of_local[m.vertex_tets[v]];
      mesh_.anchors[to] = m.anchors[v];
    }
  }

  void write_tets(std::size_t p) {
    const TetMesh& m = parts_[p].mesh;
    const NewIds& ids = ids_[p];
    for (const TetId t : ids.tets.free) {
      mesh_.tets[t] = {kNone, kNone, kNone, kNone};
      mesh_.links[t] = {};
      mesh_.tet_flags[t] = 0;
    }
    for (std::size_t t = 0; t < m.tets.size(); ++t) {
      const TetId to = ids.tets.of_local[t];
      if (to == kNone) continue;
      for (int k = 0; k < 4; ++k) {
        mesh_.tets[to][k] = ids.vertices.of_local[m.tets[t][k]];
        mesh_.links[to][k] = renamed(p, m.links[t][k]);
        if (m.links[t][k].is_cut()) tell_idle(p, m.links[t][k], FaceLink::to_tet(to, k));
      }
      part_of_tet_[to] = std::int32_t(p);
      mesh_.qualities[to] = m.qualities[t];
      mesh_.tet_refs[to] = m.tet_refs[t];
      std::uint8_t flags = m.tet_flags[t];
      if (flags & tet_flag::kAskLater)
        flags = std::uint8_t((flags | tet_flag::kAskAll) & ~tet_flag::kAskLater);
      mesh_.tet_flags[to] = flags;
    }
  }

  /// An idle tet behind a cut gets the new face that is in front of it.
  void tell_idle(std::size_t p, FaceLink cut, FaceLink face) {
    const Part::Partner partner = parts_[p].partners[std::size_t(cut.cut())];
    if (partner.part != kIdle) return;
    const FaceLink idle = FaceLink::from_code(partner.cut);
    if (idle.is_cut()) return;  // of the mesh, which is a part
    mesh_.links[idle.tet()][idle.face()] = face;
  }

  /// Each part writes its own sides of shared triangles, which do not change otherwise.
  void write_triangles(std::size_t p) {
    const TetMesh& m = parts_[p].mesh;
    const NewIds& ids = ids_[p];
    for (const TriangleId t : ids.triangles.free) mesh_.triangles[t] = {};
    for (std::size_t t = 0; t < m.triangles.size(); ++t) {
      if (ids.triangles.of_local[t] == kNone) continue;
      Triangle s = m.triangles[t];
      Triangle& to = mesh_.triangles[ids.triangles.of_local[t]];
      for (FaceLink& side : s.sides) side = side.is_tet() ? renamed(p, side) : FaceLink();
      if (t < parts_[p].shared_triangles) {
        const std::size_t mine = s.sides[0].is_tet() ? 0 : 1;
        to.sides[mine] = s.sides[mine];
        continue;
      }
      for (VertexId& v : s.v) v = ids.vertices.of_local[v];
      const bool was_there = t < parts_[p].triangles.size();
      s.tags = Tag((s.tags & ~tag::kFrozen) | (was_there ? to.tags & tag::kFrozen : 0));
      to = s;
    }
  }

  TetMesh& mesh_;
  std::vector<Part>& parts_;
  std::vector<std::int32_t>& part_of_tet_;
  std::vector<NewIds> ids_;
  std::vector<std::int32_t> vertex_owner_;
};

}  // namespace

void stitch_parts(TetMesh& mesh, std::vector<Part>& parts, std::vector<std::int32_t>& part_of_tet) {
  Stitch(mesh, parts, part_of_tet).run();
}

}  // namespace cavea
