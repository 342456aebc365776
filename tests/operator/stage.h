#pragma once
// A mesh made ready for the operators, and ways to ask them for all its edges, faces and vertices.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "cavea/cavity/mesh_editor.h"
#include "cavea/mesh/build.h"
#include "cavea/operator/context.h"
#include "cavea/operator/edge_collapse.h"
#include "cavea/operator/edge_split.h"
#include "cavea/operator/edge_star.h"
#include "cavea/operator/edge_swap.h"
#include "cavea/operator/face_swap.h"
#include "cavea/operator/reconnect.h"
#include "cavea/operator/relocate.h"
#include "cavea/surface/features.h"
#include "support/expect.h"
#include "support/meshes.h"
#include "support/shape.h"

namespace cavea::test {

/// Small against the cells of the meshes here, large against rounding.
inline constexpr double kTolerance = 0.02;
/// Larger than any of them: with it no edge is too long.
inline constexpr double kLargeSize = 100;

inline TetMesh classified(const MeshData& data, const BuildOptions& options) {
  TetMesh mesh = build(data, options).mesh;
  classify_features(mesh, {});
  return mesh;
}

/// A mesh with its ideal surface, an editor and a cavity; wanted sizes are the same everywhere.
struct Stage {
  explicit Stage(const MeshData& data, double size = kLargeSize, const BuildOptions& options = {})
      : mesh(classified(data, options)),
        surface(mesh, {kTolerance, 3 * kTolerance, size / 10, size}),
        editor(mesh),
        context(mesh, surface) {
    mesh.sizes.assign(mesh.points.size(), float(size));
  }

  /// Gathers the shell of an edge into the context; false if it stands no longer.
  bool find_edge(VertexId p, VertexId q) {
    if (!mesh.vertex_alive(p) || !mesh.vertex_alive(q)) return false;
    gather_ball(mesh, p, context.marker, context.ball);
    for (const TetId t : context.ball.tets)
      if (const int j = mesh.local_index(t, q); j < 4) {
        gather_shell(mesh, t, mesh.local_index(t, p), j, context.shell);
        return true;
      }
    return false;
  }

  Verdict split() { return edge_split(context, editor.next_vertex(), cavity); }
  Verdict collapse(bool quality_gain = false) {
    return edge_collapse(context, quality_gain, cavity);
  }
  Verdict swap_edge() { return edge_swap(context, cavity); }

  TetMesh mesh;
  SurfaceModel surface;
  MeshEditor editor;
  OperatorContext context;
  Cavity cavity;
};

/// A mesh to try things on, and whether its surface is made of planes.
struct Subject {
  std::string name;
  MeshData data;
  bool polyhedral = true;
};

inline std::vector<Subject> subjects() {
  const auto perturbed = [](MeshData data, double amplitude) {
    perturb_inside(data, amplitude, 5);
    return data;
  };
  const auto with_refs = [](MeshData data, auto&& ref_of) {
    set_refs(data, ref_of);
    return data;
  };
  const auto octants = [](const Vec3& c) {
    return 1 + (c.x > 0.5) + 2 * (c.y > 0.5) + 4 * (c.z > 0.5);
  };
  return {{"cube", perturbed(kuhn_cube(4), 0.02)},
          {"halves", with_refs(kuhn_cube(4), [](const Vec3& c) { return c.x < 0.5 ? 7 : 3; })},
          {"octants", with_refs(kuhn_cube(4), octants)},
          {"polycube", polycube(4, 0.6, 11)},
          {"shuffled", shuffled(kuhn_cube(3), 3)},
          {"ball", ball(4), false}};
}

using Edge = std::array<VertexId, 2>;

inline std::vector<Edge> edges_of(const TetMesh& mesh) {
  std::vector<Edge> edges;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (!mesh.tet_alive(TetId(t))) continue;
    for (const auto& e : kEdgeVertices) {
      const auto [a, b] = std::minmax(mesh.tets[t][e[0]], mesh.tets[t][e[1]]);
      edges.push_back({a, b});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

template <class T>
void shuffle(std::vector<T>& items, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t i = items.size(); i > 1; --i)
    std::swap(items[i - 1], items[std::size_t(random.below(std::int32_t(i)))]);
}

}  // namespace cavea::test
