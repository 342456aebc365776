#include "cavea/part/region.h"

#include <set>

#include "cavea/part/clusters.h"
#include "part/support.h"

namespace cavea::test {
namespace {

/// Layer by layer, by looking at all tets.
TetList layers_by_definition(const TetMesh& mesh, const TetList& tets, int layers) {
  std::set<TetId> in(tets.begin(), tets.end());
  for (int k = 0; k < layers; ++k) {
    std::set<VertexId> vertices;
    for (const TetId t : in) vertices.insert(mesh.tets[t].begin(), mesh.tets[t].end());
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
      for (const VertexId v : mesh.tets[t])
        if (vertices.contains(v)) in.insert(TetId(t));
  }
  return {in.begin(), in.end()};
}

TEST(Layers, AreThoseAroundFewTetsAndMany) {
  constexpr std::uint64_t kSeed = 11;
  const TetMesh mesh = build(kuhn_cube(12)).mesh;
  Random random(kSeed);
  for (const int count : {0, 1, 3, 40, 1500}) {
    std::set<TetId> some;
    while (int(some.size()) < count) some.insert(random.below(int(mesh.tets.size())));
    const TetList tets(some.begin(), some.end());
    for (const int layers : {0, 1, 2, 3}) {
      SCOPED_TRACE(testing::Message() << layers << " around " << count << " tets, seed " << kSeed);
      const TetList expected = layers_by_definition(mesh, tets, layers);
      EXPECT_EQ(with_layers(mesh, tets, layers), expected);
      EXPECT_EQ(with_layers_of_few(mesh, tets, layers), expected);
    }
  }
}

}  // namespace
}  // namespace cavea::test
