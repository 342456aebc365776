#include "cavea/cavity/mesh_editor.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "cavea/base/error.h"

namespace cavea {
namespace {

constexpr std::size_t kFirstTableSize = 1024;
/// Marks the links of tets and triangles that the cavity removes, while commit() runs.
constexpr std::uint8_t kLeaving = 128;
constexpr Tag kLeavingTriangle = Tag(1) << 15;
constexpr char kNotClosed[] = "a cavity did not close";

/// Without branches, which nobody could foretell.
std::array<VertexId, 3> sorted_key(VertexId a, VertexId b, VertexId c) {
  const VertexId least = std::min(std::min(a, b), c), most = std::max(std::max(a, b), c);
  return {least, a ^ b ^ c ^ least ^ most, most};
}

/// The library's own comparison calls memcmp, which takes longer than all of this.
bool same_key(const std::array<VertexId, 3>& a, const std::array<VertexId, 3>& b) {
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/// Whether two orders of the same three vertices differ by a rotation only.
bool same_turn(const std::array<VertexId, 3>& a, VertexId x, VertexId y) {
  return (a[0] == x && a[1] == y) || (a[1] == x && a[2] == y) || (a[2] == x && a[0] == y);
}

}  // namespace

MeshEditor::MeshEditor(TetMesh& mesh) : mesh_(mesh), table_(kFirstTableSize) {
  for (std::size_t t = mesh.tets.size(); t-- > 0;)
    if (mesh.tet_alive(TetId(t)))
      ++living_tets_;
    else
      free_tets_.push_back(TetId(t));
  for (std::size_t t = mesh.triangles.size(); t-- > 0;)
    if (!mesh.triangles[t].alive()) free_triangles_.push_back(TriangleId(t));
  for (std::size_t v = mesh.points.size(); v-- > 0;)
    if (!mesh.vertex_alive(VertexId(v))) free_vertices_.push_back(VertexId(v));
}

MeshEditor::MeshEditor(TetMesh& mesh, const Holes& holes)
    : mesh_(mesh), reuses_vertices_(false), table_(kFirstTableSize) {
  for (std::int32_t k = holes.tets; k-- > 0;) free_tets_.push_back(holes.first_tet + k);
  for (std::int32_t k = holes.vertices; k-- > 0;) free_vertices_.push_back(holes.first_vertex + k);
}

VertexId MeshEditor::next_vertex() const {
  return free_vertices_.empty() ? VertexId(mesh_.points.size()) : free_vertices_.back();
}

MeshEditor::Face& MeshEditor::slot(VertexId a, VertexId b, VertexId c) {
  const auto key = sorted_key(a, b, c);
  std::size_t i = (std::uint32_t(key[0]) * 0x9E3779B1u ^ std::uint32_t(key[1]) * 0x85EBCA77u ^
                   std::uint32_t(key[2]) * 0xC2B2AE3Du);
  i = (i ^ (i >> 15)) & mask_;
  while (table_[i].epoch == epoch_ && !same_key(table_[i].key, key)) i = (i + 1) & mask_;
  Face& face = table_[i];
  if (face.epoch != epoch_) {
    face.key = key;
    face.epoch = epoch_;
    face.open = false;
    face.uses = 0;
  }
  return face;
}

/// A face of the hole: what is behind it waits for a new tet.
void MeshEditor::open_face(TetId t, int f, Face& face) {
  face.link = mesh_.links[t][f];
  face.side = 0;
  if (face.link.is_triangle()) {
    const Triangle& s = mesh_.triangles[face.link.triangle()];
    face.side = s.sides[0] == FaceLink::to_tet(t, f) ? 0 : 1;
  }
  face.open = true;
  ++open_faces_;
}

void MeshEditor::mark_leaving(const Cavity& cavity) {
  for (TetId t : cavity.removed_tets) mesh_.tet_flags[t] |= kLeaving;
  for (TriangleId t : cavity.removed_triangles) mesh_.triangles[t].tags |= kLeavingTriangle;
}

void MeshEditor::unmark_leaving(const Cavity& cavity) {
  for (TetId t : cavity.removed_tets) mesh_.tet_flags[t] &= std::uint8_t(~kLeaving);
  for (TriangleId t : cavity.removed_triangles) mesh_.triangles[t].tags &= Tag(~kLeavingTriangle);
}

/// Whether what is behind a face of a removed tet stays.
bool MeshEditor::stays(FaceLink link) const {
  if (link.is_tet()) return !(mesh_.tet_flags[link.tet()] & kLeaving);
  return !link.is_triangle() || !(mesh_.triangles[link.triangle()].tags & kLeavingTriangle);
}

void MeshEditor::open_hole(const Cavity& cavity) {
  mark_leaving(cavity);
  for (TetId t : cavity.removed_tets)
    for (int f = 0; f < 4; ++f) {
      if (!stays(mesh_.links[t][f])) continue;
      const auto& k = mesh_.tets[t];
      const int* fv = kFaceVertices[f];
      open_face(t, f, slot(k[fv[0]], k[fv[1]], k[fv[2]]));
    }
}

void MeshEditor::place_vertex(const Cavity& cavity) {
  if (!cavity.inserts_vertex) return;
  const VertexId v = next_vertex();
  if (free_vertices_.empty())
    mesh_.resize_vertices(mesh_.points.size() + 1);
  else
    free_vertices_.pop_back();
  mesh_.points[v] = cavity.vertex.point;
  mesh_.sizes[v] = cavity.vertex.size;
  mesh_.vertex_tags[v] = cavity.vertex.tags;
  mesh_.vertex_refs[v] = cavity.vertex.ref;
  mesh_.anchors[v] = cavity.vertex.anchor;
}

void MeshEditor::add_triangles(const Cavity& cavity) {
  std::size_t reuse = 0;
  for (const Triangle& t : cavity.triangles) {
    TriangleId id;
    if (reuse < cavity.removed_triangles.size()) {
      id = cavity.removed_triangles[reuse++];
    } else if (!free_triangles_.empty()) {
      id = free_triangles_.back();
      free_triangles_.pop_back();
    } else {
      id = TriangleId(mesh_.triangles.size());
      mesh_.triangles.emplace_back();
    }
    mesh_.triangles[id] = t;
    mesh_.triangles[id].sides = {};
    Face& face = slot(t.v[0], t.v[1], t.v[2]);
    // A face of the hole that becomes surface: the tet behind it is one of the triangle's sides.
    const FaceLink outer = face.open ? face.link : FaceLink();
    face.link = FaceLink::to_triangle(id);
    face.side = -1;
    if (outer.is_tet()) {
      // Of vertices that no new tet has, this may be the only one that they are known to keep.
      for (const VertexId v : t.v) mesh_.vertex_tets[v] = outer.tet();
      attach(outer.tet(), outer.face(), face);
      --open_faces_;
    }
    face.open = true;
  }
  for (std::size_t i = reuse; i < cavity.removed_triangles.size(); ++i) {
    mesh_.triangles[cavity.removed_triangles[i]] = {};
    free_triangles_.push_back(cavity.removed_triangles[i]);
  }
}

void MeshEditor::attach(TetId t, int f, Face& face) {
  FaceLink& link = mesh_.links[t][f];
  const FaceLink mine = FaceLink::to_tet(t, f);
  if (face.link.is_triangle()) {
    Triangle& s = mesh_.triangles[face.link.triangle()];
    link = face.link;
    const auto& k = mesh_.tets[t];
    const int* fv = kFaceVertices[f];
    int side = face.side;
    if (side < 0) {
      side = same_turn(s.v, k[fv[0]], k[fv[1]]) ? 0 : 1;
    } else {
      --open_faces_;
      face.open = false;
    }
    s.sides[std::size_t(side)] = mine;
    return;
  }
  link = face.link;
  if (face.link.is_tet()) mesh_.links[face.link.tet()][face.link.face()] = mine;
  face.open = false;
  --open_faces_;
}

TetId MeshEditor::new_tet() {
  if (!free_tets_.empty()) {
    const TetId t = free_tets_.back();
    free_tets_.pop_back();
    return t;
  }
  const TetId t = TetId(mesh_.tets.size());
  mesh_.resize_tets(mesh_.tets.size() + 1);
  return t;
}

void MeshEditor::add_tets(const Cavity& cavity) {
  created_.clear();
  for (std::size_t i = 0; i < cavity.tets.size(); ++i) {
    const NewTet& n = cavity.tets[i];
    const TetId t = i < cavity.removed_tets.size() ? cavity.removed_tets[i] : new_tet();
    created_.push_back(t);
    mesh_.tets[t] = n.v;
    mesh_.qualities[t] = n.quality;
    mesh_.tet_refs[t] = n.ref;
    mesh_.tet_flags[t] = tet_flag::kAskAll;
    for (const VertexId v : n.v) mesh_.vertex_tets[v] = t;
  }
}

void MeshEditor::link_by_table(const Cavity& cavity) {
  for (std::size_t i = 0; i < created_.size(); ++i)
    for (int f = 0; f < 4; ++f) {
      const auto& v = cavity.tets[i].v;
      const int* fv = kFaceVertices[f];
      Face& face = slot(v[fv[0]], v[fv[1]], v[fv[2]]);
      if (face.open) {
        attach(created_[i], f, face);
      } else {
        face.link = FaceLink::to_tet(created_[i], f);
        face.side = 0;
        face.open = true;
        ++open_faces_;
      }
    }
}

/// The same for the last faces of the new tets: proves that they are the faces of the hole.
void MeshEditor::open_bases(const Cavity& cavity) {
  mark_leaving(cavity);
  std::size_t hull = 0;
  for (TetId t : cavity.removed_tets)
    for (FaceLink link : mesh_.links[t]) hull += stays(link);
  if (hull != cavity.tets.size() || hull != cavity.links.size()) throw InternalError(kNotClosed);
  bases_.resize(hull);
  for (std::size_t i = 0; i < hull; ++i) {
    const TetId t = cavity.links[i][3].tet();
    const int f = cavity.links[i][3].face();
    const auto& k = mesh_.tets[t];
    const auto& v = cavity.tets[i].v;
    const int* fv = kFaceVertices[f];
    if (!(mesh_.tet_flags[t] & kLeaving) || !stays(mesh_.links[t][f]) || k[fv[0]] != v[0] ||
        k[fv[1]] != v[2] || k[fv[2]] != v[1])
      throw InternalError(kNotClosed);
    open_face(t, f, bases_[i]);
  }
}

/// Proves that the faces fit each other, and so that no two new tets have the same base.
void MeshEditor::link_as_told(const Cavity& cavity) {
  for (std::size_t i = 0; i < created_.size(); ++i) {
    const auto& v = cavity.tets[i].v;
    for (int f = 0; f < 3; ++f) {
      const FaceLink other = cavity.links[i][f];
      const auto j = std::size_t(other.tet());
      const int g = other.face();
      if (!other.is_tet() || j >= created_.size() || g == 3) throw InternalError(kNotClosed);
      const auto& w = cavity.tets[j].v;
      if (v[(f + 1) % 3] != w[(g + 2) % 3] || v[(f + 2) % 3] != w[(g + 1) % 3] || v[3] != w[3])
        throw InternalError(kNotClosed);
      mesh_.links[created_[i]][f] = FaceLink::to_tet(created_[j], g);
    }
    attach(created_[i], 3, bases_[i]);
  }
}

void MeshEditor::release(const Cavity& cavity) {
  for (std::size_t i = cavity.tets.size(); i < cavity.removed_tets.size(); ++i) {
    const TetId t = cavity.removed_tets[i];
    mesh_.tets[t] = {kNone, kNone, kNone, kNone};
    mesh_.links[t] = {};
    mesh_.tet_flags[t] = 0;
    free_tets_.push_back(t);
  }
  living_tets_ += std::int64_t(cavity.tets.size()) - std::int64_t(cavity.removed_tets.size());
  for (const VertexId v : cavity.removed_vertices) {
    mesh_.vertex_tets[v] = kNone;
    mesh_.vertex_tags[v] = 0;
    if (reuses_vertices_) free_vertices_.push_back(v);
  }
}

void MeshEditor::clear_table(const Cavity& cavity) {
  // As most faces are of two tets, half of it stays free.
  const std::size_t faces =
      4 * (cavity.removed_tets.size() + cavity.tets.size()) + cavity.triangles.size();
  const std::size_t size = std::bit_ceil(faces + 1);
  if (table_.size() < size) table_.assign(size, {}), epoch_ = 0;
  if (++epoch_ == 0) table_.assign(table_.size(), {}), epoch_ = 1;
  mask_ = size - 1;
}

/// Others add no face that a triangle may have.
bool MeshEditor::is_at_surface(const Cavity& cavity) const {
  const VertexId fresh = cavity.inserts_vertex ? next_vertex() : kNone;
  const auto on_surface = [&](VertexId v) {
    return ((v == fresh ? cavity.vertex.tags : mesh_.vertex_tags[v]) & tag::kSurface) != 0;
  };
  return !cavity.triangles.empty() || std::ranges::any_of(cavity.tets, [&](const NewTet& n) {
    return std::ranges::count_if(n.v, on_surface) > 2;
  });
}

/// Once what leaves is marked.
bool MeshEditor::has_closed_faces(const Cavity& cavity) {
  std::int64_t open = 0;
  const auto use = [&](VertexId a, VertexId b, VertexId c, int most) {
    const int uses = ++slot(a, b, c).uses;
    open += uses == 1 ? 1 : -1;
    return uses <= most;
  };
  const auto use_face = [&](const std::array<VertexId, 4>& v, int f, int most) {
    const int* fv = kFaceVertices[f];
    return use(v[fv[0]], v[fv[1]], v[fv[2]], most);
  };
  for (const TetId t : cavity.removed_tets)
    for (int f = 0; f < 4; ++f)
      if (stays(mesh_.links[t][f]) && !use_face(mesh_.tets[t], f, 1)) return false;
  for (const Triangle& t : cavity.triangles)  // those of interfaces have a tet on both sides
    if (t.is_exterior() && !use(t.v[0], t.v[1], t.v[2], 2)) return false;
  for (const NewTet& n : cavity.tets)
    for (int f = 0; f < 4; ++f)
      if (!use_face(n.v, f, 2)) return false;
  return open == 0;
}

bool MeshEditor::closes(const Cavity& cavity) {
  if (!cavity.links.empty() || !is_at_surface(cavity)) return true;
  clear_table(cavity);
  mark_leaving(cavity);
  const bool closes = has_closed_faces(cavity);
  unmark_leaving(cavity);
  return closes;
}

void MeshEditor::commit(const Cavity& cavity) {
  open_faces_ = 0;
  const bool told = !cavity.links.empty();
  if (told) {
    open_bases(cavity);
  } else {
    clear_table(cavity);
    open_hole(cavity);
  }
  place_vertex(cavity);
  add_triangles(cavity);
  add_tets(cavity);
  told ? link_as_told(cavity) : link_by_table(cavity);
  release(cavity);
  if (open_faces_ != 0) throw InternalError(kNotClosed);
}

void MeshEditor::move(VertexId v, const NewVertex& to, const std::vector<TetId>& tets,
                      const std::vector<float>& qualities) {
  // Smaller changes do not turn a refusal into an acceptance often enough to pay for asking again.
  constexpr float kSwapAgain = 0.03f, kMoveAgain = 0.02f;  // by quality
  constexpr double kLengthChange = 0.05;                   // in wanted sizes
  const bool far = distance(mesh_.points[v], to.point) > kLengthChange * to.size;
  mesh_.points[v] = to.point;
  mesh_.sizes[v] = to.size;
  mesh_.vertex_tags[v] = to.tags;
  mesh_.anchors[v] = to.anchor;
  for (std::size_t i = 0; i < tets.size(); ++i) {
    const TetId t = tets[i];
    const float change = std::abs(mesh_.qualities[t] - qualities[i]);
    std::uint8_t ask = far ? tet_flag::kAskLength | tet_flag::kAskMove : 0;
    if (change > kMoveAgain) ask |= tet_flag::kAskMove;
    if (change > kSwapAgain) ask |= tet_flag::kAskSwap;
    mesh_.qualities[t] = qualities[i];
    mesh_.tet_flags[t] |= ask;
  }
}

}  // namespace cavea
