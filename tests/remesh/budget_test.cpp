// A budget of tets: met within 10%, whatever asks for more; without effect where less is asked for.
#include <algorithm>

#include "cavea/base/error.h"
#include "remesh/support.h"

namespace cavea::test {
namespace {

struct Wish {
  const char* name;
  MeshData data;
  SizeField field;
  Options options;
  std::int64_t most;
};

double graded(const Vec3& p) { return 0.02 + 0.1 * norm(p); }

std::vector<Wish> wishes() {
  Options round;
  round.hausd = 0.0005;
  Options required = uniform(0.05);
  MeshData held = to_data(built(kuhn_cube(4)));
  held.required_triangles = {0, 1, 2, 3, 4, 5, 6, 7};
  return {{"uniform", kuhn_cube(4), {}, uniform(0.04), 15000},
          {"coarsened", kuhn_cube(14), {}, uniform(0.06), 4000},
          {"graded", kuhn_cube(4), graded, {}, 9000},
          {"curved", ball(8), {}, round, 8000},
          {"required", held, {}, required, 5000}};
}

const Target& target_of(const Report& report, const std::string& name) {
  const auto at = std::find_if(report.targets.begin(), report.targets.end(),
                               [&](const Target& t) { return t.name == name; });
  if (at == report.targets.end()) throw std::logic_error("no target " + name);
  return *at;
}

class Budgets : public testing::TestWithParam<std::size_t> {};

TEST_P(Budgets, AreMetWithinATenth) {
  Wish wish = wishes()[GetParam()];
  SCOPED_TRACE(wish.name);
  wish.options.max_tets = wish.most;
  std::vector<TetMesh> results;
  for (const int threads : {1, 3}) {
    wish.options.threads = threads;
    TetMesh& mesh = results.emplace_back(built(wish.data));
    const Report report = remesh(mesh, wish.field, wish.options);
    expect_sound(mesh);
    EXPECT_GE(report.after.quality.worst, 0.1);
    EXPECT_NEAR(double(mesh.tets.size()), double(wish.most), 0.1 * double(wish.most));
    EXPECT_TRUE(target_of(report, "tets").met);
  }
  expect_same(results[0], results[1]);
}

INSTANTIATE_TEST_SUITE_P(All, Budgets, testing::Range<std::size_t>(0, wishes().size()),
                         [](const auto& number) {
                           return std::string(wishes()[number.param].name);
                         });

TEST(Budget, ThatIsNotUsedUpChangesNothing) {
  const TetMesh start = built(kuhn_cube(4));
  TetMesh free = start, bounded = start;
  Options options;
  options.hmin = 0.08;
  remesh(free, graded, options);
  options.max_tets = 10 * std::int64_t(free.tets.size());
  const Report report = remesh(bounded, graded, options);
  expect_same(free, bounded);
  EXPECT_TRUE(report.targets_met());
}

TEST(Budget, ThatCannotHoldTheSurfaceSaysSo) {
  TetMesh mesh = built(ball(8));
  Options options;
  options.hausd = 0.0005;
  options.max_tets = 600;
  const Report report = remesh(mesh, {}, options);
  expect_sound(mesh);
  EXPECT_FALSE(target_of(report, "surface distance").met);
  EXPECT_TRUE(target_of(report, "tets").met);
}

TEST(Budget, IsKeptWithTheSurfaceOfAnEarlierMesh) {
  const TetMesh truth = built(ball(8));
  TetMesh mesh = truth;
  Options options;
  options.hausd = 0.002;
  options.surface = &truth;
  options.max_tets = 4000;
  const Report report = remesh(mesh, {}, options);
  expect_sound(mesh);
  EXPECT_TRUE(target_of(report, "tets").met);
  EXPECT_LT(report.surface_distance, 10 * options.hausd.value());
}

TEST(Budget, ThatCannotBeMetSaysSo) {
  MeshData data = to_data(built(kuhn_cube(6)));
  for (std::size_t t = 0; t < data.triangles.size(); ++t)
    data.required_triangles.push_back(std::int32_t(t));
  TetMesh mesh = built(data);
  Options options;
  options.max_tets = 100;
  const Report report = remesh(mesh, {}, options);
  expect_sound(mesh);
  const Target& tets = target_of(report, "tets");
  EXPECT_FALSE(tets.met);
  EXPECT_EQ(tets.wanted, 100);
  EXPECT_EQ(tets.measured, double(mesh.tets.size()));
}

}  // namespace
}  // namespace cavea::test
