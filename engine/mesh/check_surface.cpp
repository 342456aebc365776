#include <vector>

#include "cavea/mesh/features.h"
#include "cavea/mesh/findings.h"
#include "cavea/mesh/surface_edges.h"

namespace cavea {
namespace {

/// In a part the triangles of an edge or vertex at the interface are not all there.
bool is_frozen(const TetMesh& mesh, VertexId v) { return mesh.vertex_tags[v] & tag::kFrozen; }

void inspect_tags(const TetMesh& mesh, VertexId a, VertexId b, SurfaceEdges::Uses uses,
                  Findings& findings) {
  const auto [first, k0] = SurfaceEdges::decode(uses[0]);
  const Triangle& s0 = mesh.triangles[first];
  bool refs_differ = false;
  for (const std::uint32_t use : uses) {
    const auto [triangle, k] = SurfaceEdges::decode(use);
    const Triangle& s = mesh.triangles[triangle];
    refs_differ = refs_differ || s.ref != s0.ref;
    if (s.edge_tag[k] != s0.edge_tag[k0])
      findings.add("edge ({}, {}): triangles {} and {} tag it differently", a, b, first, triangle);
    if (s.edge_ref[k] != s0.edge_ref[k0])
      findings.add("edge ({}, {}): triangles {} and {} give it different references", a, b, first,
                   triangle);
  }
  if (refs_differ && !(s0.edge_tag[k0] & tag::kReferenceEdge))
    findings.add("edge ({}, {}): lies between references and is not tagged so", a, b);
}

void inspect_manifold(const TetMesh& mesh, VertexId a, VertexId b, SurfaceEdges::Uses uses,
                      Findings& findings) {
  if (is_frozen(mesh, a) && is_frozen(mesh, b)) return;
  const auto [triangle, k] = SurfaceEdges::decode(uses[0]);
  const bool tagged = mesh.triangles[triangle].edge_tag[k] & tag::kNonManifold;
  if (tagged != (uses.size() != 2))
    findings.add("edge ({}, {}): has {} triangles and is {}tagged as non-manifold", a, b,
                 uses.size(), tagged ? "" : "not ");
}

VertexId third_vertex(const TetMesh& mesh, std::uint32_t use) {
  const auto [triangle, k] = SurfaceEdges::decode(use);
  return mesh.triangles[triangle].v[k];
}

void inspect_doubles(const TetMesh& mesh, VertexId a, VertexId b, SurfaceEdges::Uses uses,
                     Findings& findings) {
  for (std::size_t i = 0; i < uses.size(); ++i)
    for (std::size_t j = i + 1; j < uses.size(); ++j) {
      const VertexId c = third_vertex(mesh, uses[i]);
      // Each pair of twins is met at their three edges: count it at the one of smallest vertices.
      if (c == third_vertex(mesh, uses[j]) && c > b)
        findings.add("triangles {} and {}: lie on the same three vertices ({}, {}, {})",
                     SurfaceEdges::decode(uses[i]).triangle, SurfaceEdges::decode(uses[j]).triangle,
                     a, b, c);
    }
}

CheckResult inspect_edges(const TetMesh& mesh) {
  const SurfaceEdges edges(mesh);
  return inspect_all(edges.vertices(), [&](std::size_t v, Findings& findings) {
    const VertexId a = VertexId(v);
    edges.for_each_at(mesh, a, [&](VertexId b, SurfaceEdges::Uses uses) {
      inspect_tags(mesh, a, b, uses, findings);
      inspect_manifold(mesh, a, b, uses, findings);
      inspect_doubles(mesh, a, b, uses, findings);
    });
  });
}

/// Tags of a vertex that say that it is on something. A vertex may be required of itself.
constexpr Tag kOnSomething = tag::kSurface | tag::kOnCurve;

const char* name_of(Tag bit) {
  switch (bit) {
    case tag::kSurface:
      return "on the surface";
    case tag::kRidge:
      return "on a ridge";
    case tag::kReferenceEdge:
      return "on a reference edge";
    case tag::kNonManifold:
      return "on a non-manifold edge";
    default:
      return "required";
  }
}

void inspect_vertex(const TetMesh& mesh, VertexId v, Tag expected, Findings& findings) {
  const Tag has = mesh.vertex_tags[v];
  for (const Tag bit :
       {tag::kSurface, tag::kRidge, tag::kReferenceEdge, tag::kNonManifold, tag::kRequired}) {
    if ((expected & bit) && !(has & bit))
      findings.add("vertex {}: is {} and is not tagged so", v, name_of(bit));
    if ((has & bit & kOnSomething) && !(expected & bit) && !is_frozen(mesh, v))
      findings.add("vertex {}: is tagged as {} and is not", v, name_of(bit));
  }
}

}  // namespace

CheckResult check_surface(const TetMesh& mesh) {
  Findings findings;
  findings.add(inspect_edges(mesh));
  const std::vector<Tag> expected = surface_vertex_tags(mesh);
  findings.add(inspect_all(mesh.points.size(), [&](std::size_t v, Findings& f) {
    if (mesh.vertex_alive(VertexId(v))) inspect_vertex(mesh, VertexId(v), expected[v], f);
  }));
  return findings.result();
}

}  // namespace cavea
