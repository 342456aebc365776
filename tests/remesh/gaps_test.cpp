// Random bodies of boxes, with slits and walls far thinner than the edges: nothing is glued, folded
// or cut off, and no volume is lost.
#include "cavea/surface/crossings.h"
#include "remesh/support.h"

namespace cavea::test {
namespace {

constexpr int kCells = 5;

/// Places of the grid's planes along one axis: one random layer of cells is thin.
std::vector<double> planes(Random& random, int thin, double width) {
  std::vector<double> at{0};
  for (int i = 0; i < kCells; ++i)
    at.push_back(at.back() + (i == thin ? width : random.between(0.15, 0.3)));
  return at;
}

/// Random boxes in a grid with one thin layer along each axis: of these cells most are empty
/// (slits), or most are full and their neighbours empty (walls).
MeshData random_boxes(std::uint64_t seed) {
  Random random(seed);
  const bool walls = seed % 2;
  int thin[3] = {0, 0, 0};
  for (int& t : thin) t = 1 + random.below(kCells - 2);
  MeshData data = kuhn_grid(kCells, [&](int i, int j, int k) {
    const bool in_thin = i == thin[0] || j == thin[1] || k == thin[2];
    return random.unit() < (in_thin == walls ? 0.9 : walls ? 0.4 : 0.15) || i + j + k == 0;
  });
  std::array<std::vector<double>, 3> at;
  for (int axis = 0; axis < 3; ++axis) at[axis] = planes(random, thin[axis], 0.004);
  const auto cell = [](double x) { return std::size_t(std::lround(x * kCells)); };
  return mapped(data, [&](const Vec3& p) {
    return Vec3{at[0][cell(p.x)], at[1][cell(p.y)], at[2][cell(p.z)]};
  });
}

void expect_kept(const MeshData& data, const Options& options) {
  TetMesh start = built(data), mesh = start;
  ASSERT_TRUE(find_crossings(start).empty());
  const Report report = remesh(mesh, {}, options);
  expect_sound(mesh);
  EXPECT_TRUE(find_crossings(mesh).empty());
  classify_features(start, {});
  Shape(start).expect_polyhedron(mesh);
  EXPECT_NEAR(volume(mesh), volume(start), 1e-12 * volume(start));
  EXPECT_LE(report.surface_distance, 1e-9);
}

TEST(Gaps, OfRandomBoxesStayOpen) {
  for (std::uint64_t seed = 1; seed <= (kSanitized ? 3 : 10); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    expect_kept(random_boxes(seed), uniform(seed % 3 ? 0.15 : 0.4));
  }
}

/// Layers of four materials, of which two are 20 and 40 times as wide as thick.
MeshData layers(std::uint64_t seed) {
  constexpr std::array<double, 5> kAt = {0, 0.5, 0.6, 1.1, 1.15};
  MeshData data = kuhn_cube(4);
  set_refs(data, [](const Vec3& c) { return 1 + int(4 * c.z); });
  return mapped(shuffled(data, seed), [&](const Vec3& p) {
    return Vec3{2 * p.x, 2 * p.y, kAt[std::size_t(std::lround(4 * p.z))]};
  });
}

TEST(Gaps, ThinLayersAreMeshedWell) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    TetMesh start = built(layers(seed)), mesh = start;
    const Report report = remesh(mesh, {}, {});
    expect_sound(mesh);
    expect_good(report, {.worst = 0.3, .conform = 90});
    EXPECT_TRUE(report.stubborn.empty());
    classify_features(start, {});
    Shape(start).expect_polyhedron(mesh);
  }
}

/// A cube on which a smaller one stands, with vertices of its own, the whole turned so that the
/// planes in which they touch are known to rounding only.
MeshData cubes_in_contact(double angle) {
  MeshData data = kuhn_cube(4);
  const MeshData other = kuhn_cube(3);
  const auto shift = std::int32_t(data.vertices.size());
  for (const Vec3& p : other.vertices) data.vertices.push_back(0.6 * p + Vec3{1, 0.17, 0.23});
  data.vertex_refs.resize(data.vertices.size());
  for (auto t : other.tets) {
    for (auto& v : t) v += shift;
    data.tets.push_back(t);
  }
  data.tet_refs.resize(data.tets.size(), 2);
  const double c = std::cos(angle), s = std::sin(angle);
  return mapped(data, [&](const Vec3& p) {
    const double x = c * p.x - s * p.y, y = s * p.x + c * p.y;
    return Vec3{x, c * y - s * p.z, s * y + c * p.z};
  });
}

/// What touches is neither a wall of no thickness nor a gap that sizes must resolve.
TEST(Gaps, BodiesInContactNeedNoSmallSizes) {
  for (const double angle : {0.0, 0.3, 1.1})
    for (const bool faceted : {false, true}) {
      SCOPED_TRACE(testing::Message() << "angle " << angle << ", faceted " << faceted);
      Options options;
      options.faceted = faceted;
      TetMesh mesh = built(cubes_in_contact(angle));
      const Report report = remesh(mesh, {}, options);
      expect_sound(mesh);
      EXPECT_LE(report.after.counts.tets, 10 * report.before.counts.tets);
      EXPECT_GE(report.after.quality.worst, 0.3);
      EXPECT_NEAR(report.after.counts.volume, report.before.counts.volume, 1e-12);
      EXPECT_TRUE(find_crossings(mesh).empty());
    }
}

/// Two plates, joined at one edge, with a thin and bent slit between them.
MeshData bent_slit(std::uint64_t seed, double gap) {
  Random random(seed);
  const double a = random.between(1, 5), b = random.between(1, 5), h = random.between(0.02, 0.1);
  MeshData data = kuhn_grid(6, [](int i, int j, int k) { return k != 3 || (i == 0 && j < 2); });
  return mapped(data, [&](const Vec3& p) {
    const double layer = std::round(6 * p.z);
    const double z = layer <= 3 ? layer / 6 : 0.5 + gap + (layer - 4) / 6;
    return Vec3{p.x, p.y, z + h * std::sin(a * p.x) * std::cos(b * p.y)};
  });
}

TEST(Gaps, ThatAreBentStayOpen) {
  for (std::uint64_t seed = 1; seed <= (kSanitized ? 2 : 6); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    TetMesh start = built(bent_slit(seed, seed % 2 ? 0.003 : 0.01)), mesh = start;
    Options options;
    options.hausd = 0.01;
    options.hmin = 0.08;
    options.faceted = seed % 3 == 0;
    const Report report = remesh(mesh, {}, options);
    expect_sound(mesh);
    EXPECT_TRUE(find_crossings(mesh).empty());
    EXPECT_EQ(euler(mesh), euler(start));
    EXPECT_EQ(report.after.counts.components, 1);
    EXPECT_LE(report.surface_distance, report.hausd);
  }
}

}  // namespace
}  // namespace cavea::test
