#include "cavea/mesh/check.h"

#include <algorithm>
#include <vector>

#include "cavea/base/parallel.h"
#include "cavea/mesh/faces.h"
#include "cavea/mesh/findings.h"

namespace cavea {
namespace {

// The stored float of a quality of magnitude at most 1 is off by 6e-8; the rest is for vertices
// that have been permuted since, which changes the last digits of the double.
constexpr double kQualityTolerance = 1e-6;

bool in_range(std::int32_t i, std::size_t n) { return i >= 0 && std::size_t(i) < n; }

bool living_vertex(const TetMesh& mesh, VertexId v) {
  return in_range(v, mesh.points.size()) && mesh.vertex_alive(v);
}
bool living_tet(const TetMesh& mesh, TetId t) {
  return in_range(t, mesh.tets.size()) && mesh.tet_alive(t);
}
bool living_triangle(const TetMesh& mesh, TriangleId i) {
  return in_range(i, mesh.triangles.size()) && mesh.triangles[i].alive();
}
bool valid(const TetMesh& mesh, FaceLink link) {
  if (link.is_tet()) return living_tet(mesh, link.tet());
  if (link.is_triangle()) return living_triangle(mesh, link.triangle());
  return true;
}

void inspect_vertex_indices(const TetMesh& mesh, VertexId v, Findings& findings) {
  if (!mesh.vertex_alive(v)) return;
  const TetId t = mesh.vertex_tets[v];
  if (!living_tet(mesh, t) || mesh.local_index(t, v) == 4)
    findings.add("vertex {}: its tet {} does not have it", v, t);
  if (!is_finite(mesh.points[v])) findings.add("vertex {}: its coordinates are not finite", v);
  if (!(mesh.sizes[v] >= 0)) findings.add("vertex {}: its size is {}", v, mesh.sizes[v]);
}

void inspect_tet_indices(const TetMesh& mesh, TetId t, Findings& findings) {
  if (!mesh.tet_alive(t)) return;
  const auto& v = mesh.tets[t];
  for (int i = 0; i < 4; ++i) {
    if (!living_vertex(mesh, v[i])) findings.add("tet {}: vertex {} does not exist", t, v[i]);
    for (int j = i + 1; j < 4; ++j)
      if (v[i] == v[j]) findings.add("tet {}: has vertex {} twice", t, v[i]);
    if (!valid(mesh, mesh.links[t][i]))
      findings.add("tet {}: what face {} links to does not exist", t, i);
  }
}

void inspect_triangle_indices(const TetMesh& mesh, TriangleId i, Findings& findings) {
  const Triangle& s = mesh.triangles[i];
  if (!s.alive()) return;
  for (int k = 0; k < 3; ++k) {
    if (!living_vertex(mesh, s.v[k]))
      findings.add("triangle {}: vertex {} does not exist", i, s.v[k]);
    if (s.v[k] == s.v[(k + 1) % 3]) findings.add("triangle {}: has vertex {} twice", i, s.v[k]);
  }
  for (int side = 0; side < 2; ++side)
    if (s.sides[side].is_triangle() || !valid(mesh, s.sides[side]))
      findings.add("triangle {}: the tet of side {} does not exist", i, side);
}

void inspect_neighbour(const TetMesh& mesh, TetId t, int f, Findings& findings) {
  const FaceLink behind = mesh.links[t][f];
  const TetId u = behind.tet();
  if (mesh.links[u][behind.face()] != FaceLink::to_tet(t, f)) {
    findings.add("tet {}: face {} links to tet {}, which does not link back", t, f, u);
    return;
  }
  const auto here = face_vertices(mesh.tets[t], f);
  const auto there = face_vertices(mesh.tets[u], behind.face());
  if (sorted(here) != sorted(there))
    findings.add("tet {}: face {} links to a face of tet {} with other vertices", t, f, u);
  else if (is_odd(here) == is_odd(there))
    findings.add("tet {}: tet {} lies on the same side of face {}", t, u, f);
  if (mesh.tet_refs[t] != mesh.tet_refs[u])
    findings.add("tet {}: no triangle between it and tet {} of another reference", t, u);
}

void inspect_links(const TetMesh& mesh, TetId t, Findings& findings) {
  for (int f = 0; f < 4; ++f) {
    const FaceLink link = mesh.links[t][f];
    if (link.is_unset()) {
      findings.add("tet {}: nothing behind face {}", t, f);
    } else if (link.is_tet()) {
      inspect_neighbour(mesh, t, f, findings);
    } else if (link.is_triangle()) {
      const auto& sides = mesh.triangles[link.triangle()].sides;
      if (std::count(sides.begin(), sides.end(), FaceLink::to_tet(t, f)) != 1)
        findings.add("tet {}: face {} links to triangle {}, which is not on it", t, f,
                     link.triangle());
    }
  }
}

void inspect_shape(const TetMesh& mesh, TetId t, const CheckOptions& options, Findings& findings) {
  const auto [a, b, c, d] = mesh.corners(t);
  const int sign = orientation(a, b, c, d);
  if (sign < 0) findings.add("tet {}: its volume is negative", t);
  if (sign == 0 && !options.allow_flat_tets) findings.add("tet {}: its volume is zero", t);
  const double quality = tet_quality(a, b, c, d);
  if (!(std::abs(quality - double(mesh.qualities[t])) <= kQualityTolerance))
    findings.add("tet {}: its stored quality is {} instead of {}", t, mesh.qualities[t], quality);
}

/// A side of triangle i, whose vertices are s.v as seen from outside of sides[0].
void inspect_side(const TetMesh& mesh, TriangleId i, int side, Findings& findings) {
  const Triangle& s = mesh.triangles[i];
  const FaceLink face = s.sides[side];
  if (!face.is_tet()) return;
  if (mesh.links[face.tet()][face.face()] != FaceLink::to_triangle(i))
    findings.add("triangle {}: tet {} of side {} does not link back", i, face.tet(), side);
  const auto v = face_vertices(mesh.tets[face.tet()], face.face());
  if (sorted(v) != sorted(s.v))
    findings.add("triangle {}: the face of tet {} of side {} has other vertices", i, face.tet(),
                 side);
  else if ((is_odd(v) == is_odd(s.v)) != (side == 0))
    findings.add("triangle {}: its vertices turn the wrong way round for side {}", i, side);
}

}  // namespace

std::string CheckResult::message() const {
  if (sound()) return "sound";
  std::string out = fmt::format("{} violation{}: ", count, count == 1 ? "" : "s");
  for (std::size_t i = 0; i < examples.size(); ++i) out += (i ? "; " : "") + examples[i];
  if (count > std::int64_t(examples.size())) out += "; ...";
  return out;
}

CheckResult check_arrays(const TetMesh& mesh) {
  Findings findings;
  const auto same = [&](std::size_t got, std::size_t wanted, const char* what) {
    if (got != wanted) findings.add("{} {} for {}", got, what, wanted);
  };
  const std::size_t n = mesh.points.size(), m = mesh.tets.size();
  same(mesh.sizes.size(), n, "sizes of vertices");
  same(mesh.vertex_tags.size(), n, "tags of vertices");
  same(mesh.vertex_refs.size(), n, "references of vertices");
  same(mesh.vertex_tets.size(), n, "tets of vertices");
  same(mesh.anchors.size(), n, "anchors of vertices");
  same(mesh.links.size(), m, "links of tets");
  same(mesh.qualities.size(), m, "qualities of tets");
  same(mesh.tet_refs.size(), m, "references of tets");
  same(mesh.tet_flags.size(), m, "flags of tets");
  return findings.result();
}

CheckResult check_indices(const TetMesh& mesh) {
  Findings findings;
  findings.add(inspect_all(mesh.points.size(), [&](std::size_t v, Findings& f) {
    inspect_vertex_indices(mesh, VertexId(v), f);
  }));
  findings.add(inspect_all(mesh.tets.size(), [&](std::size_t t, Findings& f) {
    inspect_tet_indices(mesh, TetId(t), f);
  }));
  findings.add(inspect_all(mesh.triangles.size(), [&](std::size_t i, Findings& f) {
    inspect_triangle_indices(mesh, TriangleId(i), f);
  }));
  for (const GivenNormal& given : mesh.normals)
    if (!living_vertex(mesh, given.vertex))
      findings.add("vertex {}: has a normal and is none", given.vertex);
  return findings.result();
}

CheckResult check_tets(const TetMesh& mesh, const CheckOptions& options) {
  return inspect_all(mesh.tets.size(), [&](std::size_t t, Findings& findings) {
    if (!mesh.tet_alive(TetId(t))) return;
    inspect_links(mesh, TetId(t), findings);
    inspect_shape(mesh, TetId(t), options, findings);
  });
}

CheckResult check_cuts(const TetMesh& mesh) {
  // Serial: only parts have cuts, few for their size.
  std::vector<std::int32_t> cuts;
  const auto take = [&](FaceLink link) {
    if (link.is_cut()) cuts.push_back(link.cut());
  };
  for (TetId t = 0; t < TetId(mesh.tets.size()); ++t)
    if (mesh.tet_alive(t)) std::for_each(mesh.links[t].begin(), mesh.links[t].end(), take);
  for (const Triangle& s : mesh.triangles)
    if (s.alive()) std::for_each(s.sides.begin(), s.sides.end(), take);
  std::sort(cuts.begin(), cuts.end());
  Findings findings;
  for (std::size_t i = 1; i < cuts.size(); ++i)
    if (cuts[i] == cuts[i - 1]) findings.add("cut {} is used twice", cuts[i]);
  return findings.result();
}

CheckResult check_triangles(const TetMesh& mesh) {
  return inspect_all(mesh.triangles.size(), [&](std::size_t i, Findings& findings) {
    const Triangle& s = mesh.triangles[i];
    if (!s.alive()) return;
    for (int side = 0; side < 2; ++side) inspect_side(mesh, TriangleId(i), side, findings);
    const FaceLink a = s.sides[0], b = s.sides[1];
    const bool elsewhere =
        a.is_cut() || (s.tags & tag::kFrozen);  // its first side: in another part
    if (!a.is_tet() && !(elsewhere && b.is_tet())) findings.add("triangle {}: is on no tet", i);
    const bool internal = s.tags & tag::kInternal;
    if (a.is_tet() && b.is_tet()) {
      const bool alike = mesh.tet_refs[a.tet()] == mesh.tet_refs[b.tet()];
      if (alike && !internal)
        findings.add("triangle {}: lies between tets {} and {} of one reference", i, a.tet(),
                     b.tet());
      if (internal && !alike)
        findings.add("triangle {}: is tagged as internal and lies between references", i);
    } else if (internal && !elsewhere) {
      findings.add("triangle {}: is tagged as internal and lies on the boundary", i);
    }
  });
}

CheckResult check(const TetMesh& mesh, const CheckOptions& options) {
  for (const auto stage : {check_arrays, check_indices})
    if (const CheckResult found = stage(mesh); !found.sound()) return found;
  Findings findings;
  findings.add(check_tets(mesh, options));
  findings.add(check_cuts(mesh));
  findings.add(check_triangles(mesh));
  findings.add(check_surface(mesh));
  return findings.result();
}

}  // namespace cavea
