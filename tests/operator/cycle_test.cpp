#include "cavea/pass/cycle.h"

#include "cavea/base/error.h"
#include "cavea/field/gradation.h"
#include "operator/stage.h"

namespace cavea::test {
namespace {

CycleSettings settings() {
  CycleSettings s;
  s.repair_below = 0.2;
  s.sweeps = 3;
  return s;
}

void ask_all(TetMesh& mesh) {
  for (std::uint8_t& flags : mesh.tet_flags) flags |= tet_flag::kAskAll;
}

MeshData random_subject(Random& random, std::uint64_t seed) {
  const int n = 2 + random.below(3);
  const bool whole = random.unit() < 0.5;
  MeshData data = whole ? kuhn_cube(n) : polycube(n, 0.7, seed);
  // Inside the unit cube a polycube may have its surface, which is to stay plane.
  if (whole && random.unit() < 0.5)
    perturb_inside(data, 0.1 / n, seed);
  else
    set_refs(data, [&](const Vec3& c) { return int(c.x * n) % 2 + 2 * (int(c.y * n) % 2); });
  return shuffled(data, seed);
}

TEST(Cycle, KeepsRandomMeshesSound) {
  const std::uint64_t seeds = kSanitized ? 8 : 40;
  std::int64_t changes = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    Stage stage(random_subject(random, seed));
    for (float& size : stage.mesh.sizes) size = float(random.between(0.08, 0.6));
    limit_gradation(stage.mesh, 1.5);
    ask_all(stage.mesh);
    const Shape shape(stage.mesh);
    changes += run_cycle(stage.mesh, stage.surface, settings()).changes;
    expect_sound(stage.mesh);
    shape.expect_polyhedron(stage.mesh);
    if (HasFailure()) break;
  }
  EXPECT_GT(changes, 0);
}

TEST(Cycle, IsAFunctionOfTheMesh) {
  const auto run = [] {
    Stage stage(subjects()[2].data, 0.2);
    ask_all(stage.mesh);
    run_cycle(stage.mesh, stage.surface, settings());
    return stage.mesh;
  };
  expect_same(run(), run());
}

TEST(Cycle, LeavesAloneWhatIsNotAskedFor) {
  Stage stage(kuhn_cube(3), 0.1);
  for (std::uint8_t& flags : stage.mesh.tet_flags) flags = 0;
  EXPECT_EQ(run_cycle(stage.mesh, stage.surface, settings()).changes, 0);
}

TEST(Cycle, CollapsesFromTheBallAsFromTheEdge) {
  // One vertex and edge, asked alone and among the edges of its ball.
  Stage stage(subjects()[0].data);
  stage.context.limits.short_edge = kLargeSize;
  std::int64_t accepted = 0;
  for (const auto& [p, q] : edges_of(stage.mesh)) {
    ASSERT_TRUE(stage.find_edge(p, q));
    const Verdict alone = stage.collapse();
    const std::size_t tets = stage.cavity.tets.size();
    gather_ball(stage.mesh, p, stage.context.marker, stage.context.ball);
    EXPECT_EQ(edge_collapse_of_ball(stage.context, false, stage.cavity), alone);
    EXPECT_EQ(stage.cavity.tets.size(), tets);
    accepted += alone == Verdict::kAccept;
  }
  EXPECT_GT(accepted, 0);
}

TEST(Cycle, StopsAtTheMostTetsAndSaysSo) {
  Stage stage(kuhn_cube(3), 0.05);
  ask_all(stage.mesh);
  CycleSettings s = settings();
  s.most_tets = 1000;
  EXPECT_TRUE(run_cycle(stage.mesh, stage.surface, s).full);
  // The last split may add as many tets as its edge has.
  EXPECT_NEAR(double(count(stage.mesh).tets), 1000, 300);
}

TEST(Cycle, CountsEveryVerdict) {
  Stage stage(kuhn_cube(3), 0.15);
  ask_all(stage.mesh);
  const CycleResult result = run_cycle(stage.mesh, stage.surface, settings());
  std::int64_t accepted = 0;
  for (int o = 0; o < kOperators; ++o) accepted += result.verdicts.accepted(Operator(o));
  EXPECT_EQ(accepted, result.changes);
  EXPECT_GT(result.verdicts.accepted(Operator::kEdgeSplit), 0);
}

TEST(Cycle, StopsWhenCancelled) {
  Stage stage(kuhn_cube(2));
  const std::atomic<bool> cancel = true;
  CycleSettings s = settings();
  s.cancel = &cancel;
  EXPECT_THROW(run_cycle(stage.mesh, stage.surface, s), Cancelled);
}

}  // namespace
}  // namespace cavea::test
