#include "cavea/part/round.h"

#include <iterator>

#include "cavea/base/parallel.h"
#include "cavea/field/gradation.h"
#include "part/support.h"

namespace cavea::test {
namespace {

constexpr double kTolerance = 0.01;

SurfaceModel model_of(TetMesh& mesh) { return {mesh, {kTolerance, 3 * kTolerance, 0.01, 1}}; }

CycleSettings settings() {
  CycleSettings s;
  s.repair_below = 0.2;
  s.sweeps = 2;
  return s;
}

void ask_all(TetMesh& mesh, double low, double high) {
  Random random(2);
  for (float& size : mesh.sizes) size = float(random.between(low, high));
  limit_gradation(mesh, 1.5);
  for (std::uint8_t& flags : mesh.tet_flags) flags |= tet_flag::kAskAll;
}

/// The cycle on each part of a cut, and the parts stitched again.
std::int64_t run_cut(TetMesh& mesh, const SurfaceModel& surface, const Cut& cut) {
  std::vector<Part> parts = extract_parts(mesh, cut.labels, cut.parts);
  std::int64_t changes = 0;
  for (Part& part : parts)
    if (!part.mesh.tets.empty()) {
      changes += run_cycle(part.mesh, surface, settings()).changes;
      expect_sound(part.mesh);
    }
  mesh = stitched(mesh, parts);
  return changes;
}

TEST(Round, KeepsTheInterfaceAndTheDomainHoweverItIsCut) {
  constexpr std::uint64_t kSeed = 43;
  for (const NamedMesh& named : meshes_to_cut()) {
    TetMesh start = classified(named.data);
    const SurfaceModel surface = model_of(start);
    ask_all(start, 0.08, 0.5);
    const Shape shape(start);
    for (const Cut& cut : cuts_of(start, kSeed)) {
      SCOPED_TRACE(testing::Message()
                   << named.name << " cut to " << cut.name << ", seed " << kSeed);
      TetMesh mesh = start;
      const std::int64_t changes = run_cut(mesh, surface, cut);
      expect_sound(mesh);
      shape.expect_polyhedron(mesh);
      EXPECT_EQ(tagged_places(mesh, tag::kWasInterface), shared_places(start, cut.labels));
      if (cut.name == "whole" || cut.name == "slabs") {
        EXPECT_GT(changes, 0);
      }
      if (HasFailure()) return;
    }
  }
}

TEST(Round, LeavesPartsOfOneTetAlone) {
  TetMesh mesh = classified(kuhn_cube(3));
  const SurfaceModel surface = model_of(mesh);
  ask_all(mesh, 0.1, 1);
  const Labels labels = labels_of(mesh, [](std::size_t t, const Vec3&) { return int(t); });
  TetMesh after = mesh;
  EXPECT_EQ(run_cut(after, surface, {"", labels, int(mesh.tets.size())}), 0);
  EXPECT_EQ(Canonical(after).vertices, Canonical(mesh).vertices);
}

/// Large enough for more than one part.
MeshData large(bool references) {
  MeshData data = kuhn_cube(13);
  if (references) set_refs(data, [](const Vec3& c) { return c.x + c.y > 1 ? 4 : 2; });
  return data;
}

TEST(Round, CutsLargeMeshesAndMovesTheInterface) {
  for (const bool references : {false, true}) {
    TetMesh mesh = classified(large(references));
    const SurfaceModel surface = model_of(mesh);
    const Shape shape(mesh);
    std::vector<Place> last;
    for (int round = 0; round < 3; ++round) {
      ask_all(mesh, 0.06, 0.09);
      std::vector<std::int32_t> part_of_tet;
      const RoundResult result = run_round(mesh, surface, settings(), &part_of_tet);
      EXPECT_GT(result.parts, 1);
      EXPECT_GT(result.cycle.changes, 0);
      expect_sound(mesh);
      shape.expect_polyhedron(mesh);
      ASSERT_EQ(part_of_tet.size(), mesh.tets.size());
      EXPECT_EQ(shared_places(mesh, part_of_tet), tagged_places(mesh, tag::kWasInterface));
      const std::vector<Place> now = tagged_places(mesh, tag::kWasInterface);
      std::vector<Place> both;
      std::set_intersection(now.begin(), now.end(), last.begin(), last.end(),
                            std::back_inserter(both));
      EXPECT_LT(double(both.size()), 0.2 * double(now.size())) << "round " << round;
      last = now;
    }
  }
}

TEST(Round, DoesNotDependOnTheNumberOfThreads) {
  TetMesh start = classified(large(true));
  const SurfaceModel surface = model_of(start);
  ask_all(start, 0.05, 0.09);
  const auto run = [&](int threads) {
    TetMesh mesh = start;
    run_in_arena(threads, [&] { run_round(mesh, surface, settings()); });
    return mesh;
  };
  const TetMesh alone = run(1);
  for (const int threads : {2, 3, 8}) {
    SCOPED_TRACE(testing::Message() << threads << " threads");
    expect_same(run(threads), alone);
  }
}

TEST(PartCount, GrowsWithTheMeshAlone) {
  EXPECT_EQ(part_count(0), 1);
  EXPECT_EQ(part_count(1000), 1);
  EXPECT_GE(part_count(200000), 8);
  int last = 1;
  for (std::int64_t tets = 1000; tets < 100000000; tets += tets / 7) {
    EXPECT_GE(part_count(tets), last) << tets;
    last = part_count(tets);
  }
  EXPECT_LT(last, 5000);
}

TEST(PartCount, IsSmallAndEvenWherePartsAreToBeFew) {
  PartSize size;
  size.few = true;
  EXPECT_EQ(part_count(1000, size), 1);
  EXPECT_EQ(part_count(size.one_part, size), 2);
  EXPECT_EQ(part_count(80000, size), 2);
  EXPECT_EQ(part_count(80001, size), 4);
  for (std::int64_t tets = 15000; tets < 3000000; tets += tets / 7) {
    EXPECT_LE(part_count(tets, size), part_count(tets)) << tets;
    EXPECT_LE(part_count(tets, size), int(tets / 40000) + 2) << tets;
    EXPECT_EQ(part_count(tets, size) % 2, 0) << tets;
  }
  size.tets_per_part = 1000;
  EXPECT_EQ(part_count(20000, size), 20);
}

}  // namespace
}  // namespace cavea::test
