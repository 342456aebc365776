#include "cavea/operator/vertex_insert.h"

#include <algorithm>
#include <limits>

#include "cavea/base/error.h"
#include "cavea/cavity/mesh_editor.h"
#include "cavea/mesh/build.h"
#include "cavea/mesh/compact.h"
#include "support/expect.h"
#include "support/meshes.h"
#include "support/shape.h"

namespace cavea::test {
namespace {

constexpr double kFar = std::numeric_limits<double>::max();
const Box kEverywhere{{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}};

TEST(IdMap, RemembersNumbersUntilItIsCleared) {
  constexpr std::uint64_t kSeed = 5;
  Random random(kSeed);
  IdMap map;
  for (int again = 0; again < 50; ++again) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", run " << again);
    std::vector<int> numbers(500, IdMap::kNew);
    for (int k = 0; k < 200; ++k) {
      const int id = random.below(500);
      EXPECT_EQ(map[id], numbers[std::size_t(id)]);
      map[id] = numbers[std::size_t(id)] = random.below(3) - 1;
    }
    for (int id = 0; id < 500; ++id) EXPECT_EQ(map.at(id), numbers[std::size_t(id)]);
    map.clear();
    EXPECT_EQ(map.at(3), IdMap::kNew);
  }
}

/// Inserts points at random in the unit cube, walking from random vertices.
struct Insertions {
  int done = 0, frozen = 0;

  Insertions(TetMesh& mesh, const Box& reach, float size, int points, std::uint64_t seed) {
    Random random(seed);
    MeshEditor editor(mesh);
    VertexInsert insert(mesh, reach);
    Cavity cavity;
    for (int k = 0; k < points; ++k) {
      NewVertex x;
      x.point = {random.unit(), random.unit(), random.unit()};
      x.size = size;
      const TetId t = insert.locate(VertexId(random.below(int(mesh.points.size()))), x.point);
      if (t == kNone) continue;
      const auto [a, b, c, d] = mesh.corners(t);
      EXPECT_GE(volume6(x.point, b, c, d), 0);
      EXPECT_GE(volume6(a, b, x.point, d), 0);
      const Verdict v = insert(x, editor.next_vertex(), t, cavity);
      frozen += v == Verdict::kFrozen;
      if (v != Verdict::kAccept) continue;
      editor.commit(cavity);
      ++done;
    }
  }
};

TEST(VertexInsert, KeepsTheMeshAndTheDomain) {
  constexpr std::uint64_t kSeed = 11;
  MeshData octants = kuhn_cube(4), flat = cube_with_flat_tets(5, false);
  set_refs(octants, [](const Vec3& c) { return (c.x > 0.5) + 2 * (c.y > 0.5); });
  for (const MeshData& data : {kuhn_cube(1), kuhn_cube(4), octants, flat}) {
    SCOPED_TRACE(testing::Message() << data.tets.size() << " tets, seed " << kSeed);
    TetMesh mesh = build(data).mesh;
    const Euler before = euler(mesh);
    EXPECT_GT(Insertions(mesh, kEverywhere, 0.05F, 2000, kSeed).done, 300);
    expect_sound(mesh);
    EXPECT_NEAR(volume(mesh), 1, 1e-12);
    EXPECT_EQ(euler(mesh), before);
  }
}

/// Points at random that keep apart make slivers, but few.
TEST(VertexInsert, TellsLinksThatTheEditorProves) {
  const auto commit_changed = [](auto&& change) {
    TetMesh mesh = build(kuhn_cube(2)).mesh;
    MeshEditor editor(mesh);
    VertexInsert insert(mesh, kEverywhere);
    Cavity cavity;
    NewVertex x;
    x.point = {0.31, 0.27, 0.22};
    x.size = 0.01f;
    const TetId t = insert.locate(0, x.point);
    ASSERT_NE(t, kNone);
    ASSERT_EQ(insert(x, editor.next_vertex(), t, cavity), Verdict::kAccept);
    ASSERT_EQ(cavity.links.size(), cavity.tets.size());
    change(cavity);
    editor.commit(cavity);
  };
  EXPECT_NO_THROW(commit_changed([](Cavity&) {}));
  EXPECT_THROW(commit_changed([](Cavity& c) { c.tets.pop_back(); }), InternalError);
  EXPECT_THROW(commit_changed([](Cavity& c) { c.removed_tets.pop_back(); }), InternalError);
  EXPECT_THROW(commit_changed([](Cavity& c) { std::swap(c.tets[0].v[0], c.tets[0].v[1]); }),
               InternalError);
  EXPECT_THROW(commit_changed([](Cavity& c) { std::swap(c.tets[0], c.tets[1]); }), InternalError);
  EXPECT_THROW(commit_changed([](Cavity& c) { std::swap(c.links[0][0], c.links[0][1]); }),
               InternalError);
  EXPECT_THROW(commit_changed([](Cavity& c) {
                 c.tets[1] = c.tets[0];
                 c.links[1] = c.links[0];
               }),
               InternalError);
}

TEST(DelaunayCavity, RestoresAllThatItHasLeftOut) {
  constexpr std::uint64_t kSeed = 12;
  // So much that most cavities lose tets.
  constexpr double kMuch = 0.3;
  Random random(kSeed);
  const TetMesh mesh = build(kuhn_cube(4)).mesh;
  const VertexInsert search(mesh, kEverywhere);
  DelaunayCavity hole(mesh);
  const auto closed = [](TriangleId) { return false; };
  int smaller = 0;
  for (int k = 0; k < 100; ++k) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", point " << k);
    const Vec3 p{random.unit(), random.unit(), random.unit()};
    const TetId t = search.locate(VertexId(random.below(int(mesh.points.size()))), p);
    if (t == kNone) continue;
    const auto all_may = [](TetId, int) { return Verdict::kAccept; };
    ASSERT_EQ(hole.grow(p, {&t, 1}, all_may), Verdict::kAccept);
    const std::vector<TetId> grown = hole.tets();
    Cavity first, second;
    bool all = false;
    const bool kept = hole.shrink_once(p, kMuch, closed, first, all);
    if (!kept || all) continue;
    ++smaller;
    const std::vector<TetId> left = hole.tets();
    EXPECT_LT(left.size(), grown.size());
    for (const TetId g : grown)
      EXPECT_EQ(hole.contains(g), std::ranges::find(left, g) != left.end());
    hole.restore();
    EXPECT_EQ(hole.tets(), grown);
    EXPECT_TRUE(std::ranges::all_of(grown, [&](TetId g) { return hole.contains(g); }));
    EXPECT_TRUE(hole.shrink_once(p, kMuch, closed, second, all));
    EXPECT_EQ(hole.tets(), left);
    ASSERT_EQ(second.tets.size(), first.tets.size());
    for (std::size_t i = 0; i < first.tets.size(); ++i)
      EXPECT_EQ(second.tets[i].v, first.tets[i].v);
  }
  EXPECT_GT(smaller, 10);
}

TEST(VertexInsert, MakesGoodTets) {
  TetMesh mesh = build(kuhn_cube(3)).mesh;
  Insertions(mesh, kEverywhere, 0.1F, 20000, 3);
  compact(mesh);
  EXPECT_GT(quality_statistics(mesh).mean, 0.58);
}

/// Each vertex inside of a grid of 6^3 cells is asked for, from a place beside it.
int insert_beside_all(TetMesh& mesh, float size) {
  constexpr std::uint64_t kSeed = 13;
  SCOPED_TRACE(testing::Message() << "seed " << kSeed);
  Random random(kSeed);
  MeshEditor editor(mesh);
  VertexInsert insert(mesh, kEverywhere);
  Cavity cavity;
  int done = 0;
  const auto n = VertexId(mesh.points.size());
  for (VertexId v = 0; v < n; ++v) {
    if (!mesh.vertex_alive(v) || (mesh.vertex_tags[v] & tag::kSurface)) continue;
    NewVertex x;
    x.point = mesh.points[v] + 0.02 * Vec3{random.unit(), random.unit(), random.unit()};
    x.size = size;
    const TetId t = insert.locate(v, x.point);
    if (t == kNone || insert(x, editor.next_vertex(), t, cavity) != Verdict::kAccept) continue;
    editor.commit(cavity);
    EXPECT_TRUE(insert.is_gone(v));
    ++done;
  }
  return done;
}

TEST(VertexInsert, TakesThePlaceOfWhatIsReplaceableAlone) {
  const TetMesh before = build(kuhn_cube(6)).mesh;
  TetMesh mesh = before;
  EXPECT_EQ(insert_beside_all(mesh, 0.2F), 0);
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (!(mesh.vertex_tags[v] & tag::kSurface)) mesh.vertex_tags[v] |= tag::kReplaceable;
  EXPECT_GT(insert_beside_all(mesh, 0.2F), 80);  // of 125
  expect_sound(mesh);
  compact(mesh);
  EXPECT_EQ(mesh.points.size(), before.points.size());
  EXPECT_NEAR(volume(mesh), 1, 1e-12);
  EXPECT_EQ(euler(mesh), euler(before));
}

TEST(VertexInsert, TakesThePlaceOfSeveral) {
  TetMesh mesh = build(kuhn_cube(6)).mesh;
  const std::size_t before = mesh.points.size();
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (!(mesh.vertex_tags[v] & tag::kSurface)) mesh.vertex_tags[v] |= tag::kReplaceable;
  MeshEditor editor(mesh);
  VertexInsert insert(mesh, kEverywhere);
  Cavity cavity;
  NewVertex x;
  x.point = {0.58, 0.58, 0.58};  // in the middle of a cell, 0.14 from its eight vertices
  x.size = 0.25F;                // 0.175 around it is to be free
  const TetId t = insert.locate(0, x.point);
  ASSERT_EQ(insert(x, editor.next_vertex(), t, cavity), Verdict::kAccept);
  editor.commit(cavity);
  expect_sound(mesh);
  compact(mesh);
  EXPECT_EQ(mesh.points.size(), before - 7);
  EXPECT_NEAR(volume(mesh), 1, 1e-12);
}

TEST(VertexInsert, LeavesWhatIsRequired) {
  MeshData data = kuhn_cube(4);
  for (std::int32_t t = 0; t < std::int32_t(data.tets.size()); t += 7)
    data.required_tets.push_back(t);
  TetMesh mesh = build(data).mesh;
  const TetMesh before = mesh;
  EXPECT_GT(Insertions(mesh, kEverywhere, 0.03F, 4000, 1).done, 10);
  expect_sound(mesh);
  for (const std::int32_t t : data.required_tets) EXPECT_EQ(mesh.tets[t], before.tets[t]);
}

TEST(VertexInsert, ChangesNothingOutOfReach) {
  TetMesh mesh = build(kuhn_cube(8)).mesh;
  const TetMesh before = mesh;
  const Box reach{{0.2, 0.2, 0.2}, {0.8, 0.8, 0.8}};
  const Insertions result(mesh, reach, 0.03F, 5000, 2);
  EXPECT_GT(result.done, 50);
  EXPECT_GT(result.frozen, 0);
  expect_sound(mesh);
  for (std::size_t t = 0; t < before.tets.size(); ++t) {
    bool inside = true;
    for (const VertexId v : before.tets[t]) inside &= reach.contains(before.points[v]);
    if (!inside) {
      EXPECT_EQ(mesh.tets[t], before.tets[t]);
    }
  }
}

}  // namespace
}  // namespace cavea::test
