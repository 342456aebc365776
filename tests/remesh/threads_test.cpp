// The result does not depend on the number of threads.
#include <atomic>
#include <chrono>
#include <thread>

#include "cavea/base/parallel.h"
#include "remesh/support.h"

namespace cavea::test {
namespace {

constexpr int kThreads[] = {2, 3, 8};

void expect_same_at_any_number_of_threads(const MeshData& data, Options options,
                                          std::int64_t least_tets) {
  const TetMesh start = built(data);
  options.threads = 1;
  TetMesh alone = start;
  const Report report = remesh(alone, {}, options);
  expect_sound(alone);
  EXPECT_GE(report.after.counts.tets, least_tets);
  for (const int threads : kThreads) {
    SCOPED_TRACE(testing::Message() << threads << " threads");
    options.threads = threads;
    TetMesh mesh = start;
    const Report other = remesh(mesh, {}, options);
    EXPECT_EQ(other.threads, threads);
    expect_same(mesh, alone);
    EXPECT_EQ(other.part_of_tet, report.part_of_tet);
    EXPECT_EQ(other.surface_distance, report.surface_distance);
  }
}

TEST(Threads, DoNotChangeACube) {
  if (kSanitized)
    expect_same_at_any_number_of_threads(kuhn_cube(4), uniform(0.06), 20000);
  else
    expect_same_at_any_number_of_threads(kuhn_cube(6), uniform(0.031), 140000);
}

TEST(Threads, DoNotChangeABall) { expect_same_at_any_number_of_threads(ball(8), {}, 2000); }

TEST(Threads, DoNotChangeReferences) {
  expect_same_at_any_number_of_threads(octants(6), uniform(kSanitized ? 0.07 : 0.05), 12000);
}

TEST(Threads, DoNotChangeWhatIsFilledWithNeedles) {
  MeshData rods = kuhn_cube(2);
  for (Vec3& p : rods.vertices) p.z *= 10;
  expect_same_at_any_number_of_threads(rods, uniform(kSanitized ? 0.2 : 0.12), 8000);
}

TEST(RunInArena, RunsAsManyThreadsAsAreAskedFor) {
  for (const int threads : {1, 2, 3, 8}) {
    std::atomic<int> inside = 0;
    std::atomic<bool> all = false;
    run_in_arena(threads, [&] {
      parallel_tasks(std::size_t(threads), [&](std::size_t) {
        if (++inside == threads) all = true;
        const auto start = std::chrono::steady_clock::now();
        while (!all && std::chrono::steady_clock::now() - start < std::chrono::seconds(30))
          std::this_thread::yield();
      });
    });
    EXPECT_TRUE(all) << threads << " tasks never ran at the same time";
  }
}

}  // namespace
}  // namespace cavea::test
