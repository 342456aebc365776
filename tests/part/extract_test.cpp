#include "cavea/part/extract.h"

#include "cavea/base/parallel.h"
#include "part/support.h"

namespace cavea::test {
namespace {

constexpr std::uint64_t kSeed = 41;

/// Calls f(mesh, cut) for each mesh and each way to cut it.
template <class F>
void for_each_cut(F&& f) {
  for (const NamedMesh& named : meshes_to_cut()) {
    const TetMesh mesh = classified(named.data);
    for (const Cut& cut : cuts_of(mesh, kSeed)) {
      SCOPED_TRACE(testing::Message()
                   << named.name << " cut to " << cut.name << ", seed " << kSeed);
      f(mesh, cut);
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(Parts, AreSoundMeshesWithTheirInterfaceFrozen) {
  for_each_cut([](const TetMesh& mesh, const Cut& cut) {
    const std::vector<Part> parts = extract_parts(mesh, cut.labels, cut.parts);
    ASSERT_EQ(parts.size(), std::size_t(cut.parts));
    const std::vector<Place> shared = shared_places(mesh, cut.labels);
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const Part& part = parts[p];
      EXPECT_EQ(part.mesh.tets.size(),
                std::size_t(std::count(cut.labels.begin(), cut.labels.end(), std::int32_t(p))));
      expect_sound(part.mesh);
      EXPECT_EQ(part.mesh.points.size(), part.own_vertices.size() + part.shared_vertices.size());
      for (std::size_t v = 0; v < part.mesh.points.size(); ++v) {
        const bool frozen = part.mesh.vertex_tags[v] & tag::kFrozen;
        EXPECT_EQ(frozen, v >= part.own_vertices.size());
        EXPECT_EQ(frozen,
                  std::binary_search(shared.begin(), shared.end(), place(part.mesh, VertexId(v))));
      }
    }
  });
}

TEST(Parts, StitchedAsTheyAreGiveTheMeshBack) {
  for_each_cut([](const TetMesh& mesh, const Cut& cut) {
    std::vector<Part> parts = extract_parts(mesh, cut.labels, cut.parts);
    const TetMesh back = stitched(mesh, parts);
    expect_sound(back);
    EXPECT_TRUE(Canonical(back) == Canonical(mesh));
    EXPECT_EQ(tagged_places(back, tag::kWasInterface), shared_places(mesh, cut.labels));
    EXPECT_EQ(tagged_places(back, tag::kFrozen), std::vector<Place>());
  });
}

TEST(Parts, AreMeshesThatCanBeCutThemselves) {
  for_each_cut([](const TetMesh& mesh, const Cut& cut) {
    std::vector<Part> parts = extract_parts(mesh, cut.labels, cut.parts);
    Random random(kSeed);
    for (Part& part : parts) {
      const Canonical before(part.mesh);
      const std::vector<Place> frozen = tagged_places(part.mesh, tag::kFrozen);
      const Labels labels =
          labels_of(part.mesh, [&](std::size_t, const Vec3&) { return random.below(4) - 1; });
      std::vector<Part> inner = extract_parts(part.mesh, labels, 3);
      for (const Part& p : inner) expect_sound(p.mesh);
      Labels part_of_tet;
      stitch_parts(part.mesh, inner, part_of_tet);
      expect_sound(part.mesh);
      EXPECT_TRUE(Canonical(part.mesh) == before);
      EXPECT_EQ(tagged_places(part.mesh, tag::kFrozen), frozen);
    }
    const TetMesh back = stitched(mesh, parts);
    expect_sound(back);
    EXPECT_TRUE(Canonical(back) == Canonical(mesh));
    EXPECT_EQ(tagged_places(back, tag::kFrozen), std::vector<Place>());
  });
}

TEST(Parts, CanBeCutAgainAnotherWay) {
  TetMesh mesh = classified(meshes_to_cut()[1].data);
  const Canonical before(mesh);
  Random random(kSeed);
  for (int round = 0; round < 5; ++round) {
    const Labels labels =
        labels_of(mesh, [&](std::size_t, const Vec3&) { return random.below(7); });
    const std::vector<Place> shared = shared_places(mesh, labels);
    std::vector<Part> parts = extract_parts(mesh, labels, 7);
    mesh = stitched(mesh, parts);
    expect_sound(mesh);
    EXPECT_TRUE(Canonical(mesh) == before) << "round " << round << ", seed " << kSeed;
    EXPECT_EQ(tagged_places(mesh, tag::kWasInterface), shared);
  }
}

TEST(Parts, DoNotDependOnTheNumberOfThreads) {
  const TetMesh mesh = classified(kuhn_cube(8));
  const Labels labels =
      labels_of(mesh, [](std::size_t, const Vec3& c) { return int(c.x * 4) + 4 * int(c.y * 4); });
  const auto run = [&](int threads) {
    TetMesh back;
    run_in_arena(threads, [&] {
      std::vector<Part> parts = extract_parts(mesh, labels, 16);
      back = stitched(mesh, parts);
    });
    return back;
  };
  const TetMesh alone = run(1);
  for (const int threads : {2, 3, 8}) expect_same(run(threads), alone);
}

}  // namespace
}  // namespace cavea::test
