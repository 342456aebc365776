#pragma once
// Labels to cut meshes by, and what a mesh is but for its numbering.
#include <algorithm>
#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "cavea/mesh/build.h"
#include "cavea/mesh/compact.h"
#include "cavea/part/extract.h"
#include "cavea/pass/cycle.h"
#include "cavea/surface/features.h"
#include "cavea/surface/surface_model.h"
#include "support/expect.h"
#include "support/meshes.h"
#include "support/shape.h"

namespace cavea::test {

using Labels = std::vector<std::int32_t>;

struct Cut {
  std::string name;
  Labels labels;
  int parts = 1;
};

template <class LabelOf>
Labels labels_of(const TetMesh& mesh, LabelOf&& label_of) {
  Labels labels(mesh.tets.size());
  for (std::size_t t = 0; t < labels.size(); ++t) {
    const auto [a, b, c, d] = mesh.corners(TetId(t));
    labels[t] = label_of(t, (a + b + c + d) * 0.25);
  }
  return labels;
}

/// Ways to cut a mesh in the unit cube, the worst ones too.
inline std::vector<Cut> cuts_of(const TetMesh& mesh, std::uint64_t seed) {
  Random random(seed);
  const int tets = int(mesh.tets.size());
  const auto random_label = [&](int parts) {
    return labels_of(mesh, [&](std::size_t, const Vec3&) { return random.below(parts); });
  };
  return {
      {"whole", Labels(mesh.tets.size(), 0), 1},
      {"slabs", labels_of(mesh, [](std::size_t, const Vec3& c) { return c.x < 0.5 ? 0 : 1; }), 2},
      {"two_at_random", random_label(2), 2},
      {"five_at_random", random_label(5), 5},
      {"a_tet_a_part", labels_of(mesh, [](std::size_t t, const Vec3&) { return int(t); }), tets},
      // Cells of a chessboard touch in edges, those of one colour.
      {"chessboard",
       labels_of(mesh,
                 [](std::size_t, const Vec3& c) {
                   return (int(c.x * 4) + int(c.y * 4) + int(c.z * 4)) % 2;
                 }),
       2},
      // Octants of the cube meet in one vertex.
      {"octants",
       labels_of(mesh,
                 [](std::size_t, const Vec3& c) {
                   return (c.x > 0.5) + 2 * (c.y > 0.5) + 4 * (c.z > 0.5);
                 }),
       8},
      // A third is in no part, here and there or on one side.
      {"idle_at_random",
       labels_of(mesh, [&](std::size_t, const Vec3&) { return random.below(3) - 1; }), 2},
      {"idle_slab", labels_of(mesh, [](std::size_t, const Vec3& c) { return int(c.x * 3) - 1; }),
       2},
      {"empty_parts", labels_of(mesh, [](std::size_t, const Vec3& c) { return c.z < 0.5 ? 1 : 3; }),
       6}};
}

struct NamedMesh {
  std::string name;
  MeshData data;
};

inline std::vector<NamedMesh> meshes_to_cut() {
  MeshData perturbed = kuhn_cube(4), octants = kuhn_cube(4), cells = kuhn_cube(3);
  perturb_inside(perturbed, 0.02, 3);
  set_refs(octants, [](const Vec3& c) { return (c.x > 0.5) + 2 * (c.y > 0.5) + 4 * (c.z > 0.5); });
  set_refs(cells, [](const Vec3& c) { return (int(c.x * 3) + int(c.y * 3) + int(c.z * 3)) % 3; });
  octants.required_tets = {5, 50};
  octants.required_vertices = {7, 30};
  octants.vertex_refs[12] = 9;
  return {{"cube", perturbed},
          {"octants", octants},
          {"cells", cells},
          {"polycube", polycube(4, 0.6, 7)}};
}

inline TetMesh classified(const MeshData& data) {
  TetMesh mesh = build(data).mesh;
  classify_features(mesh, {});
  Random random(1);
  for (float& size : mesh.sizes) size = float(random.between(0.1, 0.4));
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    mesh.tet_flags[t] |= std::uint8_t(random.below(8) << 1);  // some of the asks
  return mesh;
}

/// A mesh after a cycle in place, which has left holes of all kinds.
inline TetMesh with_holes(const MeshData& data, std::uint64_t seed) {
  TetMesh mesh = classified(data);
  const SurfaceModel surface{mesh, {0.01, 0.03, 0.01, 1}};
  Random random(seed);
  for (float& size : mesh.sizes) size = float(random.between(0.2, 0.8));
  for (std::uint8_t& flags : mesh.tet_flags) flags |= tet_flag::kAskAll;
  run_cycle(mesh, surface, {});
  return mesh;
}

/// The parts in the mesh that they came from, without holes.
inline TetMesh stitched(TetMesh mesh, std::vector<Part>& parts) {
  Labels part_of_tet;
  stitch_parts(mesh, parts, part_of_tet);
  compact(mesh);
  return mesh;
}

using Place = std::array<double, 3>;
inline Place place(const TetMesh& mesh, VertexId v) {
  return {mesh.points[v].x, mesh.points[v].y, mesh.points[v].z};
}

/// All there is to know of a mesh but the numbers of its entities and the tags of parts.
struct Canonical {
  static constexpr Tag kOfParts = tag::kFrozen | tag::kWasInterface | tag::kMetInterface;
  using Side = std::tuple<Place, Tag, std::int32_t>;  // vertex, and its opposite edge

  std::vector<std::tuple<Place, float, Tag, std::int32_t, std::int32_t, float, float>> vertices;
  std::vector<std::tuple<std::array<Place, 4>, std::int32_t, std::uint8_t, float>> tets;
  std::vector<std::tuple<std::array<Side, 3>, std::int32_t, std::int32_t, Tag>> triangles;

  explicit Canonical(const TetMesh& m) {
    for (std::size_t v = 0; v < m.points.size(); ++v)
      if (m.vertex_alive(VertexId(v)))
        vertices.emplace_back(place(m, VertexId(v)), m.sizes[v], Tag(m.vertex_tags[v] & ~kOfParts),
                              m.vertex_refs[v], m.anchors[v].facet, m.anchors[v].u, m.anchors[v].v);
    for (std::size_t t = 0; t < m.tets.size(); ++t) {
      if (!m.tet_alive(TetId(t))) continue;
      std::array<Place, 4> corners;
      for (std::size_t k = 0; k < 4; ++k) corners[k] = place(m, m.tets[t][k]);
      std::sort(corners.begin(), corners.end());
      tets.emplace_back(corners, m.tet_refs[t], m.tet_flags[t], m.qualities[t]);
    }
    for (const Triangle& t : m.triangles) {
      if (!t.alive()) continue;
      std::array<Side, 3> sides;
      for (std::size_t k = 0; k < 3; ++k)
        sides[k] = {place(m, t.v[k]), t.edge_tag[k], t.edge_ref[k]};
      std::sort(sides.begin(), sides.end());
      triangles.emplace_back(sides, t.ref, t.patch, Tag(t.tags & ~kOfParts));
    }
    std::sort(vertices.begin(), vertices.end());
    std::sort(tets.begin(), tets.end());
    std::sort(triangles.begin(), triangles.end());
  }
  friend bool operator==(const Canonical&, const Canonical&) = default;
};

/// Places of the vertices that tets of more than one part have.
inline std::vector<Place> shared_places(const TetMesh& mesh, const Labels& labels) {
  constexpr std::int32_t kUnseen = -3;
  Labels seen(mesh.points.size(), kUnseen);
  std::vector<char> shared(mesh.points.size(), 0);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (const VertexId v : mesh.tets[t]) {
      if (seen[v] != kUnseen && seen[v] != labels[t]) shared[v] = 1;
      seen[v] = labels[t];
    }
  std::vector<Place> places;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (shared[v]) places.push_back(place(mesh, VertexId(v)));
  std::sort(places.begin(), places.end());
  return places;
}

inline std::vector<Place> tagged_places(const TetMesh& mesh, Tag tags) {
  std::vector<Place> places;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (mesh.vertex_alive(VertexId(v)) && (mesh.vertex_tags[v] & tags))
      places.push_back(place(mesh, VertexId(v)));
  std::sort(places.begin(), places.end());
  return places;
}

}  // namespace cavea::test
