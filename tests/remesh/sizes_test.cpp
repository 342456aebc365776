// The sizes that are asked for are the sizes that come out, at any scale and place.
#include <cmath>
#include <functional>

#include "cavea/base/error.h"
#include "cavea/field/mesh_size_field.h"
#include "cavea/remesh/known_sizes.h"
#include "remesh/support.h"

namespace cavea::test {
namespace {

/// Fine near the corner (0, 0, 0), coarse away from it.
double graded(const Vec3& p) { return 0.04 + 0.16 * norm(p); }

TEST(KnownSizes, AreAskedForAgainWhereTheAnchorMoves) {
  KnownSizes sizes;
  int asked = 0;
  const auto size_at = [&](const Anchor& a) { return ++asked, 1 + double(a.u); };
  sizes.make_room(2);
  EXPECT_EQ(sizes(0, {}, size_at), 1);
  EXPECT_EQ(sizes(1, {3, 0.5f, 0}, size_at), 1.5);
  EXPECT_EQ(asked, 2);
  sizes.make_room(3);
  EXPECT_EQ(sizes(0, {}, size_at), 1);
  EXPECT_EQ(sizes(1, {3, 0.5f, 0}, size_at), 1.5);
  EXPECT_EQ(asked, 2);
  EXPECT_EQ(sizes(1, {3, 0.25f, 0}, size_at), 1.25);
  EXPECT_EQ(sizes(2, {3, 0.25f, 0}, size_at), 1.25);
  EXPECT_EQ(asked, 4);
  sizes.forget();
  sizes.make_room(3);
  EXPECT_EQ(sizes(2, {3, 0.25f, 0}, size_at), 1.25);
  EXPECT_EQ(asked, 5);
}

TEST(Sizes, FollowTheField) {
  TetMesh mesh = built(kuhn_cube(5));
  const Report report = remesh(mesh, graded, {});
  expect_sound(mesh);
  expect_good(report);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const double asked = std::min(graded(mesh.points[v]), report.hmax);
    // The field's slope is below the gradation's, so nothing else lowers the sizes; but a vertex
    // that moves after they were last set keeps its own.
    EXPECT_LE(mesh.sizes[v], 1.15 * asked);
    EXPECT_GE(mesh.sizes[v], 0.8 * asked);
  }
}

/// The mean length of the edges whose ends are both within a ball.
double mean_length_near(const TetMesh& mesh, const Vec3& center, double radius) {
  double sum = 0;
  int edges = 0;
  for (const auto& tet : mesh.tets)
    for (const auto& e : kEdgeVertices) {
      const Vec3 &a = mesh.points[tet[e[0]]], &b = mesh.points[tet[e[1]]];
      if (distance(a, center) > radius || distance(b, center) > radius) continue;
      sum += distance(a, b);
      ++edges;
    }
  EXPECT_GT(edges, 0);
  return sum / edges;
}

TEST(Sizes, AreLengthsInSpace) {
  TetMesh mesh = built(kuhn_cube(5));
  Options options;
  options.hmax = 0.1 * std::sqrt(3);
  remesh(mesh, graded, options);
  EXPECT_NEAR(mean_length_near(mesh, {0, 0, 0}, 0.15), 0.056, 0.015);
  EXPECT_NEAR(mean_length_near(mesh, {1, 1, 1}, 0.5), 0.173, 0.04);
}

/// Fine at a sphere, and so steep that a blurred map would show.
double at_sphere(const Vec3& p) {
  return std::clamp(0.03 + 0.2 * std::abs(distance(p, {0.5, 0.5, 0.5}) - 0.3), 0.03, 0.15);
}

/// Percent of the edges that conform to a map, evaluated at their ends.
template <class Map>
double conforming_percent(TetMesh mesh, Map&& map) {
  for (std::size_t v = 0; v < mesh.points.size(); ++v) mesh.sizes[v] = float(map(mesh.points[v]));
  return length_statistics(mesh).conforming_percent();
}

TEST(Sizes, FollowAMapGivenAtTheVerticesOfTheInput) {
  MeshData data = kuhn_cube(16);
  for (const Vec3& p : data.vertices) data.sizes.push_back(at_sphere(p));
  const TetMesh start = built(data);
  const MeshSizeField map(start);
  std::vector<TetMesh> results;
  for (const int threads : {1, 3}) {
    Options options;
    options.threads = threads;
    TetMesh& mesh = results.emplace_back(start);
    const Report report = remesh(mesh, std::cref(map), options);
    expect_sound(mesh);
    expect_good(report, {.worst = 0.3, .conform = 95});
  }
  EXPECT_GE(conforming_percent(results[0], at_sphere), 95);
  expect_same(results[0], results[1]);
}

TEST(Sizes, AreNotOverruledByBoundsThatAreNotSet) {
  TetMesh mesh = built(kuhn_cube(4));
  const double finer = 0.0005, coarser = 0.4;
  const auto size = [&](const Vec3& p) { return finer + (coarser - finer) * norm(p); };
  Options options;
  options.hgrad = 2;
  const Report report = remesh(mesh, size, options);
  expect_sound(mesh);
  EXPECT_DOUBLE_EQ(report.hmin, finer);
  EXPECT_NEAR(report.hmax, size({1, 1, 1}), 1e-12);
  EXPECT_LT(*std::min_element(mesh.sizes.begin(), mesh.sizes.end()), 0.001);
  EXPECT_GT(*std::max_element(mesh.sizes.begin(), mesh.sizes.end()), 0.3);
}

TEST(Sizes, OfAnyLengthDoNotExceedTheDiagonal) {
  TetMesh mesh = built(kuhn_cube(2));
  const Report report = remesh(mesh, [](const Vec3&) { return 1e300; }, {});
  expect_sound(mesh);
  EXPECT_EQ(report.hmax, report.before.counts.box_diagonal());
}

/// A thousandth of this rod's length is more than half of its radius, which is 1.
TEST(Sizes, OfSlenderBodiesFollowTheirThickness) {
  MeshData data = cylinder(4);
  for (Vec3& p : data.vertices) p.z *= 600;
  TetMesh mesh = built(data);
  const double wanted = 0.08 * thickness(mesh);
  const Report report = remesh(mesh, {}, {});
  expect_sound(mesh);
  EXPECT_DOUBLE_EQ(report.hausd, wanted);
  EXPECT_LT(report.hausd, 0.3 * 0.001 * report.before.counts.box_diagonal());
  EXPECT_DOUBLE_EQ(report.hmin, wanted);
  EXPECT_LE(report.surface_distance, wanted);
  EXPECT_GE(report.after.quality.worst, 0.3);
  EXPECT_GE(report.after.quality.mean, 0.78);
  EXPECT_NEAR(report.after.counts.volume / report.before.counts.volume, 1, 0.15);
}

TEST(Sizes, StayWithinTheBounds) {
  TetMesh mesh = built(kuhn_cube(4));
  Options options;
  options.hmin = 0.1;
  options.hmax = 0.2;
  const Report report = remesh(
      mesh, [](const Vec3& p) { return p.x < 0.5 ? 0.01 : 10.0; }, options);
  expect_sound(mesh);
  expect_good(report);
  EXPECT_EQ(report.hmin, 0.1);
  EXPECT_EQ(report.hmax, 0.2);
  for (const float size : mesh.sizes) {
    EXPECT_GE(size, 0.1f);
    EXPECT_LE(size, 0.2f);
  }
}

TEST(Sizes, ThatAreNoneAreRefused) {
  const TetMesh start = built(kuhn_cube(2));
  for (const double size : {0.0, -1.0, std::nan("")}) {
    TetMesh mesh = start;
    EXPECT_THROW(remesh(mesh, [&](const Vec3& p) { return p.x > 0.9 ? size : 0.3; }, {}),
                 InputError)
        << size;
    expect_same(mesh, start);
  }
}

TEST(Sizes, OfTheMeshItselfAreKept) {
  // Cells from 0.03 to 0.16 wide.
  MeshData data = mapped(kuhn_cube(12), [](const Vec3& p) {
    return Vec3{p.x * (1 + p.x) / 2, p.y * (1 + p.y) / 2, p.z * (1 + p.z) / 2};
  });
  perturb_inside(data, 0.008, 1);
  const TetMesh start = built(data);
  TetMesh mesh = start;
  Options options;
  options.optim = true;
  const Report report = remesh(mesh, {}, options);
  expect_sound(mesh);
  expect_good(report);
  for (const Vec3& center : {Vec3{0, 0, 0}, {0.5, 0.5, 0.5}, {1, 1, 1}})
    EXPECT_NEAR(mean_length_near(mesh, center, 0.3) / mean_length_near(start, center, 0.3), 1,
                0.15);
}

TEST(Sizes, OfTheMeshItselfAreKeptBeyondTheUsualBounds) {
  TetMesh mesh = built(kuhn_cube(2));
  Options options;
  options.optim = true;
  const Report report = remesh(mesh, {}, options);
  expect_sound(mesh);
  EXPECT_GT(report.hmax, 0.5);
  EXPECT_LT(report.after.counts.tets, 2 * report.before.counts.tets);
}

TEST(Sizes, OfTheMeshItselfExcludeOthers) {
  TetMesh mesh = built(kuhn_cube(2));
  Options options;
  options.optim = true;
  EXPECT_THROW(remesh(mesh, graded, options), OptionError);
}

/// Two required triangles at the corner (0, 0, 0), four times as coarse as the rest is to be.
TetMesh with_required_corner(std::optional<double> hgradreq, Report& report) {
  MeshData data = to_data(built(kuhn_cube(4)));
  for (std::size_t t = 0; t < data.triangles.size(); ++t)
    for (const std::int32_t v : data.triangles[t])
      if (data.vertices[v] == Vec3{0, 0, 0}) data.required_triangles.push_back(std::int32_t(t));
  TetMesh mesh = built(data);
  Options options = uniform(0.06);
  options.hgradreq = hgradreq;
  report = remesh(mesh, {}, options);
  expect_sound(mesh);
  return mesh;
}

TEST(Sizes, FollowRequiredEntitiesOutwards) {
  Report imposed, alone;
  const TetMesh mesh = with_required_corner(2.3, imposed);
  const TetMesh other = with_required_corner(std::nullopt, alone);
  EXPECT_EQ(*std::max_element(other.sizes.begin(), other.sizes.end()), 0.06f);
  EXPECT_GT(*std::max_element(mesh.sizes.begin(), mesh.sizes.end()), 0.25f);
  EXPECT_GT(mean_length_near(mesh, {0, 0, 0}, 0.35),
            1.2 * mean_length_near(other, {0, 0, 0}, 0.35));
  EXPECT_NEAR(mean_length_near(mesh, {1, 1, 1}, 0.5), mean_length_near(other, {1, 1, 1}, 0.5),
              0.003);
  EXPECT_GT(imposed.after.quality.worst, alone.after.quality.worst);
  EXPECT_GT(imposed.after.lengths.conforming_percent(), alone.after.lengths.conforming_percent());
}

TEST(Sizes, WithoutGradationMayJump) {
  constexpr double kGrad = 1.1;
  const auto jump = [](const Vec3& p) { return p.x < 0.5 ? 0.04 : 0.2; };
  // The largest slope of the wanted size along an edge, in that of the gradation, and the tets
  // where the wish is for large ones.
  const auto steepest = [&](std::optional<double> hgrad) {
    TetMesh mesh = built(kuhn_cube(8));
    Options options;
    options.hgrad = hgrad;
    remesh(mesh, jump, options);
    expect_sound(mesh);
    double slope = 0;
    for (const auto& t : mesh.tets)
      for (const auto& e : kEdgeVertices) {
        const VertexId a = t[std::size_t(e[0])], b = t[std::size_t(e[1])];
        slope = std::max(slope, std::abs(mesh.sizes[a] - mesh.sizes[b]) /
                                    distance(mesh.points[a], mesh.points[b]));
      }
    const auto in_coarse_half = [&](const auto& t) {
      double x = 0;
      for (const VertexId v : t) x += mesh.points[v].x / 4;
      return x > 0.5;
    };
    return std::pair(slope / std::log(kGrad), std::ranges::count_if(mesh.tets, in_coarse_half));
  };
  const auto [limited, more] = steepest(kGrad);
  const auto [free, fewer] = steepest(std::nullopt);
  // Vertices move after the last time that sizes are limited, so that edges become shorter.
  EXPECT_LT(limited, 2.5);
  EXPECT_GT(free, 5);
  EXPECT_LT(1.5 * double(fewer), double(more));
}

struct Motion {
  const char* name;
  double scale;
  Vec3 shift;
  double angle;
};

class Moved : public testing::TestWithParam<Motion> {
 protected:
  MeshData moved(const MeshData& data) const {
    const Motion& m = GetParam();
    const double c = std::cos(m.angle), s = std::sin(m.angle);
    return mapped(data, [&](const Vec3& p) {
      const Vec3 q = m.scale * p + m.shift;
      const Vec3 r = {c * q.x - s * q.y, s * q.x + c * q.y, q.z};  // around z, then around x
      return Vec3{r.x, c * r.y - s * r.z, s * r.y + c * r.z};
    });
  }
};

TEST_P(Moved, RenumberedBodiesAreMeshedAsWell) {
  const double scale = GetParam().scale;
  for (const MeshData& data : {two_halves(4), ball(6)}) {
    TetMesh still = built(data), mesh = built(shuffled(moved(data), 7));
    Options options = uniform(0.11);
    options.hausd = 0.003;
    const Report expected = remesh(still, {}, options);
    options.hsiz = 0.11 * scale;
    options.hausd = 0.003 * scale;
    const Report report = remesh(mesh, {}, options);
    expect_sound(mesh);
    expect_good(report);
    EXPECT_NEAR(double(report.after.counts.tets), double(expected.after.counts.tets),
                0.1 * double(expected.after.counts.tets));
    EXPECT_NEAR(report.after.quality.mean, expected.after.quality.mean, 0.02);
    EXPECT_EQ(euler(mesh), euler(still));
    EXPECT_NEAR(report.after.counts.volume / std::pow(scale, 3), expected.after.counts.volume,
                0.01 * expected.after.counts.volume);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Moved,
                         testing::Values(Motion{"tiny", 1e-6, {0, 0, 0}, 0},
                                         Motion{"huge", 1e6, {0, 0, 0}, 0},
                                         Motion{"turned", 1, {0, 0, 0}, 0.7},
                                         Motion{"far_away", 1, {1e4, -2e4, 3e4}, 0.3}),
                         [](const auto& motion) { return std::string(motion.param.name); });

}  // namespace
}  // namespace cavea::test
