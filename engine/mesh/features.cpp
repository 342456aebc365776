#include "cavea/mesh/features.h"

#include "cavea/base/atomic.h"
#include "cavea/mesh/surface_edges.h"

namespace cavea {
namespace {

/// The tag of an edge that follows from its triangles.
Tag tag_of(const TetMesh& mesh, SurfaceEdges::Uses uses) {
  Tag tags = uses.size() == 2 ? Tag{0} : tag::kNonManifold;
  const std::int32_t ref = mesh.triangles[SurfaceEdges::decode(uses[0]).triangle].ref;
  for (const std::uint32_t use : uses) {
    const Triangle& s = mesh.triangles[SurfaceEdges::decode(use).triangle];
    if (s.ref != ref) tags |= tag::kReferenceEdge;
    tags |= s.tags & tag::kRequired;
  }
  return tags;
}

void add_tags(TetMesh& mesh, SurfaceEdges::Uses uses, Tag tags) {
  for (const std::uint32_t use : uses) {
    const auto [triangle, k] = SurfaceEdges::decode(use);
    mesh.triangles[triangle].edge_tag[k] |= tags;
  }
}

void tag_by_triangles(TetMesh& mesh, const SurfaceEdges& edges) {
  parallel_for(edges.vertices(), [&](std::size_t a) {
    edges.for_each_at(mesh, VertexId(a), [&](VertexId, SurfaceEdges::Uses uses) {
      add_tags(mesh, uses, tag_of(mesh, uses));
    });
  });
}

/// The tag that the lists ask for each edge of data.
std::vector<Tag> listed_tags(const MeshData& data) {
  std::vector<Tag> tags(data.edges.size(), 0);
  for (const std::int32_t e : data.ridges) tags[e] |= tag::kRidge | tag::kGiven;
  for (const std::int32_t e : data.required_edges) tags[e] |= tag::kRequired;
  for (Tag& t : tags)
    if (t == 0) t = tag::kReferenceEdge;
  return tags;
}

using EdgeEnds = std::array<VertexId, 2>;

EdgeEnds ends(VertexId a, VertexId b) { return {std::min(a, b), std::max(a, b)}; }

/// Those of some vertex pairs that are edges of tets, sorted.
std::vector<EdgeEnds> tet_edges_among(const TetMesh& mesh, std::vector<EdgeEnds> pairs) {
  parallel_sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::vector<char> found(pairs.size(), 0);
  parallel_for(pairs.empty() ? 0 : mesh.tets.size(), [&](std::size_t t) {
    if (!mesh.tet_alive(TetId(t))) return;
    for (const auto& k : kEdgeVertices) {
      const VertexId a = mesh.tets[t][k[0]], b = mesh.tets[t][k[1]];
      const auto at = std::lower_bound(pairs.begin(), pairs.end(), ends(a, b));
      if (at != pairs.end() && *at == ends(a, b))
        std::atomic_ref(found[at - pairs.begin()]).store(1, std::memory_order_relaxed);
    }
  });
  std::vector<EdgeEnds> out;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (found[i]) out.push_back(pairs[i]);
  return out;
}

/// Gives the listed edges of the surface their tags and references; the first listing of an edge
/// names its reference. \returns the required edges that are not on the surface, smaller vertex
/// first. Serial: the lists are short, and their order counts.
std::vector<EdgeEnds> tag_listed(TetMesh& mesh, const SurfaceEdges& edges, const MeshData& data,
                                 const std::vector<VertexId>& new_vertex, BuildSummary& summary) {
  const std::vector<Tag> tags = listed_tags(data);
  std::vector<char> named(mesh.triangles.size() * 3, 0);
  std::vector<EdgeEnds> inside;
  for (std::size_t e = 0; e < data.edges.size(); ++e) {
    const VertexId a = new_vertex[data.edges[e][0]], b = new_vertex[data.edges[e][1]];
    const bool can_be = a != kNone && b != kNone && a != b;
    const auto uses = can_be ? edges.find(mesh, a, b) : SurfaceEdges::Uses{};
    if (uses.empty()) {
      if (can_be && (tags[e] & tag::kRequired))
        inside.push_back(ends(a, b));
      else
        ++summary.dropped_edges;
      continue;
    }
    add_tags(mesh, uses, tags[e]);
    if (named[uses[0]]++ || data.edge_refs.empty()) continue;
    for (const std::uint32_t use : uses) {
      const auto [triangle, k] = SurfaceEdges::decode(use);
      mesh.triangles[triangle].edge_ref[k] = data.edge_refs[e];
    }
  }
  return inside;
}

void tag_inside(TetMesh& mesh, const std::vector<EdgeEnds>& listed, BuildSummary& summary) {
  const std::vector<EdgeEnds> inside = tet_edges_among(mesh, listed);
  for (const EdgeEnds& e : listed)
    if (!std::binary_search(inside.begin(), inside.end(), e)) ++summary.dropped_edges;
  for (const EdgeEnds& e : inside)
    for (const VertexId v : e) mesh.vertex_tags[v] |= tag::kRequired | tag::kOnRequiredEdge;
}

void tag_listed_vertices(TetMesh& mesh, const std::vector<std::int32_t>& list, Tag tags,
                         const std::vector<VertexId>& new_vertex) {
  for (const std::int32_t v : list)
    if (new_vertex[v] != kNone) mesh.vertex_tags[new_vertex[v]] |= tags;
}

void tag_required_tets(TetMesh& mesh, const std::vector<std::int32_t>& list) {
  for (const std::int32_t t : list) {
    mesh.tet_flags[t] |= tet_flag::kRequired;
    for (const VertexId v : mesh.tets[t])
      mesh.vertex_tags[v] |= tag::kRequired | tag::kOnRequiredEdge;
  }
}

}  // namespace

std::vector<Tag> surface_vertex_tags(const TetMesh& mesh) {
  std::vector<Tag> out(mesh.points.size(), 0);
  parallel_for(mesh.triangles.size(), [&](std::size_t i) {
    const Triangle& s = mesh.triangles[i];
    if (!s.alive()) return;
    for (int k = 0; k < 3; ++k) {
      const Tag edges = s.edge_tag[(k + 1) % 3] | s.edge_tag[(k + 2) % 3];
      const Tag tags = tag::kSurface | (edges & tag::kFeature) | (s.tags & tag::kRequired);
      atomic_or(out[s.v[k]], tags);
    }
  });
  return out;
}

void tag_features(TetMesh& mesh, const MeshData& data, const std::vector<VertexId>& new_vertex,
                  BuildSummary& summary) {
  const SurfaceEdges edges(mesh);
  tag_by_triangles(mesh, edges);
  const std::vector<EdgeEnds> inside = tag_listed(mesh, edges, data, new_vertex, summary);
  mesh.vertex_tags = surface_vertex_tags(mesh);
  tag_inside(mesh, inside, summary);
  tag_listed_vertices(mesh, data.corners, tag::kCorner | tag::kGiven, new_vertex);
  tag_listed_vertices(mesh, data.required_vertices, tag::kRequired, new_vertex);
  tag_required_tets(mesh, data.required_tets);
}

}  // namespace cavea
