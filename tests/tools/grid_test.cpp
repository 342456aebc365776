// From grids to meshes, with the program.
#include <cmath>
#include <nlohmann/json.hpp>

#include "cavea/io/formats.h"
#include "cavea/mesh/build.h"
#include "cavea/mesh/statistics.h"
#include "run_program.h"
#include "support/expect.h"

namespace cavea::test {
namespace {

using Files = std::set<std::string>;

class GridRunTest : public ProgramTest {
 protected:
  void make_grid(const std::string& shape, const std::string& voxels = "32") const {
    const Outcome outcome = cavea({"grid", shape, "-o", shape + ".vdb", "--voxels", voxels});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "written " + shape + ".vdb\n");
  }
  TetMesh mesh(const std::string& name) const { return build(read_mesh(file(name), nullptr)).mesh; }
};

TEST_F(GridRunTest, MeshesEveryClosedSample) {
  struct {
    const char* shape;
    double volume;
    std::int64_t euler;
  } constexpr kSamples[] = {{"sphere", 0.113097, 2}, {"torus", 0.079587, 0}};
  for (const auto& [shape, volume, euler] : kSamples) {
    SCOPED_TRACE(shape);
    make_grid(shape);
    const Outcome outcome = cavea({"implicit", std::string(shape) + ".vdb", "-o", "out.meshb",
                                   "--hausd", "0.01", "--keep", "inside", "--quiet"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const TetMesh out = mesh("out.meshb");
    expect_sound(out);
    const Counts counts = count(out);
    EXPECT_NEAR(counts.volume, volume, 0.06 * volume);
    EXPECT_EQ(counts.components, 1);
    // The boundary's faces and edges are 3 to 2: V - E + F = V - F / 2.
    std::set<VertexId> surface;
    for (const Triangle& s : out.triangles) surface.insert(s.v.begin(), s.v.end());
    EXPECT_EQ(std::int64_t(surface.size()) - counts.triangles / 2, euler);
  }
}

TEST_F(GridRunTest, MeshesAnOpenSampleToTheEndOfItsGrid) {
  make_grid("gyroid");
  const Outcome outcome = cavea({"implicit", "gyroid.vdb", "-o", "out.meshb", "--hausd", "0.02"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("open at the boundary"), std::string::npos) << outcome.out;
  const Counts counts = count(mesh("out.meshb"));
  EXPECT_NEAR(counts.volume, 1, 1e-9);
  EXPECT_NEAR(counts.volume_of_ref.at(3), 0.5, 0.01);
}

TEST_F(GridRunTest, KeepsTheBoxSharpAndRoundsWhatVoxelsHaveRounded) {
  write_text(file("cube.mesh"), cube_text());
  ASSERT_EQ(cavea({"grid", "surface", "cube.mesh", "-o", "cube.vdb", "--voxels", "16"}).status, 0);
  const auto ridges = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"implicit", "cube.vdb", "-o", "out.meshb", "--hausd", "0.04"});
    EXPECT_EQ(cavea(words).status, 0);
    const MeshData data = read_mesh(file("out.meshb"), nullptr);
    EXPECT_GE(data.corners.size(), 8u);
    double length = 0;
    for (const std::int32_t e : data.ridges)
      length += distance(data.vertices[data.edges[e][0]], data.vertices[data.edges[e][1]]);
    return length;
  };
  const double of_box =
      12 * (1 + 4.0 / 16) * 1.2;  // with two voxels of the band and the margin on either side
  EXPECT_NEAR(ridges({}), of_box, 0.02 * of_box);
  EXPECT_GT(ridges({"--angle", "30"}), of_box + 1);
}

TEST_F(GridRunTest, MeshesAGivenBoxOnly) {
  make_grid("sphere");
  const Outcome outcome = cavea({"implicit", "sphere.vdb", "--box", "0.5,0.5,0.5,0.9,0.9,0.9", "-o",
                                 "out.meshb", "--hausd", "0.01"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("open at the boundary"), std::string::npos) << outcome.out;
  const Counts counts = count(mesh("out.meshb"));
  EXPECT_LT(distance(counts.box_min, {0.5, 0.5, 0.5}), 1e-12);
  EXPECT_LT(distance(counts.box_max, {0.9, 0.9, 0.9}), 1e-12);
  EXPECT_NEAR(counts.volume_of_ref.at(3), 0.113097 / 8, 0.05 * 0.113097 / 8);
}

TEST_F(GridRunTest, GivesTheSameBytesAtAnyNumberOfThreads) {
  make_grid("union");
  const auto run = [&](const std::string& threads) {
    EXPECT_EQ(cavea({"implicit", "union.vdb", "-o", "out.meshb", "--hausd", "0.005", "--threads",
                     threads})
                  .status,
              0);
    return read_text(file("out.meshb"));
  };
  const std::string expected = run("1");
  for (const char* threads : {"2", "3", "8"}) EXPECT_TRUE(run(threads) == expected) << threads;
}

TEST_F(GridRunTest, LetsEdgesBeHalfAVoxelLong) {
  make_grid("sphere", "512");
  const auto hmin = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"implicit", "sphere.vdb", "-o", "out.meshb", "--hausd", "0.02",
                                 "--report", "r.json", "--quiet"});
    EXPECT_EQ(cavea(words).status, 0);
    return nlohmann::json::parse(read_text(file("r.json")))["options"]["hmin"].get<double>();
  };
  EXPECT_NEAR(hmin({}), 0.5 / 512, 1e-9);
  EXPECT_EQ(hmin({"--hmin", "0.01"}), 0.01);
}

/// Negative in the samples `torus` and `sphere`.
double in_torus(const Vec3& p) {
  return std::hypot(std::hypot(p.x - 0.5, p.y - 0.5) - 0.28, p.z - 0.5) - 0.12;
}
double in_sphere(const Vec3& p) { return distance(p, {0.5, 0.5, 0.5}) - 0.3; }

/// Of what is in the second one and not in the first one: midpoints of 60^3 cells.
double volume_left(double (*first)(const Vec3&), double (*second)(const Vec3&)) {
  constexpr int kCells = 60;
  int n = 0;
  for (int c = 0; c < kCells * kCells * kCells; ++c) {
    const Vec3 p =
        Vec3{c % kCells + 0.5, c / kCells % kCells + 0.5, c / kCells / kCells + 0.5} / kCells;
    n += first(p) >= 0 && second(p) < 0;
  }
  return n / std::pow(kCells, 3);
}

TEST_F(GridRunTest, StacksFilesByPriority) {
  make_grid("torus", "64");
  make_grid("sphere", "48");
  struct {
    std::vector<std::string> files;
    double first, second;
  } const kOrders[] = {{{"torus.vdb", "sphere.vdb"}, 0.079587, volume_left(in_torus, in_sphere)},
                       {{"sphere.vdb", "torus.vdb"}, 0.113097, volume_left(in_sphere, in_torus)}};
  for (const auto& [order, first, second] : kOrders) {
    SCOPED_TRACE(order[0]);
    const Outcome outcome = cavea({"implicit", order[0], order[1], "-o", "out.meshb", "--hausd",
                                   "0.003", "--report", "r.json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find(order[1] + ": "), std::string::npos) << outcome.out;
    const TetMesh out = mesh("out.meshb");
    expect_sound(out);
    const auto volumes = count(out).volume_of_ref;
    EXPECT_EQ(volumes.size(), 3u);
    EXPECT_NEAR(volumes.at(3), first, 0.03 * first);
    EXPECT_NEAR(volumes.at(4), second, 0.03 * second);
    const auto report = nlohmann::json::parse(read_text(file("r.json")));
    ASSERT_EQ(report["level_sets"].size(), 2u);
    for (int k = 0; k < 2; ++k) {
      EXPECT_EQ(report["level_sets"][k]["name"], order[k]);
      EXPECT_LT(report["level_sets"][k]["distance"], 1.0 / 48);
    }
  }
}

TEST_F(GridRunTest, SamplesTheSurfaceOfAMesh) {
  write_text(file("cube.mesh"), cube_text());
  ASSERT_EQ(cavea({"grid", "surface", "cube.mesh", "-o", "cube.vdb", "--voxels", "24"}).status, 0);
  const Outcome outcome = cavea({"implicit", "cube.vdb", "-o", "out.meshb", "--keep", "inside",
                                 "--hausd", "0.02", "--quiet"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  // Edges and corners are rounded by about a voxel.
  EXPECT_NEAR(count(mesh("out.meshb")).volume, 1, 0.03);
}

TEST_F(GridRunTest, RefusesWhatIsNoLevelSet) {
  make_grid("sphere");
  write_text(file("text.vdb"), "a grid\n");
  write_text(file("cube.mesh"), cube_text());
  const Files before = files();
  const auto expect_refused = [&](std::vector<std::string> words, const std::string& named) {
    words.insert(words.end(), {"-o", "out.mesh"});
    words.insert(words.begin(), "implicit");
    const Outcome outcome = cavea(words);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find(named), std::string::npos) << outcome.err;
  };
  expect_refused({"text.vdb"}, "not a VDB file");
  expect_refused({"none.vdb"}, "none.vdb");
  expect_refused({"sphere.vdb", "--grid", "density"}, "holds no grid named 'density', but: phi");
  expect_refused({"sphere.vdb", "--iso", "7"}, "nowhere 7");
  expect_refused({"sphere.vdb", "--iso", "nan"}, "isovalue");
  expect_refused({"sphere.vdb", "--box", "2,2,2,3,3,3"}, "outside of the grid");
  expect_refused({"sphere.vdb", "--box", "1,0,0,0,1,1"}, "--box");
  expect_refused({"sphere.vdb", "--box", "0,0,0,1,1"}, "--box");
  expect_refused({"sphere.vdb", "--box", "0.48,0.48,0.48,0.52,0.52,0.52"}, "nowhere 0");
  expect_refused({"sphere.vdb", "--sol", "phi.sol"}, "--sol");
  expect_refused({"sphere.vdb", "--grid", "phi", "--grid", "phi"}, "nothing of its inside");
  expect_refused({"sphere.vdb", "sphere.vdb", "--grid", "phi"}, "--grid is given 1 times for 2");
  expect_refused({"sphere.vdb", "sphere.vdb", "--reference-map", "1:5:6"}, "single level set");
  expect_refused({"sphere.vdb", "sphere.vdb", "--outside-ref", "4"}, "3 to 4");
  expect_refused({"sphere.vdb", "cube.mesh"}, "cube.mesh");
  expect_refused({"cube.mesh", "sphere.vdb", "--sol", "phi.sol"}, "only .vdb files");
  expect_refused({"sphere.vdb", "--met", "sizes.sol"}, "--met");
  expect_refused({"cube.mesh", "--sol", "phi.sol", "--grid", "phi"}, "--grid");
  expect_refused({"cube.mesh", "--sol", "phi.sol", "--box", "0,0,0,1,1,1"}, "--box");
  EXPECT_EQ(files(), before);
}

TEST_F(GridRunTest, RefusesToMakeWhatIsNoGrid) {
  write_text(file("cube.mesh"), cube_text());
  const Files before = files();
  const auto expect_refused = [&](std::vector<std::string> words, const std::string& named) {
    words.insert(words.begin(), "grid");
    const Outcome outcome = cavea(words);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find(named), std::string::npos) << outcome.err;
  };
  expect_refused({"cone", "-o", "out.vdb"}, "SHAPE");
  expect_refused({"sphere", "-o", "out.mesh"}, ".vdb");
  expect_refused({"sphere", "cube.mesh", "-o", "out.vdb"}, "no FILE");
  expect_refused({"surface", "-o", "out.vdb"}, "FILE");
  expect_refused({"surface", "none.mesh", "-o", "out.vdb"}, "none.mesh");
  expect_refused({"sphere", "-o", "out.vdb", "--voxels", "1"}, "voxels");
  EXPECT_EQ(files(), before);
}

}  // namespace
}  // namespace cavea::test
