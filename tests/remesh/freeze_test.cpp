// What is frozen stays to the bit.
#include <algorithm>
#include <map>

#include "remesh/support.h"

namespace cavea::test {
namespace {

using Place = std::array<double, 3>;

Place place(const Vec3& p) { return {p.x, p.y, p.z}; }

std::vector<Place> places(const TetMesh& mesh) {
  std::vector<Place> out;
  for (const Vec3& p : mesh.points) out.push_back(place(p));
  std::sort(out.begin(), out.end());
  return out;
}

/// Are all of `a` among `b`? Both are sorted.
bool within(const std::vector<Place>& a, const std::vector<Place>& b) {
  return std::includes(b.begin(), b.end(), a.begin(), a.end());
}

/// The surface as it is in space: triangles with their references and vertices, the smallest first.
std::vector<std::pair<std::array<Place, 3>, std::int32_t>> surface_of(const TetMesh& mesh) {
  std::vector<std::pair<std::array<Place, 3>, std::int32_t>> out;
  for (const Triangle& s : mesh.triangles) {
    std::array<Place, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = place(mesh.points[s.v[k]]);
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    out.push_back({corners, s.ref});
  }
  std::sort(out.begin(), out.end());
  return out;
}

/// A mesh on which every operator has something to do.
TetMesh rough_start() {
  MeshData data = two_halves(6);
  perturb_inside(data, 0.03, 5);
  set_refs(data, [](const Vec3&) { return 1; });
  return built(data);
}

Options sized() {
  Options options;
  options.hmin = 0.05;
  options.hmax = 0.3;
  return options;
}

const SizeField kWaves = [](const Vec3& p) { return p.x < 0.5 ? 0.08 : 0.3; };

std::map<std::string, std::int64_t> verdicts_of(const Report& report, bool accepted_only) {
  std::map<std::string, std::int64_t> sum;
  for (const VerdictCount& v : report.verdicts)
    if (!accepted_only || v.verdict == "accept") sum[v.op] += v.count;
  return sum;
}

struct Frozen {
  const char* name;
  bool Freezes::*freeze;
  std::vector<std::string> silent;  ///< operators that are not even asked
};

const std::vector<Frozen> kFrozen = {
    {"insert", &Freezes::insert, {"edge_split", "edge_star"}},
    {"collapse", &Freezes::collapse, {"edge_collapse"}},
    {"swap", &Freezes::swap, {"edge_swap", "face_swap", "reconnect"}},
    {"move", &Freezes::move, {"relocate"}},
};

TEST(Freeze, SilencesItsOperatorsAndNoOthers) {
  for (const Frozen& frozen : kFrozen) {
    SCOPED_TRACE(frozen.name);
    TetMesh mesh = rough_start();
    Options options = sized();
    options.freeze.*frozen.freeze = true;
    const Report report = remesh(mesh, kWaves, options);
    expect_sound(mesh);
    const auto asked = verdicts_of(report, false), accepted = verdicts_of(report, true);
    for (const std::string& op : frozen.silent) EXPECT_FALSE(asked.count(op)) << op;
    for (const char* op : {"edge_split", "edge_collapse", "edge_swap", "relocate"})
      EXPECT_TRUE(accepted.count(op) || std::count(frozen.silent.begin(), frozen.silent.end(), op))
          << op;
  }
}

/// A run that may do one thing only.
TetMesh with_only(bool Freezes::*allowed) {
  TetMesh mesh = rough_start();
  Options options = sized();
  options.freeze = {.insert = true, .collapse = true, .swap = true, .move = true};
  if (allowed) options.freeze.*allowed = false;
  remesh(mesh, kWaves, options);
  expect_sound(mesh);
  return mesh;
}

TEST(Freeze, OfAllLeavesAllAsItIs) {
  const TetMesh start = rough_start(), mesh = with_only(nullptr);
  EXPECT_TRUE(mesh.points == start.points);
  EXPECT_TRUE(mesh.tets == start.tets);
  EXPECT_EQ(surface_of(mesh), surface_of(start));
}

TEST(Freeze, OfAllButOneLeavesWhatThatOneDoesNotTouch) {
  const std::vector<Place> before = places(rough_start());
  const std::vector<Place> inserted = places(with_only(&Freezes::insert));
  EXPECT_GT(inserted.size(), before.size());
  EXPECT_TRUE(within(before, inserted));
  const std::vector<Place> collapsed = places(with_only(&Freezes::collapse));
  EXPECT_LT(collapsed.size(), before.size());
  EXPECT_TRUE(within(collapsed, before));
  const TetMesh swapped = with_only(&Freezes::swap), start = rough_start();
  EXPECT_EQ(places(swapped), before);
  EXPECT_FALSE(swapped.tets == start.tets);
  const TetMesh moved = with_only(&Freezes::move);
  EXPECT_TRUE(moved.tets == start.tets);
  EXPECT_NE(places(moved), before);
}

TEST(Freeze, OfInsertionAllowsNoBulkSubdivision) {
  TetMesh mesh = built(kuhn_cube(2));
  const std::size_t vertices = mesh.points.size();
  Options options = uniform(0.05);
  options.freeze.insert = true;
  const Report report = remesh(mesh, {}, options);
  expect_sound(mesh);
  EXPECT_LE(mesh.points.size(), vertices);
  EXPECT_FALSE(report.targets_met());  // the lengths are what was given up
}

struct Body {
  std::string name;
  MeshData data;
  Options options;
};

/// Curved, several parts, interfaces, finer and coarser than the surface.
std::vector<Body> bodies() {
  return {{"ball", ball(kSanitized ? 6 : 9), {}},
          {"parts", kuhn_cube(kSanitized ? 8 : 14), uniform(0.2)},
          {"halves", two_halves(6), uniform(0.06)},
          {"octants", octants(6), {}},
          {"cylinder", cylinder(8), {}},
          {"polycube", polycube(4, 0.5, 3), uniform(0.5)}};
}

class FrozenSurface : public testing::TestWithParam<std::size_t> {};

TEST_P(FrozenSurface, StaysToTheBit) {
  const Body body = bodies()[GetParam()];
  const TetMesh start = built(body.data);
  TetMesh mesh = start;
  Options options = body.options;
  options.freeze.surface = true;
  const Report report = remesh(mesh, {}, options);
  expect_sound(mesh);
  EXPECT_EQ(surface_of(mesh), surface_of(start));
  EXPECT_NE(places(mesh), places(start));  // the inside has not been left alone
  EXPECT_LE(report.surface_distance, 1e-12);
  EXPECT_EQ(count(mesh).tets_of_ref.size(), count(start).tets_of_ref.size());
}

INSTANTIATE_TEST_SUITE_P(All, FrozenSurface, testing::Range<std::size_t>(0, bodies().size()),
                         [](const auto& number) { return bodies()[number.param].name; });

/// Mean edge length of the tets whose centroid is nearer than `depth` to the cube's boundary, or
/// not.
double mean_length(const TetMesh& mesh, double depth, bool near) {
  double sum = 0;
  std::int64_t edges = 0;
  for (const auto& tet : mesh.tets) {
    Vec3 c;
    for (const VertexId v : tet) c += mesh.points[v] / 4;
    const double to_wall = std::min({c.x, c.y, c.z, 1 - c.x, 1 - c.y, 1 - c.z});
    if ((to_wall < depth) != near) continue;
    for (const auto& e : kEdgeVertices)
      sum += distance(mesh.points[tet[e[0]]], mesh.points[tet[e[1]]]), ++edges;
  }
  return sum / double(edges);
}

TEST(FrozenSurfaceSizes, GrowInwardsFromAFineOne) {
  TetMesh mesh = built(kuhn_cube(kSanitized ? 8 : 12));
  Options options = uniform(0.4);
  options.freeze.surface = true;
  const Report report = remesh(mesh, {}, options);
  expect_sound(mesh);
  EXPECT_GE(report.after.quality.worst, 0.15);
  EXPECT_GE(report.after.lengths.conforming_percent(), 75);
  EXPECT_GT(mean_length(mesh, 0.3, false), 1.5 * mean_length(mesh, 0.1, true));
}

TEST(FrozenSurfaceSizes, ShrinkInwardsFromACoarseOne) {
  TetMesh mesh = built(kuhn_cube(3));
  Options options = uniform(0.06);
  options.freeze.surface = true;
  const Report report = remesh(mesh, {}, options);
  expect_sound(mesh);
  EXPECT_GE(report.after.quality.worst, 0.1);
  EXPECT_LT(mean_length(mesh, 0.3, false), 0.7 * mean_length(mesh, 0.1, true));
}

}  // namespace
}  // namespace cavea::test
