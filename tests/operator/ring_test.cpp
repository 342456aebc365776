// The edge swap's triangulation of the ring against all there are.
#include "operator/stage.h"
#include "support/shells.h"

namespace cavea::test {
namespace {

using Ring = std::vector<VertexId>;

/// Worse quality of the tets that p and q make with a triangle of the ring; 0 if one is inverted.
double worse_of_two(const OperatorContext& c, VertexId p, VertexId q,
                    const std::array<VertexId, 3>& t) {
  const auto [i, j, k] = t;
  const auto positive = [&](VertexId u, VertexId v, VertexId w, VertexId x) {
    return certainly_positive(c.point(u), c.point(v), c.point(w), c.point(x));
  };
  if (!positive(p, i, j, k) || !positive(q, i, k, j)) return 0;
  return std::min(c.quality(p, i, j, k), c.quality(q, i, k, j));
}

/// The largest worst quality over all triangulations of a polygon: the triangle on its last side
/// has each other vertex as its apex in turn.
double best_of_all(const OperatorContext& c, VertexId p, VertexId q, const Ring& polygon) {
  if (polygon.size() < 3) return 1;
  double best = 0;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const Ring left(polygon.begin(), polygon.begin() + std::ptrdiff_t(k) + 1);
    const Ring right(polygon.begin() + std::ptrdiff_t(k), polygon.end());
    const double here = worse_of_two(c, p, q, {polygon.front(), polygon[k], polygon.back()});
    best =
        std::max(best, std::min({here, best_of_all(c, p, q, left), best_of_all(c, p, q, right)}));
  }
  return best;
}

class RingOptimum : public testing::TestWithParam<int> {};

TEST_P(RingOptimum, IsTheBestOfAllTriangulations) {
  const int n = GetParam();
  const auto seed = std::uint64_t(100 + n);
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  Random random(seed);
  int accepted = 0, refused = 0;
  for (int shell = 0; shell < 300; ++shell) {
    const MeshData data = random_shell(n, random);
    if (data.tets.empty()) continue;
    Stage stage(data);
    ASSERT_TRUE(stage.find_edge(0, 1));
    const OperatorContext& c = stage.context;
    const double best = best_of_all(c, c.shell.p, c.shell.q, c.shell.ring);
    const double before =
        *std::min_element(stage.mesh.qualities.begin(), stage.mesh.qualities.end());
    if (stage.swap_edge() != Verdict::kAccept) {
      EXPECT_LE(best, std::max(kFlat, before * kQualityGain)) << "shell " << shell;
      ++refused;
      continue;
    }
    double worst = 1;
    for (const NewTet& t : stage.cavity.tets) worst = std::min(worst, double(t.quality));
    EXPECT_EQ(float(worst), float(best)) << "shell " << shell;
    EXPECT_EQ(stage.cavity.tets.size(), std::size_t(2 * (n - 2)));
    stage.editor.commit(stage.cavity);
    expect_sound(stage.mesh);
    ++accepted;
  }
  EXPECT_GT(accepted, 5);
  EXPECT_GT(refused, 0);
}

INSTANTIATE_TEST_SUITE_P(Vertices, RingOptimum, testing::Range(3, 8));

}  // namespace
}  // namespace cavea::test
