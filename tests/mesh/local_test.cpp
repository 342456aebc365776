#include "cavea/mesh/local.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cavea/mesh/build.h"

namespace cavea {
namespace {

/// Tets around an axis, all at its two ends.
TetMesh wheel(int spokes) {
  MeshData data;
  data.vertices = {{0, 0, -1}, {0, 0, 1}};
  for (int i = 0; i < spokes; ++i) {
    const double angle = 2 * std::numbers::pi * i / spokes;
    data.vertices.push_back({std::cos(angle), std::sin(angle), 0});
    data.tets.push_back({0, 1, 2 + i, 2 + (i + 1) % spokes});
  }
  data.tet_refs.assign(data.tets.size(), 1);
  return build(std::move(data)).mesh;
}

std::vector<TetId> sorted_small_ball(const TetMesh& mesh, VertexId v) {
  std::vector<TetId> ball;
  small_ball(mesh, v, ball);
  std::ranges::sort(ball);
  return ball;
}

TEST(SmallBall, HasEachTetOnceHoweverMany) {
  for (const int spokes : {3, 100, 129, 1000}) {
    const TetMesh mesh = wheel(spokes);
    TetMarker marker;
    for (const VertexId v : {0, 1, 2}) {
      Ball ball;
      gather_ball(mesh, v, marker, ball);
      std::ranges::sort(ball.tets);
      EXPECT_EQ(ball.tets.size(), v < 2 ? std::size_t(spokes) : 2);
      EXPECT_EQ(sorted_small_ball(mesh, v), ball.tets) << spokes << " tets, vertex " << v;
    }
  }
}

}  // namespace
}  // namespace cavea
