// How many tets are foreseen, against how many there are, and what is refused for it.
#include "cavea/remesh/forecast.h"

#include "cavea/base/error.h"
#include "remesh/support.h"

namespace cavea::test {
namespace {

/// The forecast for a mesh whose vertices have the law's sizes.
double foreseen(TetMesh mesh, const SizeLaw& law) {
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    mesh.sizes[v] = float(law.field ? law.field(mesh.points[v]) : law.hmax);
  return forecast_tets(mesh, law);
}

std::int64_t found(TetMesh mesh, const SizeField& field, const Options& options) {
  remesh(mesh, field, options);
  expect_sound(mesh);
  return std::int64_t(mesh.tets.size());
}

TEST(Forecast, OfAUniformSizeIsNearTheResult) {
  const TetMesh cube = built(kuhn_cube(2));
  for (const double size : {0.2, 0.1, 0.05}) {
    SCOPED_TRACE(size);
    const double tets = double(found(cube, {}, uniform(size)));
    EXPECT_NEAR(foreseen(cube, {size, size, 1.3, 1, {}}), tets, 0.25 * tets);
  }
}

TEST(Forecast, SeesSizesThatVaryInsideOfCoarseTets) {
  const TetMesh cube = built(kuhn_cube(1));
  const SizeField field = [](const Vec3& p) { return 0.02 + 0.3 * distance(p, {0.3, 0.4, 0.5}); };
  Options options;
  options.hmin = 0.02, options.hmax = 0.5, options.hgrad.reset();
  const SizeLaw law{0.02, 0.5, std::numeric_limits<double>::infinity(), 1, field};
  const double tets = double(found(cube, field, options));
  EXPECT_NEAR(foreseen(cube, law), tets, 0.3 * tets);
}

TEST(Forecast, GrowsAwayFromSmallSizesAtVertices) {
  TetMesh cube = built(kuhn_cube(1));
  std::fill(cube.sizes.begin(), cube.sizes.end(), 0.01f);
  const double graded = forecast_tets(cube, {0.01, 0.5, 1.3, 1, {}});
  const double uniform = forecast_tets(cube, {0.01, 0.01, 1.3, 1, {}});
  EXPECT_LT(graded, 0.05 * uniform);
  EXPECT_LE(graded, most_tets(cube, {0.01, 0.5, 1.3, 1, {}}));
  EXPECT_NEAR(uniform, most_tets(cube, {0.01, 0.01, 1.3, 1, {}}), 1e-6 * uniform);
}

TEST(Forecast, RefusesWhatIsTooLargeAndLeavesTheMesh) {
  const TetMesh cube = built(kuhn_cube(2));
  TetMesh mesh = cube;
  Options options = uniform(0.01);
  options.max_memory = 1000000;
  EXPECT_THROW(remesh(mesh, {}, options), MemoryError);
  expect_same(mesh, cube);
  options = uniform(1e-6);
  options.max_memory = std::numeric_limits<std::int64_t>::max();
  EXPECT_THROW(remesh(mesh, {}, options), MemoryError) << "ids cannot name so many";
  expect_same(mesh, cube);
}

TEST(Forecast, LeavesABudgetToFit) {
  TetMesh mesh = built(kuhn_cube(2));
  Options options = uniform(1e-4);
  options.max_tets = 5000;
  options.max_memory = 10000000;
  remesh(mesh, {}, options);
  EXPECT_LT(mesh.tets.size(), 6000u);
}

}  // namespace
}  // namespace cavea::test
