// What the interfaces of the rounds have blocked is asked in the end, in batches free of conflicts.
#include "cavea/part/residual.h"

#include "remesh/support.h"

namespace cavea::test {
namespace {

/// Parts this small make interfaces of most of the mesh.
constexpr std::int64_t kTetsPerPart = 500;

Options in_small_parts(double size, int threads) {
  Options options = uniform(size, threads);
  options.tets_per_part = kTetsPerPart;
  return options;
}

struct Case {
  std::string name;
  MeshData data;
  double size;
};

std::vector<Case> cases() {
  return {{"cube", kuhn_cube(6), 0.06},
          {"octants", octants(6), 0.07},
          {"cylinder", cylinder(6), 0.12},
          {"frame", frame(), 0.05}};
}

TEST(Residual, LeavesNothingBlocked) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    TetMesh mesh = built(c.data);
    const Report report = remesh(mesh, {}, in_small_parts(c.size, 2));
    expect_sound(mesh);
    expect_good(report);
    EXPECT_GT(report.parts, 8);
    EXPECT_GT(report.residual.before, 0);  // else this proves nothing
    EXPECT_GT(report.residual.batches, 0);
    EXPECT_EQ(report.residual.after, 0);
    EXPECT_EQ(count_blocked(mesh), 0);
    EXPECT_EQ(report.part_of_tet.size(), mesh.tets.size());
  }
}

TEST(Residual, DoesNotDependOnTheNumberOfThreads) {
  TetMesh alone = built(octants(6));
  const Report report = remesh(alone, {}, in_small_parts(0.07, 1));
  EXPECT_GT(report.residual.batches, 1);
  for (const int threads : {2, 3, 8}) {
    SCOPED_TRACE(testing::Message() << threads << " threads");
    TetMesh mesh = built(octants(6));
    const Report other = remesh(mesh, {}, in_small_parts(0.07, threads));
    expect_same(mesh, alone);
    EXPECT_EQ(other.part_of_tet, report.part_of_tet);
  }
}

}  // namespace
}  // namespace cavea::test
