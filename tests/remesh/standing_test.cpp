// A mesh that is what is asked for is left as it is, but for what is wrong in it.
#include "cavea/remesh/standing.h"

#include <set>

#include "cavea/remesh/mending.h"
#include "cavea/surface/crossings.h"
#include "remesh/support.h"

namespace cavea::test {
namespace {

using Place = std::array<double, 3>;

std::set<std::array<Place, 4>> places_of_tets(const TetMesh& mesh) {
  std::set<std::array<Place, 4>> all;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (!mesh.tet_alive(TetId(t))) continue;
    std::array<Place, 4> tet;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3& p = mesh.points[mesh.tets[t][k]];
      tet[k] = {p.x, p.y, p.z};
    }
    std::sort(tet.begin(), tet.end());
    all.insert(tet);
  }
  return all;
}

/// Share of the tets of `before` that are not in `after`, by the places of their vertices.
double share_changed(const TetMesh& before, const TetMesh& after) {
  const auto now = places_of_tets(after), then = places_of_tets(before);
  std::size_t gone = 0;
  for (const auto& tet : then) gone += !now.count(tet);
  return double(gone) / double(then.size());
}

/// Remeshed once and written: a file has no more than this.
MeshData remeshed(const MeshData& data, const Options& options) {
  TetMesh mesh = built(data);
  remesh(mesh, {}, options);
  return to_data(mesh);
}

Options with_tolerance(double hausd) {
  Options options;
  options.hausd = hausd;
  return options;
}

/// One layer of cells, 20 times as wide as thick.
MeshData thin_plate() {
  MeshData data = kuhn_grid(10, [](int, int, int k) { return k == 0; });
  for (Vec3& p : data.vertices) p.z /= 2;
  return data;
}

/// A surface that is rough at the size of its triangles, as those of scans are.
MeshData rough_ball() {
  return mapped(ball(10), [](const Vec3& p) {
    return (1 + 0.01 * std::sin(31 * p.x) * std::sin(29 * p.y + 1) * std::sin(37 * p.z + 2)) * p;
  });
}

/// Five teeth that are narrower than the sizes wanted, so that room is made for elements in them.
MeshData comb() {
  MeshData data =
      kuhn_grid(9, [](int i, int j, int k) { return k == 0 && j < 4 && (j == 0 || i % 2 == 0); });
  for (Vec3& p : data.vertices) {
    const double side = std::round(9 * p.x);
    p = {1.3 * std::floor(side / 2) + 0.7 * std::fmod(side, 2), 9 * p.y, 4.5 * p.z};
  }
  return data;
}

/// Two sides meet almost, below six degrees: tets there are poor, whatever they are.
MeshData sharp_wedge() {
  return mapped(kuhn_cube(6), [](const Vec3& p) {
    return Vec3{p.x, p.y * (0.005 + 0.1 * p.x), p.z};
  });
}

/// Two sides meet at 16 degrees, about the limit of what counts as thin, and one of them bends.
MeshData bent_blade() {
  return mapped(half_cube(6), [](const Vec3& p) {
    return Vec3{p.x, p.y * 0.28 * (1 - 0.1 * p.x), p.z / 1.5};
  });
}

struct Body {
  std::string name;
  MeshData data;
  Options options;
};

std::vector<Body> bodies() {
  const bool small = kSanitized;
  Options faceted = with_tolerance(0.004);
  faceted.faceted = true;
  return {{"cube", kuhn_cube(4), {}},
          {"uniform_cube", kuhn_cube(4), uniform(small ? 0.15 : 0.08)},
          {"octants", octants(4), uniform(0.1)},
          {"ball", ball(8), with_tolerance(0.004)},
          {"uniform_ball", ball(6), uniform(0.15)},
          {"rough_ball", rough_ball(), {}},
          {"faceted_rough_ball", rough_ball(), faceted},
          {"sharp_wedge", sharp_wedge(), uniform(0.03)},
          {"sharp_wedge_without_room", sharp_wedge(), {}},
          {"cylinder", cylinder(8), with_tolerance(0.01)},
          {"faceted_cylinder", cylinder(8), faceted},
          {"fading_ridges", fading_column(6), with_tolerance(0.004)},
          {"bent_blade", bent_blade(), {}},
          {"comb", comb(), {}},
          {"frame", frame(), uniform(0.06)},
          {"thin_plate", thin_plate(), uniform(0.05)}};
}

/// The quality of results, and lengths as a rerun finds them.
MeshSummary found(double mean_length, double too_long_percent) {
  MeshSummary summary;
  summary.quality.mean = 0.79;
  summary.lengths.edges = 1000;
  summary.lengths.mean = mean_length;
  summary.lengths.histogram[6] = std::int64_t(10 * too_long_percent);
  return summary;
}

// Figures of reruns of a helmet, an anchor, two nested spheres, a knot and a star with sharp
// points.
TEST(Standing, IsNearlyWhatAResultIsFoundToBe) {
  Options smooth, faceted;
  faceted.faceted = true;
  const auto is_near = [](const MeshSummary& now, const Options& options, double bulge = 2) {
    return is_nearly_result(now, {now.lengths, bulge}, options);
  };
  const auto made_room = [](const MeshSummary& now, const Options& options) {
    return may_have_made_room(now, {now.lengths, 2}, options);
  };
  // Long beside what a thin wedge asks for, but not beside its curvature.
  EXPECT_TRUE(is_nearly_result(found(1.28, 26), {found(0.4, 0).lengths, 2}, smooth));
  EXPECT_TRUE(is_near(found(1.29, 26), faceted));
  EXPECT_FALSE(is_near(found(1.29, 26), smooth));
  // Of a prism of 24 sides, whose smooth sides meet in creases.
  EXPECT_TRUE(is_near(found(1.24, 25), smooth, 1.2));
  EXPECT_FALSE(is_near(found(1.5, 60), smooth, 1.2));
  EXPECT_TRUE(is_near(found(0.86, 2), faceted));
  EXPECT_TRUE(is_near(found(0.886, 0), smooth));
  EXPECT_FALSE(is_near(found(0.69, 0), smooth));
  EXPECT_FALSE(is_near(found(2, 90), faceted));
  EXPECT_TRUE(made_room(found(0.69, 0), faceted));
  EXPECT_TRUE(made_room(found(0.73, 6), smooth));
  EXPECT_FALSE(made_room(found(0.15, 0), smooth));
}

// Of a torus cut at ten degrees: what is given again has other sizes near the sharp rim.
TEST(Standing, LengthsThatConformHaveNothingToGain) {
  const auto with = [](double quality, double too_long_percent) {
    MeshSummary summary = found(1, too_long_percent);
    summary.quality.mean = quality;
    summary.quality.worst = 0.2;
    summary.quality.histogram[2] = 10, summary.quality.histogram[8] = 990;
    summary.lengths.conforming = 1000 - summary.lengths.histogram[6];
    return summary;
  };
  EXPECT_TRUE(gained_nothing(with(0.785, 6.5), with(0.781, 3.4), {}));
  EXPECT_FALSE(gained_nothing(with(0.785, 12), with(0.781, 3.4), {}));
  EXPECT_FALSE(gained_nothing(with(0.785, 6.5), with(0.8, 3.4), {}));
}

// Figures of reruns of three spheres and of a horned head, and of meshes with a wrong place.
TEST(Standing, FewAreMendedByChance) {
  EXPECT_TRUE(mended_by_chance(14, 16));
  EXPECT_TRUE(mended_by_chance(94, 100));
  EXPECT_TRUE(mended_by_chance(124, 127));
  EXPECT_TRUE(mended_by_chance(8, 8));
  EXPECT_TRUE(mended_by_chance(31, 42));
  EXPECT_TRUE(mended_by_chance(44, 60));
  EXPECT_FALSE(mended_by_chance(0, 1));
  EXPECT_FALSE(mended_by_chance(3, 8));
  EXPECT_FALSE(mended_by_chance(850, 1000));
}

class Again : public testing::TestWithParam<std::size_t> {};

TEST_P(Again, ChangesHardlyAnything) {
  const Body body = bodies()[GetParam()];
  SCOPED_TRACE(body.name);
  for (const std::uint64_t seed : {0, 2}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const MeshData first = remeshed(shuffled(body.data, seed), body.options);
    const TetMesh start = built(first);
    TetMesh mesh = start;
    const Report report = remesh(mesh, {}, body.options);
    expect_sound(mesh);
    EXPECT_LT(share_changed(start, mesh), 0.005);
    EXPECT_LE(report.surface_distance, report.hausd);
    EXPECT_TRUE(find_crossings(mesh).empty());
  }
}

INSTANTIATE_TEST_SUITE_P(All, Again, testing::Range<std::size_t>(0, bodies().size()),
                         [](const auto& number) { return bodies()[number.param].name; });

/// Moves an inner vertex towards a face of its ball by this share of the way, so that the worst
/// tet's quality is within the bounds.
void move_a_vertex(MeshData& data, double share, double least, double most) {
  const TetMesh good = built(data);
  for (std::size_t t = 0; t < good.tets.size(); ++t)
    for (int k = 0; k < 4; ++k) {
      const VertexId v = good.tets[t][k];
      if (good.vertex_tags[v] & tag::kSurface) continue;
      Vec3 face;
      for (const int i : kFaceVertices[k]) face += good.points[good.tets[t][i]] / 3;
      TetMesh moved = good;
      moved.points[v] += share * (face - moved.points[v]);
      double worst = 1;
      for (std::size_t s = 0; s < moved.tets.size(); ++s)
        worst = std::min(worst, double(moved.compute_quality(TetId(s))));
      if (worst < least || worst > most) continue;
      data.vertices[std::size_t(v)] = moved.points[v];
      return;
    }
  FAIL() << "there is no such vertex";
}

/// The share that changes of a result in which a vertex has been moved so.
double changed_around(double share, double least, double most) {
  const Options options = uniform(0.06);
  MeshData data = remeshed(kuhn_cube(4), options);
  move_a_vertex(data, share, least, most);
  const TetMesh start = built(data);
  TetMesh mesh = start;
  const Report report = remesh(mesh, {}, options);
  expect_sound(mesh);
  EXPECT_GT(report.after.quality.worst, 0.3);
  return share_changed(start, mesh);
}

TEST(Standing, WhatIsWrongInAPlaceIsMendedThere) {
  const double changed = changed_around(0.95, 0.01, 0.2);
  EXPECT_LT(changed, 0.02);
  EXPECT_GT(changed, 0);
}

// One or two in ten thousand of results are so: to mend them asks more around them.
TEST(Standing, AFewTetsThatWouldDoAreLeft) { EXPECT_EQ(changed_around(0.5, 0.31, 0.39), 0); }

TEST(Standing, OtherSizesAreFollowedAllTheSame) {
  const TetMesh start = built(remeshed(kuhn_cube(4), uniform(0.1)));
  for (const double size : {0.06, 0.16}) {
    TetMesh mesh = start;
    const Report report = remesh(mesh, {}, uniform(size));
    expect_sound(mesh);
    expect_good(report);
  }
}

TEST(Standing, AnotherToleranceIsFollowedAllTheSame) {
  const TetMesh start = built(remeshed(rough_ball(), with_tolerance(0.004)));
  for (const double hausd : {0.001, 0.016}) {
    TetMesh mesh = start;
    const Report report = remesh(mesh, {}, with_tolerance(hausd));
    expect_sound(mesh);
    // Sizes are as the square root of the tolerance.
    const double finer = double(report.after.counts.triangles) / double(start.triangles.size());
    if (hausd < 0.004)
      EXPECT_GT(finer, 1.5);
    else
      EXPECT_LT(finer, 1 / 1.5);
    EXPECT_GE(report.after.lengths.conforming_percent(), 90);
    EXPECT_LE(report.surface_distance, report.hausd);
  }
}

TEST(Standing, AnotherSurfaceIsFollowedAllTheSame) {
  const TetMesh truth = built(ball(10));
  Options options = with_tolerance(0.01);
  // Smaller by ten tolerances, and as good a mesh as can be.
  TetMesh mesh = built(mapped(remeshed(ball(6), options), [](const Vec3& p) { return 0.9 * p; }));
  options.surface = &truth;
  const Report report = remesh(mesh, {}, options);
  expect_sound(mesh);
  EXPECT_LE(report.surface_distance, report.hausd);
}

}  // namespace
}  // namespace cavea::test
