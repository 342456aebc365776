#pragma once
// What remeshing must leave as it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "cavea/mesh/statistics.h"
#include "cavea/mesh/surface_edges.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea::test {

/// Vertices minus edges plus faces minus tets: of the volume, and of its surface with the
/// interfaces between references.
struct Euler {
  std::int64_t volume = 0, surface = 0;
  friend bool operator==(const Euler&, const Euler&) = default;
};

/// The number of different ones among some lists of ids.
template <class Ids>
std::int64_t different(std::vector<Ids> ids) {
  for (Ids& i : ids) std::sort(i.begin(), i.end());
  std::sort(ids.begin(), ids.end());
  return std::unique(ids.begin(), ids.end()) - ids.begin();
}

inline Euler euler(const TetMesh& mesh) {
  using Edge = std::array<VertexId, 2>;
  using Face = std::array<VertexId, 3>;
  std::vector<std::array<VertexId, 1>> vertices, surface_vertices;
  std::vector<Edge> edges, surface_edges;
  std::vector<Face> faces;
  std::int64_t tets = 0, triangles = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (!mesh.tet_alive(TetId(t))) continue;
    const auto& v = mesh.tets[t];
    ++tets;
    for (const VertexId k : v) vertices.push_back({k});
    for (const auto& e : kEdgeVertices) edges.push_back({v[e[0]], v[e[1]]});
    for (const auto& f : kFaceVertices) faces.push_back({v[f[0]], v[f[1]], v[f[2]]});
  }
  for (const Triangle& t : mesh.triangles) {
    if (!t.alive()) continue;
    ++triangles;
    for (std::size_t k = 0; k < 3; ++k) {
      surface_vertices.push_back({t.v[k]});
      surface_edges.push_back({t.v[k], t.v[(k + 1) % 3]});
    }
  }
  return {different(vertices) - different(edges) + different(faces) - tets,
          different(surface_vertices) - different(surface_edges) + triangles};
}

/// Length of all feature edges: a straight curve that is left becomes longer.
inline double feature_length(const TetMesh& mesh) {
  double sum = 0;
  const SurfaceEdges edges(mesh);
  for (std::size_t a = 0; a < edges.vertices(); ++a)
    edges.for_each_at(mesh, VertexId(a), [&](VertexId b, SurfaceEdges::Uses uses) {
      const auto [triangle, k] = SurfaceEdges::decode(uses[0]);
      if (mesh.triangles[triangle].edge_tag[k] & tag::kFeature)
        sum += distance(mesh.points[a], mesh.points[b]);
    });
  return sum;
}

inline std::map<std::int32_t, double> area_of_ref(const TetMesh& mesh) {
  std::map<std::int32_t, double> area;
  for (const Triangle& t : mesh.triangles)
    if (t.alive())
      area[t.ref] += norm(cross(mesh.points[t.v[1]] - mesh.points[t.v[0]],
                                mesh.points[t.v[2]] - mesh.points[t.v[0]])) /
                     2;
  return area;
}

inline void expect_near(const std::map<std::int32_t, double>& a,
                        const std::map<std::int32_t, double>& b, double relative) {
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [ref, value] : a) {
    ASSERT_TRUE(b.count(ref)) << "reference " << ref;
    EXPECT_NEAR(value, b.at(ref), relative * std::abs(value)) << "reference " << ref;
  }
}

/// The topology and references of a mesh, and the places of its fixed vertices.
class Shape {
 public:
  explicit Shape(const TetMesh& mesh)
      : counts_(count(mesh)),
        euler_(euler(mesh)),
        area_(area_of_ref(mesh)),
        feature_length_(feature_length(mesh)) {
    for (std::size_t v = 0; v < mesh.points.size(); ++v)
      if (mesh.vertex_alive(VertexId(v)) && (mesh.vertex_tags[v] & kFixed))
        fixed_.push_back(mesh.points[v]);
    std::sort(fixed_.begin(), fixed_.end(), less);
  }

  /// Whatever the surface is like.
  void expect_topology_of(const TetMesh& mesh) const {
    const Shape now(mesh);
    EXPECT_EQ(now.euler_, euler_);
    EXPECT_EQ(now.counts_.components, counts_.components);
    EXPECT_EQ(now.counts_.boundary_components, counts_.boundary_components);
    EXPECT_EQ(now.counts_.volume_of_ref.size(), counts_.volume_of_ref.size());
    EXPECT_EQ(now.area_.size(), area_.size());
    EXPECT_EQ(now.fixed_, fixed_) << "corners and required vertices";
  }

  /// Where surface and interfaces are made of planes: all of it, but for rounding.
  void expect_polyhedron(const TetMesh& mesh) const {
    constexpr double kRounding = 1e-11;
    expect_topology_of(mesh);
    const Shape now(mesh);
    expect_near(counts_.volume_of_ref, now.counts_.volume_of_ref, kRounding);
    expect_near(area_, now.area_, kRounding);
    EXPECT_NEAR(now.feature_length_, feature_length_, kRounding * feature_length_);
  }

  const Counts& counts() const { return counts_; }

 private:
  static constexpr Tag kFixed = tag::kCorner | tag::kRequired;
  static bool less(const Vec3& a, const Vec3& b) {
    return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
  }

  Counts counts_;
  Euler euler_;
  std::map<std::int32_t, double> area_;
  double feature_length_;
  std::vector<Vec3> fixed_;
};

}  // namespace cavea::test
