#include "cavea/vdb/grid.h"

#include <openvdb/openvdb.h>

#include <numbers>

#include "cavea/base/error.h"
#include "cavea/base/parallel.h"
#include "cavea/mesh/build.h"
#include "cavea/vdb/sample_grids.h"
#include "io/files.h"

namespace cavea::test {
namespace {

using openvdb::Coord;

constexpr Vec3 kCenter{0.5, 0.5, 0.5};

double sphere(const Vec3& p) { return distance(p, kCenter) - 0.3; }

std::filesystem::path write_sphere(const Folder& folder, int voxels) {
  GridSettings settings;
  settings.voxels = voxels;
  write_sample_grid(folder / "sphere.vdb", {sphere, {{0, 0, 0}, {1, 1, 1}}, 1}, settings);
  return folder / "sphere.vdb";
}

TEST(GridOfASphere, IsItsDistanceInTheBand) {
  const Folder folder;
  const Grid grid(write_sphere(folder, 50), {});
  EXPECT_NEAR(grid.voxel(), 0.02, 1e-12);
  EXPECT_FALSE(grid.is_open());
  EXPECT_LT(grid.bounds().low.x, 0.2);
  EXPECT_GT(grid.bounds().low.x, 0.1);
  Random random(1);
  // Trilinear values are off by at most an eighth of voxel squared times the sum of curvatures.
  const double most = 0.02 * 0.02 / 8 * 3 / 0.25;
  for (int k = 0; k < 1000; ++k) {
    const Vec3 way =
        normalized({random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)});
    const double height = random.between(-0.02, 0.02);
    const Vec3 p = kCenter + way * (0.3 + height);
    EXPECT_NEAR(grid.value(p), height, most);
    EXPECT_NEAR(dot(grid.gradient(p), way), 1, 0.01);
  }
  EXPECT_NEAR(grid.value(kCenter), -0.06, 1e-6) << "half the band's width, inside";
  EXPECT_NEAR(grid.value({3, 3, 3}), 0.06, 1e-6) << "and outside";
}

TEST(GridOfASphere, HasZerosAllOverIt) {
  const Folder folder;
  const Grid grid(write_sphere(folder, 50), {});
  std::array<int, 8> in_octant{};
  for (const OrientedPoint& zero : grid.zeros()) {
    EXPECT_LT(std::abs(sphere(zero.place)), 0.002);
    EXPECT_GT(dot(zero.normal, normalized(zero.place - kCenter)), 0.99);
    ++in_octant[(zero.place.x > 0.5) + 2 * (zero.place.y > 0.5) + 4 * (zero.place.z > 0.5)];
  }
  // Of area 0.14 each, in blocks of sides of 0.04.
  for (const int count : in_octant) EXPECT_GT(count, 0.14 / (0.04 * 0.04));
}

TEST(Grid, TakesTheIsovalue) {
  const Folder folder;
  const Grid grid(write_sphere(folder, 50), {"", 0.03});
  EXPECT_NEAR(grid.value(kCenter + Vec3{0.33, 0, 0}), 0, 0.002);
  EXPECT_THROW(Grid(folder / "sphere.vdb", {"", NAN}), OptionError);
}

TEST(Grid, ThatReachesTheBoxIsOpen) {
  const Folder folder;
  const auto plane = [](const Vec3& p) { return p.x + 0.3 * p.y - 0.6; };
  write_sample_grid(folder / "plane.vdb", {plane, {{0, 0, 0}, {1, 1, 1}}, 1.1}, {});
  const Grid grid(folder / "plane.vdb", {});
  EXPECT_TRUE(grid.is_open());
  EXPECT_NEAR(grid.bounds().high.y, 1, 1e-9);
  const Vec3 slope = grid.gradient({0.45, 0.5, 1});
  EXPECT_NEAR(slope.z, 0, 1e-6) << "nothing of what is beyond";
  EXPECT_NEAR(slope.x, 1, 1e-4);
}

template <class GridType>
typename GridType::Ptr make_ball(double background, double radius) {
  auto grid = GridType::create(typename GridType::ValueType(background));
  const openvdb::CoordBBox box(Coord(0), Coord(19));
  for (auto at = box.begin(); at; ++at) {
    const double value = ((*at).asVec3d() - openvdb::Vec3d(9.5)).length() - radius;
    using Value = typename GridType::ValueType;
    if (std::abs(value) < background)
      grid->tree().setValueOn(*at, Value(value));
    else
      grid->tree().setValueOff(*at, Value(value < 0 ? -background : background));
  }
  return grid;
}

class OddGrid : public testing::Test {
 protected:
  OddGrid() { openvdb::initialize(); }

  std::filesystem::path write(const openvdb::GridPtrVec& grids) const {
    openvdb::io::File(file_.string()).write(grids);
    return file_;
  }
  void expect_refused(const GridChoice& choice, const std::vector<std::string>& named) const {
    try {
      Grid(file_, choice);
      ADD_FAILURE() << "not refused: " << named[0];
    } catch (const InputError& e) {
      for (const std::string& word : named)
        EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find(file_.string()), std::string::npos) << e.what();
    }
  }

  const Folder folder_;
  const std::filesystem::path file_ = folder_ / "odd.vdb";
};

TEST_F(OddGrid, IsOneOfSeveralByItsName) {
  const auto balls = make_ball<openvdb::DoubleGrid>(3, 6);
  balls->setName("balls");
  const auto speed = openvdb::Vec3SGrid::create();
  speed->setName("speed");
  write({balls, speed});
  EXPECT_NEAR(Grid(file_, {"balls", {}}).value({9.5, 9.5, 15.5}), 0, 0.2);
  expect_refused({}, {"balls", "speed"});
  expect_refused({"other", {}}, {"'other'", "balls", "speed"});
  expect_refused({"speed", {}}, {"vec3s"});
}

TEST_F(OddGrid, OfIntegersIsRefused) {
  write({openvdb::Int32Grid::create(1)});
  expect_refused({}, {"int32"});
}

TEST_F(OddGrid, WithoutActiveVoxelsIsRefused) {
  write({openvdb::FloatGrid::create(1)});
  expect_refused({}, {"no active voxels"});
}

TEST_F(OddGrid, WithAValueThatIsNoNumberIsRefused) {
  const auto ball = make_ball<openvdb::FloatGrid>(3, 6);
  ball->tree().setValueOn(Coord(3, 4, 10), std::numeric_limits<float>::quiet_NaN());
  write({ball});
  expect_refused({}, {"(3, 4, 10)"});
}

TEST_F(OddGrid, ThatIsNowhereTheIsovalueIsRefusedWithItsRange) {
  write({make_ball<openvdb::FloatGrid>(3, 6)});
  expect_refused({"", 5}, {"nowhere 5", "from -3 to 3"});
}

TEST_F(OddGrid, OfNoGridFileIsRefused) {
  expect_refused({}, {"cannot be read"});
  folder_.put("odd.vdb", "MeshVersionFormatted 2\n");
  expect_refused({}, {"not a VDB file"});
  write({make_ball<openvdb::FloatGrid>(3, 6)});
  const std::string whole = content_of(file_);
  Random random(2);
  for (int k = 0; k < 50; ++k) {
    const std::size_t length = std::size_t(random.below(std::int32_t(whole.size() - 16)));
    SCOPED_TRACE("cut after " + std::to_string(length));
    folder_.put("odd.vdb", whole.substr(0, length));
    expect_refused({}, {"cannot be read"});
  }
}

TEST_F(OddGrid, OfFogIsFullInside) {
  const auto fog = openvdb::FloatGrid::create(0);
  fog->setGridClass(openvdb::GRID_FOG_VOLUME);
  fog->fill(openvdb::CoordBBox(Coord(0), Coord(31)), 1.f, true);  // a single tile
  const Grid grid(write({fog}), {});
  EXPECT_LT(grid.value({15, 15, 15}), 0);
  EXPECT_GT(grid.value({40, 15, 15}), 0);
  EXPECT_NEAR(grid.value({31.5, 15, 15}), 0, 1e-12);
  EXPECT_FALSE(grid.is_open());
  std::array<double, 2> range{15, 15};
  for (const OrientedPoint& zero : grid.zeros()) {
    range = {std::min(range[0], zero.place.y), std::max(range[1], zero.place.y)};
    EXPECT_NEAR(grid.value(zero.place), 0, 0.5);
  }
  EXPECT_LT(range[0], 0);
  EXPECT_GT(range[1], 31);
}

TEST_F(OddGrid, IsWhereItsTransformPutsIt) {
  const auto ball = make_ball<openvdb::FloatGrid>(3, 6);
  auto transform = openvdb::math::Transform::createLinearTransform(0.1);
  transform->postRotate(std::numbers::pi / 4, openvdb::math::Z_AXIS);
  transform->postTranslate({5, 0, 0});
  ball->setTransform(transform);
  const Grid grid(write({ball}), {});
  const Vec3 center{5, 0.95 * std::numbers::sqrt2, 0.95};
  for (const OrientedPoint& zero : grid.zeros())
    EXPECT_NEAR(distance(zero.place, center), 0.6, 0.03);
  EXPECT_GT(grid.value(center + Vec3{0.65, 0, 0}), 0);
  EXPECT_LT(grid.value(center + Vec3{0.55, 0, 0}), 0);
}

TEST(SampleGrid, RefusesSettingsThatMakeNoSense) {
  const Folder folder;
  const SampleShape shape{sphere, {{0, 0, 0}, {1, 1, 1}}, 1};
  EXPECT_THROW(write_sample_grid(folder / "a.vdb", shape, {4, 3, "phi"}), OptionError);
  EXPECT_THROW(write_sample_grid(folder / "a.vdb", shape, {64, NAN, "phi"}), OptionError);
  EXPECT_THROW(write_sample_grid(folder / "none" / "a.vdb", shape, {16, 3, "phi"}), OutputError);
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(SurfaceGrid, IsTheDistanceFromTheSurface) {
  const Folder folder;
  SurfaceTriangles surface;
  const MeshData ball_data = ball(6);
  surface.points = ball_data.vertices;
  const TetMesh mesh = build(ball_data).mesh;
  for (const Triangle& s : mesh.triangles) surface.triangles.push_back(s.v);
  write_surface_grid(folder / "ball.vdb", surface, {40, 3, "phi"});
  const Grid grid(folder / "ball.vdb", {});
  EXPECT_NEAR(grid.voxel(), 0.05, 1e-6);
  for (const OrientedPoint& zero : grid.zeros()) EXPECT_NEAR(norm(zero.place), 1, 0.06);
  EXPECT_LT(grid.value({0, 0, 0}), 0);
}

TEST(SampleGrid, IsTheSameBytesAtAnyNumberOfThreads) {
  const Folder folder;
  const MeshData data = ball(12);
  SurfaceTriangles surface{data.vertices, {}};
  const TetMesh mesh = build(data).mesh;
  for (const Triangle& s : mesh.triangles) surface.triangles.push_back(s.v);
  const auto bytes = [&](int threads) {
    run_in_arena(threads, [&] {
      write_surface_grid(folder / "ball.vdb", surface, {90, 3, "phi"});
    });
    std::string all = content_of(folder / "ball.vdb");
    run_in_arena(threads, [&] { write_sphere(folder, 60); });
    return all + content_of(folder / "sphere.vdb");
  };
  const std::string expected = bytes(1);
  for (const int threads : {2, 3, 8}) EXPECT_TRUE(bytes(threads) == expected) << threads;
}

}  // namespace
}  // namespace cavea::test
