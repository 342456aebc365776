// Tets that stay bad are named, with what every operator says and what about the domain forbids
// better.
#include <array>
#include <map>

#include "remesh/support.h"

namespace cavea::test {
namespace {

/// A prism on a triangle with an angle of so many degrees at the z axis.
MeshData wedge(double degrees) {
  const double y = std::tan(degrees * std::numbers::pi / 180);
  MeshData data;
  for (const double z : {0.0, 1.0}) {
    data.vertices.push_back({0, 0, z});
    data.vertices.push_back({1, 0, z});
    data.vertices.push_back({1, y, z});
  }
  data.vertex_refs.assign(6, 0);
  data.tets = {{0, 1, 2, 3}, {1, 2, 3, 4}, {2, 3, 4, 5}};
  data.tet_refs.assign(3, 1);
  return data;
}

bool says(const StubbornTet& t, const std::string& what) {
  return t.reason.find(what) != std::string::npos;
}

TEST(Stubborn, TetsInASharpWedgeAreNamedWithItsAngle) {
  const Report report = report_of(wedge(8), uniform(0.1));
  ASSERT_FALSE(report.stubborn.empty());
  const auto& bins = report.after.quality.histogram;
  EXPECT_EQ(std::int64_t(report.stubborn.size()), bins[0] + bins[1] + bins[2]);
  EXPECT_NEAR(report.stubborn[0].quality, report.after.quality.worst, 1e-6);
  EXPECT_EQ(report.stubborn[0].where, report.after.quality.worst_place);
  int sharp = 0;
  for (std::size_t i = 0; i < report.stubborn.size(); ++i) {
    const StubbornTet& t = report.stubborn[i];
    EXPECT_LT(t.quality, 0.3);
    if (i > 0) {
      EXPECT_GE(t.quality, report.stubborn[i - 1].quality);
    }
    sharp += says(t, "the surface meets itself at 8 degrees");
  }
  EXPECT_GT(sharp, 0);
}

TEST(Stubborn, AWedgeThatIsBluntEnoughIsNoReason) {
  for (const StubbornTet& t : report_of(wedge(14), uniform(0.1)).stubborn)
    EXPECT_FALSE(says(t, "meets itself")) << t.reason;
}

TEST(Stubborn, WhatTheCallerWantsLeftIsAReason) {
  const auto expect_all_say = [](const MeshData& data, const Options& options,
                                 const std::string& what) {
    const Report report = report_of(data, options);
    ASSERT_FALSE(report.stubborn.empty());
    for (const StubbornTet& t : report.stubborn) EXPECT_TRUE(says(t, what)) << t.reason;
  };
  MeshData data = kuhn_cube(4);
  Options options = uniform(0.25);
  options.min_quality = 1;  // the worst are named, whatever they are
  options.freeze.swap = options.freeze.move = true;
  expect_all_say(data, options, "nothing is to be swapped or moved");
  options.freeze = {};
  for (std::size_t t = 0; t < data.tets.size(); ++t) data.required_tets.push_back(std::int32_t(t));
  expect_all_say(data, options, "the tetrahedron is required");
}

TEST(Stubborn, EveryOperatorIsAsked) {
  const std::map<std::string, std::int64_t> kQuestions = {
      {"edge_split", 6}, {"edge_collapse", 12}, {"edge_swap", 6}, {"edge_star", 6},
      {"face_swap", 4},  {"relocate", 4},       {"reconnect", 1}};
  const Report report = report_of(wedge(8), uniform(0.1));
  for (const StubbornTet& t : report.stubborn) {
    std::map<std::string, std::int64_t> asked;
    for (const VerdictCount& v : t.verdicts) asked[v.op] += v.count;
    EXPECT_EQ(asked, kQuestions);
  }
}

TEST(Stubborn, WhatIsFrozenIsNotAsked) {
  Options options = uniform(0.1);
  options.freeze.swap = options.freeze.move = true;
  const Report report = report_of(wedge(8), options);
  ASSERT_FALSE(report.stubborn.empty());
  for (const StubbornTet& t : report.stubborn)
    for (const VerdictCount& v : t.verdicts)
      EXPECT_TRUE(v.op != "edge_swap" && v.op != "face_swap" && v.op != "reconnect" &&
                  v.op != "relocate")
          << v.op;
}

TEST(Stubborn, TetsAcrossAThinWallAreNamedWithItsThickness) {
  const Report report = report_of(thin_wall(), uniform(0.2));
  ASSERT_FALSE(report.stubborn.empty());
  int thin = 0;
  for (const StubbornTet& t : report.stubborn) thin += says(t, "the wall is 0.02");
  EXPECT_GT(thin, 0);
}

TEST(Stubborn, TetsAtTheTipBetweenTwoCurvesAreNamedWithItsAngle) {
  // A pyramid upside down; its flat top has a triangle of its own reference with a sharp tip.
  const double y = std::tan(8 * std::numbers::pi / 180);
  MeshData data;
  data.vertices = {{0, 0, 0}, {1, 0, 0}, {1, y, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, -1}};
  data.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
  data.triangle_refs = {5, 6, 6};
  for (const auto& [a, b, c] : data.triangles) data.tets.push_back({a, b, c, 5});
  data.vertex_refs.assign(6, 0), data.tet_refs.assign(3, 1);
  Options options = uniform(0.05);
  options.freeze.join = true;  // else they run together for a while
  const Report report = report_of(data, options);
  ASSERT_FALSE(report.stubborn.empty());
  EXPECT_TRUE(says(report.stubborn[0], "feature curves meet at 8 degrees"))
      << report.stubborn[0].reason;
}

/// A roof with a narrow flat ridge of this width.
MeshData roof(double width) {
  const std::array<double, 4> x = {0, 0.5 - width / 2, 0.5 + width / 2, 1};
  return mapped(kuhn_cube(3), [&](const Vec3& p) {
    const auto i = std::size_t(std::lround(3 * p.x));
    return Vec3{x[i], p.y, i % 3 == 0 ? 0.3 * p.z : p.z};
  });
}

TEST(Stubborn, TetsAtANarrowStripBetweenCurvesAreNamedWithItsWidth) {
  // Too narrow for the finest size, too, which is 0.03 of the wanted one, and too wide to be
  // joined.
  Options options = uniform(0.05);
  options.hausd = 1e-5;
  const Report report = report_of(roof(0.0002), options);
  ASSERT_FALSE(report.stubborn.empty());
  int narrow = 0;
  for (const StubbornTet& t : report.stubborn) {
    EXPECT_NE(t.reason, "");
    narrow += says(t, "between feature curves is 0.0002 wide, 0.004 of the wanted length");
  }
  EXPECT_GT(narrow, 0);
}

// The crest of a wave is rounder than edges of the wanted size can follow.
TEST(Stubborn, TetsWhereTheSurfaceBendsBetweenVerticesAreNamed) {
  const MeshData crest = mapped(kuhn_cube(20), [](const Vec3& p) {
    const double x = (p.x - 0.5 - 0.1 * p.y) / 0.05;
    return Vec3{p.x, p.y, p.z * (0.5 + 0.15 * std::exp(-x * x))};
  });
  Options options = uniform(0.2);
  options.detect_ridges = false;
  options.hausd = 0.002;
  options.min_quality = 0.6;  // so that the worst are named though they are sound
  const std::vector<StubbornTet> stubborn = report_of(crest, options).stubborn;
  const auto named = [&](const std::string& what) {
    return std::ranges::count_if(stubborn, [&](const StubbornTet& t) { return says(t, what); });
  };
  EXPECT_GT(named("the surface bends within"), 0);
  EXPECT_GT(named("triangles of the wanted size are"), 0);
}

TEST(Stubborn, AreNoneInAGoodMesh) {
  const Report report = report_of(kuhn_cube(4), uniform(0.1));
  EXPECT_GE(report.after.quality.worst, 0.3);
  EXPECT_TRUE(report.stubborn.empty());
}

TEST(Stubborn, IsWhatIsBelowTheTarget) {
  Options options = uniform(0.1);
  options.min_quality = 0.8;
  const Report report = report_of(kuhn_cube(4), options);
  EXPECT_EQ(report.stubborn.size(), 20u);
}

}  // namespace
}  // namespace cavea::test
