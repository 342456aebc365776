// Parts of the surface that are nearer to each other than the tolerance, and leave no room for good
// tets, are joined; what is farther apart, given or required is not.
#include <algorithm>
#include <numeric>
#include <string>

#include "cavea/remesh/junctions.h"
#include "operator/stage.h"
#include "remesh/steps.h"
#include "remesh/support.h"

namespace cavea::test {
namespace {

constexpr double kHausd = 0.02;

Options options_of(double size) {
  Options options = uniform(size);
  options.hausd = kHausd;
  return options;
}

std::int64_t joined(const Report& report) {
  std::int64_t n = 0;
  for (const VerdictCount& v : report.verdicts)
    if (v.op == std::string("surface_merge") && v.verdict == std::string("accept")) n += v.count;
  return n;
}

void expect_joined(const MeshData& data, double size) {
  const Report report = report_of(data, options_of(size));
  EXPECT_LT(report.before.quality.worst, 0.3);
  EXPECT_GT(joined(report), 0);
  EXPECT_GE(report.after.quality.worst, 0.3);
  EXPECT_LE(report.surface_distance, kHausd);
  EXPECT_NEAR(report.after.counts.volume, report.before.counts.volume, kHausd);
}

TEST(Joining, RidgesNearerThanTheToleranceLeaveGoodTets) { expect_joined(step(0.3 * kHausd), 0.1); }

TEST(Joining, RidgesThatMeetInATipPartWhereTheyAreFarther) { expect_joined(rising_step(0.1), 0.1); }

TEST(Joining, RidgesFartherFromEachOtherStay) {
  EXPECT_EQ(joined(report_of(step(2.5 * kHausd), options_of(0.1))), 0);
}

/// The ends of the two ridges of a step, and the others at the ends of the body.
void list_ridges(MeshData& data) {
  data.edges = {{3, 9}, {4, 10}};
  data.edge_refs = {0, 0};
  data.ridges = {0, 1};
}

TEST(Joining, GivenRidgesStay) {
  MeshData data = step(0.3 * kHausd);
  list_ridges(data);
  EXPECT_EQ(joined(report_of(data, options_of(0.1))), 0);
}

TEST(Joining, GivenCornersStay) {
  MeshData data = rising_step(0.1);
  data.corners = {3};
  TetMesh mesh = built(data);
  remesh(mesh, {}, options_of(0.1));
  EXPECT_EQ(std::ranges::count(mesh.points, data.vertices[3]), 1);
}

TEST(Joining, LeavesSomeOfEachReference) {
  MeshData data = step(0.3 * kHausd);
  data.triangles = {{3, 9, 10}, {3, 10, 4}};  // the front of the step
  data.triangle_refs = {7, 7};
  data.edges = {{4, 10}};
  data.edge_refs = {3};
  TetMesh mesh = built(data);
  const Report report = remesh(mesh, {}, options_of(0.1));
  expect_sound(mesh);
  EXPECT_GT(joined(report), 0);
  EXPECT_TRUE(area_of_ref(mesh).contains(7));
  EXPECT_TRUE(std::ranges::any_of(mesh.triangles, [](const Triangle& t) {
    return std::ranges::find(t.edge_ref, 3) != t.edge_ref.end();
  }));
}

TEST(Joining, OfInterfacesLeavesThePlanesOfTheBoundary) {
  // A layer thinner than the tolerance, which ends in the boundary.
  MeshData data = mapped(two_halves(4), [](const Vec3& p) {
    return Vec3{p.x <= 0.5 ? p.x * 0.6 * kHausd : 2 * p.x - 1 + (2 - 2 * p.x) * 0.3 * kHausd, p.y,
                p.z};
  });
  TetMesh mesh = built(data);
  const auto volumes = count(mesh).volume_of_ref;
  remesh(mesh, {}, options_of(0.1));
  expect_sound(mesh);
  EXPECT_NEAR(volume(mesh), 1, 1e-9);
  for (const auto& [ref, before] : volumes)
    EXPECT_NEAR(count(mesh).volume_of_ref.at(ref), before, kHausd);
}

TEST(Joining, IsNotDoneWhereFrozen) {
  Freezes collapse, surface, join;
  collapse.collapse = surface.surface = join.join = true;
  Options options = options_of(0.1);
  for (const Freezes& freeze : {collapse, surface, join}) {
    options.freeze = freeze;
    EXPECT_EQ(joined(report_of(step(0.3 * kHausd), options)), 0);
  }
}

TEST(Joining, IsTheSameAtAnyNumberOfThreads) {
  TetMesh first = built(step(0.3 * kHausd));
  remesh(first, {}, options_of(0.05));
  for (const int threads : {1, 2, 3, 8}) {
    Options options = options_of(0.05);
    options.threads = threads;
    TetMesh mesh = built(step(0.3 * kHausd));
    EXPECT_GT(joined(remesh(mesh, {}, options)), 0);
    expect_same(mesh, first);
  }
}

/// Whatever is joined, however far: the mesh stays sound, and raises the worst of what goes.
TEST(Joining, OfAnythingKeepsTheMeshSound) {
  constexpr std::uint64_t kSeed = 29;
  SCOPED_TRACE(testing::Message() << "seed " << kSeed);
  for (const Subject& subject : subjects()) {
    SCOPED_TRACE(subject.name);
    Stage stage(subject.data);
    stage.context.limits.bridges_slits = true;
    std::vector<TetId> tets(stage.mesh.tets.size());
    std::iota(tets.begin(), tets.end(), 0);
    shuffle(tets, kSeed);
    const Euler before = euler(stage.mesh);
    const auto try_all = [&](const std::vector<Junction>& junctions) {
      for (const Junction& j : junctions) {
        const VertexId v = stage.editor.next_vertex();
        if (surface_merge(stage.context, j, 0.9, v, stage.cavity) != Verdict::kAccept) continue;
        stage.editor.commit(stage.cavity);
        return true;
      }
      return false;
    };
    int joined = 0;
    for (const TetId t : tets)
      if (stage.mesh.tet_alive(t) &&
          (try_all(junctions_in_triangles(stage.context, t)) ||
           (stage.mesh.tet_alive(t) && try_all(junctions_of_vertices(stage.mesh, t)))))
        if (++joined % 5 == 0) expect_sound(stage.mesh);
    expect_sound(stage.mesh);
    EXPECT_EQ(euler(stage.mesh), before);
  }
}

}  // namespace
}  // namespace cavea::test
