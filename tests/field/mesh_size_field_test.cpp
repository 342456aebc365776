// A map of sizes is linear in its tets, continued outside, and the same whoever asks.
#include "cavea/field/mesh_size_field.h"

#include "cavea/base/parallel.h"
#include "cavea/mesh/build.h"
#include "support/expect.h"
#include "support/meshes.h"

namespace cavea::test {
namespace {

double linear(const Vec3& p) { return 1 + 0.3 * p.x + 0.2 * p.y + 0.1 * p.z; }

template <class Size>
TetMesh sized(MeshData data, Size&& size) {
  for (const Vec3& p : data.vertices) data.sizes.push_back(size(p));
  return build(data).mesh;
}

Vec3 random_point(Random& random, double low, double high) {
  return {random.between(low, high), random.between(low, high), random.between(low, high)};
}

Vec3 into_cube(const Vec3& p) {
  return {std::clamp(p.x, 0.0, 1.0), std::clamp(p.y, 0.0, 1.0), std::clamp(p.z, 0.0, 1.0)};
}

constexpr double kFloat = 1e-6;  // sizes are kept as floats

TEST(MeshSizeField, IsLinearInsideAndThatOfTheNearestPlaceOutside) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    MeshData data = kuhn_cube(5);
    perturb_inside(data, 0.02, seed);
    const MeshSizeField field(sized(shuffled(data, seed), linear));
    Random random(seed);
    for (int i = 0; i < 300; ++i) {
      const Vec3 p = random_point(random, -0.5, 1.5);
      EXPECT_NEAR(field(p), linear(into_cube(p)), kFloat);
    }
  }
}

TEST(MeshSizeField, IsThatOfTheVerticesAtTheVertices) {
  const std::uint64_t seed = 7;
  Random random(seed);
  const TetMesh mesh = sized(kuhn_cube(4), [&](const Vec3&) { return random.between(0.1, 10); });
  const MeshSizeField field(mesh);
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    EXPECT_NEAR(field(mesh.points[v]), mesh.sizes[v], kFloat * mesh.sizes[v]) << "seed " << seed;
}

TEST(MeshSizeField, StaysBetweenWhatWasGivenInFlatTetsToo) {
  const std::uint64_t seed = 3;
  Random random(seed);
  MeshData data = kuhn_cube(2);
  // In the planes of four faces of the ball of the vertex in the middle: four tets are flat.
  const Vec3 middle{0.125, 0.125, 0.625};
  *std::find(data.vertices.begin(), data.vertices.end(), Vec3{0.5, 0.5, 0.5}) = middle;
  const MeshSizeField field(sized(data, [&](const Vec3&) { return random.between(1, 2); }));
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = i % 2 ? random_point(random, -0.2, 1.2)
                         : middle + random.unit() * (random_point(random, 0, 1) - middle);
    const double size = field(p);
    EXPECT_GE(size, 1 - kFloat) << "seed " << seed;
    EXPECT_LE(size, 2 + kFloat) << "seed " << seed;
  }
}

TEST(MeshSizeField, AnswersTheSameToAllThreads) {
  const std::uint64_t seed = 11;
  MeshData data = kuhn_cube(8);
  perturb_inside(data, 0.01, seed);
  const TetMesh mesh = sized(data, [](const Vec3& p) { return 0.01 + norm2(p); });
  Random random(seed);
  std::vector<Vec3> places(5000);
  for (Vec3& p : places) p = random_point(random, -0.1, 1.1);
  const auto answers = [&](int threads) {
    std::vector<double> sizes(places.size());
    run_in_arena(threads, [&] {
      const MeshSizeField field(mesh);
      parallel_for(
          places.size(), [&](std::size_t i) { sizes[i] = field(places[i]); }, 7);
    });
    return sizes;
  };
  const std::vector<double> one = answers(1);
  for (const int threads : {2, 5}) EXPECT_TRUE(answers(threads) == one) << threads << " threads";
}

TEST(MeshSizeField, IsASnapshotWithoutHoles) {
  TetMesh mesh = sized(kuhn_cube(2), linear);
  mesh.resize_vertices(mesh.points.size() + 1);
  mesh.resize_tets(mesh.tets.size() + 1);
  const MeshSizeField field(mesh);
  mesh = {};
  EXPECT_NEAR(field({0.3, 0.4, 0.9}), linear({0.3, 0.4, 0.9}), kFloat);
}

}  // namespace
}  // namespace cavea::test
