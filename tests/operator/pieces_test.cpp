#include "cavea/cavity/pieces.h"

#include <gtest/gtest.h>

namespace cavea::test {
namespace {

/// Two pairs of tets at vertex 0, each joined by a face; the pairs by the vertex alone.
TetMesh two_pairs() {
  TetMesh mesh;
  mesh.resize_vertices(9);
  for (Tag& tags : mesh.vertex_tags) tags = tag::kSurface;
  mesh.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}, {0, 5, 6, 7}, {0, 6, 5, 8}};
  return mesh;
}

Cavity cavity_of(const TetMesh& mesh) {
  Cavity cavity;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    cavity.removed_tets.push_back(TetId(t));
    cavity.tets.push_back({mesh.tets[t]});
  }
  return cavity;
}

TEST(Pieces, AroundEachVertexOfTheSurfaceStayAsMany) {
  TetMesh mesh = two_pairs();
  Cavity cavity = cavity_of(mesh);
  EXPECT_TRUE(keeps_balls(mesh, cavity));
  std::swap(cavity.tets[1], cavity.tets[2]);
  EXPECT_TRUE(keeps_balls(mesh, cavity)) << "whatever their order";
  cavity.tets[1].v = {0, 2, 5, 4};
  EXPECT_FALSE(keeps_balls(mesh, cavity)) << "a tet alone at the vertex";
  cavity = cavity_of(mesh);
  cavity.tets.pop_back(), cavity.tets.pop_back();
  EXPECT_FALSE(keeps_balls(mesh, cavity)) << "a pair less";
  for (Tag& tags : mesh.vertex_tags) tags = 0;
  EXPECT_TRUE(keeps_balls(mesh, cavity)) << "inside, positive volumes prove it";
}

}  // namespace
}  // namespace cavea::test
