#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <numbers>

#include "cavea/surface/patch_tree.h"
#include "cavea/surface/surface_model.h"
#include "surface/shapes.h"

namespace cavea {
namespace {

using test::kuhn_cube;
using test::modelled;
using test::modelled_ball;
using test::modelled_cube;
using test::modelled_cylinder;
using test::Random;

Vec3 at(const SurfaceModel& model, const Anchor& a) {
  return model.patch_of_facet(a.facet).at(a.u, a.v);
}

/// Coordinates of anchors are floats.
constexpr double kAnchorRounding = 1e-6;

/// Some vertex of the mesh whose anchor is on a facet, by the throw of a die.
VertexId random_smooth_vertex(const TetMesh& mesh, Random& random) {
  for (;;) {
    const VertexId v = random.below(std::int32_t(mesh.points.size()));
    if (mesh.anchors[v].facet >= 0) return v;
  }
}

TEST(SurfaceModel, OfTheCubeIsExactlyFlat) {
  const auto cube = modelled_cube(3);
  EXPECT_EQ(cube.patches, 6);
  for (std::int32_t f = 0; f < std::int32_t(cube.model.facets()); ++f) {
    const auto [a, b, c] = cube.model.facet_corners(f);
    const Vec3 n = normalized(cross(b - a, c - a));
    for (const auto& [u, v] : {std::pair{0.2, 0.3}, {0.5, 0.5}, {1.0 / 3, 1.0 / 3}})
      EXPECT_LT(std::abs(dot(cube.model.patch_of_facet(f).at(u, v) - a, n)), 1e-15);
  }
}

TEST(SurfaceModel, AnchorsOfTheMeshStandOnItsVertices) {
  for (const auto& shape : {modelled_cube(3), modelled_ball(5), modelled_cylinder(4)})
    for (std::size_t v = 0; v < shape.mesh.points.size(); ++v) {
      const Anchor& a = shape.mesh.anchors[v];
      EXPECT_EQ(a.facet != kNone, (shape.mesh.vertex_tags[v] & tag::kSurface) != 0);
      const bool on_curve =
          (shape.mesh.vertex_tags[v] & tag::kRidge) && !(shape.mesh.vertex_tags[v] & tag::kCorner);
      EXPECT_EQ(SurfaceModel::is_curve(a), on_curve);
      if (a.facet >= 0) {
        EXPECT_LT(distance(at(shape.model, a), shape.mesh.points[v]), 1e-15);
      }
    }
}

TEST(SurfaceModel, TakesGivenNormalsOnSmoothFans) {
  TetMesh mesh = build(test::ball(4)).mesh;
  const Vec3 tilted = normalized({1, 0.2, -0.1});
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (distance(mesh.points[v], {1, 0, 0}) < 1e-9)
      mesh.normals = {{VertexId(v), -3.0 * tilted}};  // of any length and direction
  ASSERT_EQ(mesh.normals.size(), 1u);
  const VertexId v = mesh.normals[0].vertex;
  const auto shape = modelled(std::move(mesh), {.angle = 80});
  const Anchor& a = shape.mesh.anchors[v];
  EXPECT_LT(distance(shape.model.normal(a, 0), tilted), 1e-12);
}

TEST(SurfaceModel, TakesNoGivenNormalsOnRidges) {
  TetMesh mesh = build(kuhn_cube(3)).mesh;
  classify_features(mesh, {});
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (mesh.vertex_tags[v] & tag::kRidge) mesh.normals.push_back({VertexId(v), {1, 2, 3}});
  const auto cube = modelled(std::move(mesh));
  for (std::int32_t f = 0; f < std::int32_t(cube.model.facets()); ++f) {
    const auto [a, b, c] = cube.model.facet_corners(f);
    const Vec3 n = normalized(cross(b - a, c - a));
    EXPECT_LT(std::abs(dot(cube.model.patch_of_facet(f).at(0.2, 0.3) - a, n)), 1e-15);
  }
}

TEST(SurfaceModel, OfABallIsNearerToTheSphereThanItsFacets) {
  for (const int n : {4, 8}) {
    const auto ball = modelled_ball(n);
    double flat = 0, smooth = 0;
    for (std::int32_t f = 0; f < std::int32_t(ball.model.facets()); ++f) {
      const auto [a, b, c] = ball.model.facet_corners(f);
      for (const auto& [u, v] : {std::pair{0.5, 0.0}, {0.5, 0.5}, {0.0, 0.5}, {1.0 / 3, 1.0 / 3}}) {
        flat = std::max(flat, 1 - norm((1 - u - v) * a + u * b + v * c));
        smooth = std::max(smooth, std::abs(1 - norm(ball.model.patch_of_facet(f).at(u, v))));
      }
    }
    EXPECT_LT(smooth, 0.35 * flat) << "n " << n;
  }
}

TEST(SurfaceModel, BulgeIsBounded) {
  TetMesh mesh = build(test::ball(4)).mesh;
  classify_features(mesh, {});
  constexpr double kBound = 1e-3;
  const SurfaceModel model(mesh, {0.001, kBound, 1e-3, 10});
  for (std::int32_t f = 0; f < std::int32_t(model.facets()); ++f) {
    const auto [a, b, c] = model.facet_corners(f);
    const BezierTriangle& p = model.patch_of_facet(f);
    for (int k = 0; k < 3; ++k) {
      const Vec3 &from = p.corner[(k + 1) % 3], &to = p.corner[(k + 2) % 3];
      EXPECT_LE(distance(p.edge[k][0], from + (to - from) / 3), kBound * (1 + 1e-9));
      EXPECT_LE(distance(p.edge[k][1], to + (from - to) / 3), kBound * (1 + 1e-9));
    }
    // A center half as far again as the mean of the edges' control points.
    EXPECT_LE(distance(p.center, (a + b + c) / 3), 1.5 * kBound * (1 + 1e-9));
  }
}

/// A roof on a tip below, of which the first facet is flat and stands on a ridge; the normal given
/// at its third vertex makes its two other edges bulge.
MeshData roof_with_flat_facet() {
  MeshData data;
  data.vertices = {{0, 0, 0},     {10, 0, 0},   {5, 0.04, 0}, {0, 5, -0.8},
                   {10, 5, -0.8}, {5, 2.5, -6}, {5, 2.5, -2}};
  constexpr std::int32_t kInside = 6;
  constexpr std::array<std::int32_t, 3> kFacets[] = {{0, 1, 2}, {0, 2, 3}, {2, 1, 4}, {2, 4, 3},
                                                     {1, 0, 5}, {4, 1, 5}, {3, 4, 5}, {0, 3, 5}};
  for (const auto& f : kFacets) {
    data.tets.push_back({f[0], f[1], f[2], kInside});
    data.tet_refs.push_back(0);
  }
  return data;
}

TEST(SurfaceModel, FlatFacetsBesideRidgesDoNotTurnOver) {
  TetMesh mesh = build(roof_with_flat_facet()).mesh;
  mesh.normals = {{2, {0.5, 0, 1}}};
  const test::Modelled roof = modelled(std::move(mesh));
  int flat = 0;
  for (std::int32_t f = 0; f < std::int32_t(roof.model.facets()); ++f) {
    const BezierTriangle& p = roof.model.patch_of_facet(f);
    const Vec3 normal = normalized(cross(p.corner[1] - p.corner[0], p.corner[2] - p.corner[0]));
    if (normal.z < 0.999) continue;
    ++flat;
    for (double u = 0; u <= 1; u += 0.125)
      for (double v = 0; u + v <= 1; v += 0.125)
        EXPECT_GT(dot(normalized(p.normal(u, v)), normal), 0.5) << u << " " << v;
  }
  EXPECT_EQ(flat, 1);
}

TEST(SurfaceModel, PlaceFindsThePlaceOnAFlatFaceFromAnywhereOnIt) {
  const auto cube = modelled_cube(4);
  Random random(1);
  int walked = 0;
  while (walked < 500) {
    const Vec3 p{random.unit(), random.unit(), 1};
    const VertexId v = random_smooth_vertex(cube.mesh, random);
    if (cube.mesh.points[v].z != 1) continue;
    int top = kNone;
    for (const Triangle& t : cube.mesh.triangles)
      if (t.v[0] == v || t.v[1] == v || t.v[2] == v)
        if (cube.mesh.points[t.v[0]].z == 1 && cube.mesh.points[t.v[1]].z == 1 &&
            cube.mesh.points[t.v[2]].z == 1)
          top = t.patch;
    ++walked;
    const SurfacePoint s = cube.model.place(p + Vec3{0, 0, 0.01}, top, {&cube.mesh.anchors[v], 1});
    EXPECT_LT(distance(s.point, p), 1e-12) << "seed 1, walk " << walked;
    EXPECT_LT(distance(at(cube.model, s.anchor), p), kAnchorRounding);
    EXPECT_NEAR(s.distance2, 1e-4, 1e-12);
  }
}

TEST(SurfaceModel, PlaceIsTheNearestPlaceOfTheModel) {
  const auto ball = modelled_ball(8);
  const PatchTree tree(ball.model);
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    // Outside, where a convex surface has no second place that is nearer than all around it. The
    // facets' polyhedron is not quite convex, so the walk begins on the near side.
    const Vec3 guess = random.between(1, 1.05) * test::random_direction(random);
    VertexId v = random_smooth_vertex(ball.mesh, random);
    while (dot(ball.mesh.points[v], guess) < 0) v = random_smooth_vertex(ball.mesh, random);
    const SurfacePoint s = ball.model.place(guess, 0, {&ball.mesh.anchors[v], 1});
    ASSERT_GE(s.anchor.facet, 0);
    EXPECT_LT(distance(at(ball.model, s.anchor), s.point), kAnchorRounding);
    EXPECT_NEAR(s.distance2, distance2(s.point, guess), 1e-15);
    const double nearest = std::sqrt(tree.nearest(guess).place.distance2);
    EXPECT_GE(std::sqrt(s.distance2), nearest * (1 - 1e-4));
    // Two fixed-point steps leave a little of the way.
    EXPECT_LE(std::sqrt(s.distance2), nearest + 1e-4);
  }
}

TEST(SurfaceModel, PlaceThatIsNearEnoughIsOneOfTheModel) {
  constexpr std::uint64_t kSeed = 3;
  SCOPED_TRACE(testing::Message() << "seed " << kSeed);
  const auto ball = modelled_ball(8);
  Random random(kSeed);
  int inexact = 0;
  for (int i = 0; i < 1000; ++i) {
    const VertexId v = random_smooth_vertex(ball.mesh, random);
    const Vec3 guess =
        ball.mesh.points[v] + random.between(0, 0.05) * test::random_direction(random);
    const std::span<const Anchor> hint(&ball.mesh.anchors[v], 1);
    const SurfacePoint exact = ball.model.place(guess, 0, hint);
    for (const double enough : {0.1, 1.0, 5.0}) {
      const SurfacePoint s = ball.model.place(guess, 0, hint, enough);
      EXPECT_NEAR(s.distance2, distance2(s.point, guess), 1e-15);
      EXPECT_LT(distance(at(ball.model, s.anchor), s.point), kAnchorRounding);
      const double tolerance = enough * ball.model.tolerance(s.anchor);
      EXPECT_LE(std::sqrt(s.distance2), std::max(tolerance, std::sqrt(exact.distance2)) + 1e-12);
      inexact += s.distance2 > exact.distance2;
    }
  }
  EXPECT_GT(inexact, 0);  // else nothing would be saved
}

TEST(SurfaceModel, PlaceKeepsToThePatch) {
  const auto cube = modelled_cube(2);
  for (std::size_t t = 0; t < cube.mesh.triangles.size(); ++t) {
    const Triangle& s = cube.mesh.triangles[t];
    const Anchor hint{std::int32_t(t), 0.25f, 0.25f};
    const SurfacePoint here = cube.model.place({0.5, 0.5, 0.5}, s.patch, {&hint, 1});
    EXPECT_DOUBLE_EQ(here.distance2, 0.25);
    const SurfacePoint elsewhere = cube.model.place({0.5, 0.5, 0.5}, s.patch + 1, {&hint, 1});
    EXPECT_EQ(elsewhere.distance2, std::numeric_limits<double>::infinity());
    EXPECT_EQ(elsewhere.anchor.facet, kNone);
  }
}

TEST(SurfaceModel, PlaceOnCurveFollowsTheRim) {
  const auto cylinder = modelled_cylinder(8);
  EXPECT_EQ(cylinder.patches, 3);
  // 32 chords around: a circle's cubic is off by far less than the chord's height.
  const double height = 1 - std::cos(std::numbers::pi / 32);
  Random random(3);
  for (std::size_t v = 0; v < cylinder.mesh.points.size(); ++v) {
    if (!(cylinder.mesh.vertex_tags[v] & tag::kRidge)) continue;
    EXPECT_FALSE(cylinder.mesh.vertex_tags[v] & tag::kCorner);
    const double angle = random.between(0, 2 * std::numbers::pi);
    const Vec3 wanted{std::cos(angle), std::sin(angle), cylinder.mesh.points[v].z};
    // The walk downhill along the rim is sure from within a half turn.
    if (dot(wanted, cylinder.mesh.points[v]) < wanted.z * wanted.z) continue;
    const SurfacePoint s = cylinder.model.place_on_curve(
        1.01 * wanted - Vec3{0, 0, 0.01 * wanted.z}, {&cylinder.mesh.anchors[v], 1});
    EXPECT_TRUE(SurfaceModel::is_curve(s.anchor));
    EXPECT_LT(distance(s.point, wanted), height) << "seed 3, vertex " << v;
    EXPECT_LT(std::abs(std::hypot(s.point.x, s.point.y) - 1), 0.3 * height);
  }
}

TEST(SurfaceModel, PlaceOnCurveBetweenCornersFindsTheirEdge) {
  const auto cube = modelled_cube(1);
  for (const Triangle& t : cube.mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      if (!(t.edge_tag[k] & tag::kRidge)) continue;
      const VertexId a = t.v[(k + 1) % 3], b = t.v[(k + 2) % 3];
      const Vec3 middle = (cube.mesh.points[a] + cube.mesh.points[b]) / 2;
      const Anchor hints[2] = {cube.mesh.anchors[a], cube.mesh.anchors[b]};
      const SurfacePoint s = cube.model.place_on_curve(middle, hints);
      EXPECT_LT(distance(s.point, middle), 1e-15);
    }
}

TEST(SurfaceModel, NormalsOfABallPointOutwards) {
  const auto ball = modelled_ball(8);
  for (std::size_t v = 0; v < ball.mesh.points.size(); ++v) {
    const Anchor& a = ball.mesh.anchors[v];
    if (a.facet == kNone) continue;
    EXPECT_GT(dot(ball.model.normal(a, 0), normalized(ball.mesh.points[v])), 0.98);
  }
}

TEST(SurfaceModel, SizesFollowTheCurvature) {
  // sqrt(9 eps R / 2), the paper's section 4.2, for radius 1.
  const double wanted = std::sqrt(4.5 * test::kSettings.tolerance);
  const auto ball = modelled_ball(8);
  for (const Anchor& a : ball.mesh.anchors)
    if (a.facet != kNone) {
      EXPECT_NEAR(ball.model.size(a), wanted, 0.1 * wanted);
    }
  const auto cylinder = modelled_cylinder(8);
  for (std::size_t v = 0; v < cylinder.mesh.points.size(); ++v) {
    const Anchor& a = cylinder.mesh.anchors[v];
    if (a.facet == kNone) continue;
    const Vec3& p = cylinder.mesh.points[v];
    const bool on_lid = p.x * p.x + p.y * p.y < 1 - 1e-9;
    // The lids are the two sides of a wall of thickness 1.
    const double expected = on_lid ? 1.4 : wanted;
    EXPECT_NEAR(cylinder.model.size(a), expected, 0.1 * expected);
  }
}

TEST(SurfaceModel, SizesOfASheetAreNotThoseOfTheCurvesAroundIt) {
  const double wanted = std::sqrt(4.5 * test::kSettings.tolerance);
  const auto cylinder = modelled_cylinder(4);
  int on_lids = 0;
  for (std::size_t f = 0; f < cylinder.model.facets(); ++f) {
    const Anchor middle{std::int32_t(f), 1.f / 3, 1.f / 3};
    const double z = cylinder.model.at(middle).z;
    const bool on_lid = z == 0 || z == 1;
    on_lids += on_lid;
    const double expected = on_lid ? test::kSettings.hmax : wanted;
    EXPECT_NEAR(cylinder.model.curved_size(middle), expected, 0.1 * expected);
  }
  EXPECT_GT(on_lids, 0);
  for (std::size_t v = 0; v < cylinder.mesh.points.size(); ++v)
    if (cylinder.mesh.vertex_tags[v] & tag::kRidge) {
      EXPECT_NEAR(cylinder.model.curved_size(cylinder.mesh.anchors[v]), wanted, 0.1 * wanted);
    }
}

/// A box of n x n x 1 cells, `thickness` high.
MeshData plate(int n, double thickness) {
  MeshData data = kuhn_cube(n);
  std::erase_if(data.tets, [&](const auto& t) {
    return std::any_of(t.begin(), t.end(), [&](int v) { return data.vertices[v].z > 1.5 / n; });
  });
  data.tet_refs.resize(data.tets.size());
  for (Vec3& p : data.vertices) p.z *= n * thickness;
  return data;
}

TEST(SurfaceModel, ThinWallsWantSizesOfTheirThickness) {
  constexpr double kThick = 0.02;
  const auto thin = modelled(build(plate(5, kThick)).mesh);
  for (const Anchor& a : thin.mesh.anchors) {
    EXPECT_LE(thin.model.size(a), 1.5 * kThick);
    EXPECT_GE(thin.model.size(a), kThick);
    EXPECT_EQ(thin.model.curved_size(a), test::kSettings.hmax);
  }
  // No wall: the sides of a cube are farther from each other than the sizes that they want.
  const auto thick = modelled_cube(3);
  for (const Anchor& a : thick.mesh.anchors)
    EXPECT_GE(thick.model.size(a), a.facet == kNone ? 0 : 1);
}

/// A cube of three layers of tets, the middle one thin and of another reference than those beside
/// it; which way the normals of an interface point follows from the order of the references.
TetMesh layered(const std::array<std::int32_t, 3>& refs, double thickness) {
  MeshData data = kuhn_cube(3);
  for (std::size_t t = 0; t < data.tets.size(); ++t) {
    double z = 0;
    for (const int v : data.tets[t]) z += data.vertices[std::size_t(v)].z / 4;
    data.tet_refs[t] = refs[std::size_t(3 * z)];
  }
  for (Vec3& p : data.vertices)
    p.z = p.z < 0.5 ? 1.5 * p.z : 0.5 + (p.z > 0.9 ? 0.5 : 0) + thickness;
  return build(data).mesh;
}

TEST(SurfaceModel, ThinLayersWantSizesOfTheirThicknessWhicheverTheirReferences) {
  constexpr double kThick = 0.02;
  for (const auto& refs : {std::array{1, 2, 3},
                           {1, 3, 2},
                           {2, 1, 3},
                           {2, 3, 1},
                           {3, 1, 2},
                           {3, 2, 1},
                           {1, 2, 1},
                           {2, 1, 2}}) {
    const auto thin = modelled(layered(refs, kThick));
    for (std::size_t v = 0; v < thin.mesh.points.size(); ++v) {
      const double z = thin.mesh.points[v].z;
      if (z < 0.49 || z > 0.53) continue;
      EXPECT_LE(thin.model.size(thin.mesh.anchors[v]), 1.5 * kThick) << refs[0] << refs[1];
      EXPECT_GE(thin.model.size(thin.mesh.anchors[v]), kThick);
    }
  }
}

TEST(SurfaceModel, ToleranceKeepsSheetsApart) {
  // Two cubes with a gap between them that is as wide as the tolerance.
  constexpr double kGap = test::kSettings.tolerance;
  MeshData data = kuhn_cube(2);
  const MeshData other = data;
  const auto shift = std::int32_t(data.vertices.size());
  for (const Vec3& p : other.vertices) data.vertices.push_back(p + Vec3{1 + kGap, 0, 0});
  data.vertex_refs.resize(data.vertices.size());
  for (auto t : other.tets) {
    for (auto& v : t) v += shift;
    data.tets.push_back(t);
  }
  data.tet_refs.resize(data.tets.size());
  const auto two = modelled(build(data).mesh);
  for (const Triangle& t : two.mesh.triangles) {
    bool at_gap = true;
    for (VertexId v : t.v) at_gap &= std::abs(two.mesh.points[v].x - 1) < 2 * kGap;
    const Anchor hints[3] = {two.mesh.anchors[t.v[0]], two.mesh.anchors[t.v[1]],
                             two.mesh.anchors[t.v[2]]};
    Vec3 middle{};
    for (VertexId v : t.v) middle += two.mesh.points[v] / 3;
    const double tolerance = two.model.tolerance(two.model.place(middle, t.patch, hints).anchor);
    if (at_gap) {
      EXPECT_LT(tolerance, kGap / 4);
    } else {
      EXPECT_FLOAT_EQ(float(tolerance), float(test::kSettings.tolerance));
    }
  }
}

/// The unit cube, cut open from above down to its middle at x = 0.5.
MeshData cube_with_slit(double angle) {
  MeshData data = kuhn_cube(2);
  std::map<std::int32_t, std::int32_t> right_of;
  for (auto& tet : data.tets) {
    Vec3 middle;
    for (const std::int32_t v : tet) middle += data.vertices[v] / 4;
    if (middle.x < 0.5 || middle.z < 0.5) continue;
    for (auto& v : tet) {
      if (data.vertices[v].x != 0.5 || data.vertices[v].z != 1) continue;
      const auto [at, is_new] = right_of.try_emplace(v, std::int32_t(data.vertices.size()));
      if (is_new) data.vertices.push_back(data.vertices[v]);
      v = at->second;
    }
  }
  for (const auto& [left, right] : right_of) {
    data.vertices[left].x -= angle / 4;
    data.vertices[right].x += angle / 4;
  }
  data.vertex_refs.resize(data.vertices.size());
  return data;
}

TEST(SurfaceModel, ToleranceKeepsTheSidesOfASlitApart) {
  constexpr double kAngle = 0.002, kHeight = 0.5;
  const auto cube = modelled(build(cube_with_slit(kAngle)).mesh);
  int at_slit = 0;
  for (const Triangle& t : cube.mesh.triangles) {
    Vec3 middle{};
    for (VertexId v : t.v) middle += cube.mesh.points[v] / 3;
    const Anchor hints[3] = {cube.mesh.anchors[t.v[0]], cube.mesh.anchors[t.v[1]],
                             cube.mesh.anchors[t.v[2]]};
    const double tolerance = cube.model.tolerance(cube.model.place(middle, t.patch, hints).anchor);
    if (std::abs(middle.x - 0.5) < kAngle && middle.z > 0.5 && middle.z < 1) {
      ++at_slit;
      EXPECT_LT(tolerance, kAngle * kHeight / 4);
    } else {
      EXPECT_FLOAT_EQ(float(tolerance), float(test::kSettings.tolerance));
    }
  }
  EXPECT_EQ(at_slit, 8);
}

TEST(SurfaceModel, TolerancesFollowReferences) {
  TetMesh mesh = build(kuhn_cube(2)).mesh;
  for (Triangle& t : mesh.triangles) t.ref = mesh.points[t.v[0]].z == 1 ? 7 : 3;
  classify_features(mesh, {});
  const std::pair<std::int32_t, double> other[] = {{7, 0.25}};
  SurfaceModel::Settings settings = test::kSettings;
  settings.tolerance_of_reference = other;
  const SurfaceModel model(mesh, settings);
  for (std::size_t f = 0; f < model.facets(); ++f)
    EXPECT_FLOAT_EQ(float(model.hausd(std::int32_t(f))),
                    mesh.triangles[f].ref == 7 ? 0.25f : float(settings.tolerance));
}

}  // namespace
}  // namespace cavea
