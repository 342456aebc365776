// Files of local parameters: both formats say the same, and what is wrong is told with its place.
#include "parameters.h"

#include <gtest/gtest.h>

#include "cavea/base/error.h"
#include "run_program.h"

namespace cavea::test {
namespace {

using program::Parameters;
using Entity = LocalParameters::Entity;

constexpr const char* kJson = R"({
  "local": [
    {"triangles": 3, "hmin": 0.1, "hmax": 0.5, "hausd": 0.001},
    {"tetrahedra": -2, "hmax": 1.5}
  ],
  "regions": [
    {"box": [[0, 0, 0], [10, 5, 5]], "size": 0.4},
    {"sphere": {"center": [20, 0, 0], "radius": 3}, "size": 0.2}
  ]
})";

constexpr const char* kMmg = "Parameters\n2\n\n3 Triangles 0.1 0.5 0.001\n-2 tetrahedra 1 1.5 9\n";

/// What both texts say first.
void expect_first(const LocalParameters& local) {
  EXPECT_EQ(local.entity, Entity::kTriangles);
  EXPECT_EQ(local.reference, 3);
  EXPECT_EQ(local.hmin, 0.1);
  EXPECT_EQ(local.hmax, 0.5);
  EXPECT_EQ(local.hausd, 0.001);
}

TEST(Parameters, OfJsonAreRead) {
  const Parameters p = program::parse_parameters_json(kJson, "p.json");
  ASSERT_EQ(p.local.size(), 2u);
  expect_first(p.local[0]);
  EXPECT_EQ(p.local[1].entity, Entity::kTets);
  EXPECT_EQ(p.local[1].reference, -2);
  EXPECT_FALSE(p.local[1].hmin);
  EXPECT_EQ(p.local[1].hmax, 1.5);
  ASSERT_EQ(p.regions.size(), 2u);
  const SizeBox& box = std::get<SizeBox>(p.regions[0]);
  EXPECT_EQ(box.high, (Vec3{10, 5, 5}));
  EXPECT_EQ(box.size, 0.4);
  const SizeSphere& sphere = std::get<SizeSphere>(p.regions[1]);
  EXPECT_EQ(sphere.center, (Vec3{20, 0, 0}));
  EXPECT_EQ(sphere.radius, 3);
  EXPECT_EQ(sphere.size, 0.2);
}

TEST(Parameters, OfMmgAreRead) {
  const Parameters p = program::parse_parameters_mmg3d(kMmg, "p.mmg3d");
  ASSERT_EQ(p.local.size(), 2u);
  expect_first(p.local[0]);
  EXPECT_EQ(p.local[1].entity, Entity::kTets);
  EXPECT_EQ(p.local[1].hmax, 1.5);
  EXPECT_FALSE(p.local[1].hausd) << "it has no meaning";
}

std::string edited(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the text has no " + from);
  return text.replace(at, from.size(), to);
}

template <class Parse>
void expect_refused(Parse&& parse, const std::string& text, const std::string& named) {
  try {
    parse(text, "p");
    ADD_FAILURE() << "taken: " << text;
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()).rfind("p: ", 0), 0u) << e.what();
    EXPECT_NE(std::string(e.what()).find(named), std::string::npos) << e.what();
  }
}

TEST(Parameters, OfJsonAreRefusedWithTheirPlace) {
  const auto expect = [](const std::string& from, const std::string& to, const std::string& named) {
    expect_refused(program::parse_parameters_json, edited(kJson, from, to), named);
  };
  expect("\"local\"", "\"locals\"", "/: the key \"locals\" is not known");
  expect("\"hmax\": 1.5", "\"hmaxx\": 1.5", "/local/1: the key \"hmaxx\" is not known");
  expect("1.5", "\"1.5\"", "/local/1/hmax: a number is due");
  expect("1.5", "-1.5", "/local/1: hmax must be a positive number");
  expect("1.5", "1.5, \"hausd\": 1", "/local/1: hausd is of triangles");
  expect("1.5", "1.5, \"triangles\": 1", "/local/1: one of the keys \"triangles\"");
  expect(", \"hmax\": 1.5", "", "/local/1: tetrahedra of reference -2 have no parameter");
  expect("0.5", "0.05", "/local/0: hmin 0.1 is larger than hmax 0.05");
  expect("3, \"hmin\"", "3.5, \"hmin\"", "/local/0/triangles: a whole number");
  expect("3, \"hmin\"", "4294967296, \"hmin\"", "/local/0/triangles: a whole number");
  expect("\"hmax\": 0.5", "\"hmin\": 0.5", "the key \"hmin\" is given twice");
  expect(", \"size\": 0.4", "", "/regions/0: the key \"size\" is missing");
  expect("0.4", "0", "/regions/0: the size of a region must be a positive number");
  expect("[10, 5, 5]", "[10, 5]", "/regions/0/box/1: an array of 3 is due");
  expect("[10, 5, 5]", "[10, 0, 5]", "/regions/0: a box must");
  expect("\"radius\": 3", "\"radius\": 0", "/regions/1: the radius");
  expect("\"radius\": 3", "\"diameter\": 3", "/regions/1/sphere: the key \"diameter\"");
  expect("]\n}", "]\n", "line ");
  expect_refused(program::parse_parameters_json, "[]", "/: an object is due");
  expect_refused(program::parse_parameters_json, R"({"local": {}})", "/local: an array is due");
  expect_refused(program::parse_parameters_json, "", "line 1");
}

TEST(Parameters, OfMmgAreRefusedWithTheirLine) {
  const auto expect = [](const std::string& from, const std::string& to, const std::string& named) {
    expect_refused(program::parse_parameters_mmg3d, edited(kMmg, from, to), named);
  };
  expect("Parameters", "LSReferences", "line 1: the keyword Parameters is due");
  expect("\n2\n", "\n3\n", "ends where a reference is due");
  expect("\n2\n", "\n1\n", "line 5: '-2' comes after the 1 rows");
  expect("\n2\n", "\ntwo\n", "line 2: the number of rows is due, not 'two'");
  expect("Triangles", "Vertices", "line 4: 'vertices'");
  expect("3 Triangles", "3.5 Triangles", "line 4: a reference is due, not '3.5'");
  expect("0.5", "0.05", "line 4: hmin 0.1 is larger than hmax 0.05");
  expect("0.001", "nan", "line 4: hausd must be a positive number");
  expect("1.5 9", "x 9", "line 5: hmax is due, not 'x'");
}

class ParametersFile : public ProgramTest {};

TEST_F(ParametersFile, IsFoundByItsExtension) {
  write_text(file("p.json"), kJson);
  write_text(file("p.mmg3d"), kMmg);
  write_text(file("p.txt"), kMmg);
  EXPECT_EQ(program::read_parameters(file("p.json")).regions.size(), 2u);
  EXPECT_EQ(program::read_parameters(file("p.mmg3d")).local.size(), 2u);
  EXPECT_THROW(program::read_parameters(file("p.txt")), InputError);
  EXPECT_THROW(program::read_parameters(file("missing.json")), InputError);
}

TEST_F(ParametersFile, MayNotContradictItself) {
  write_text(file("p.mmg3d"), "parameters 2 3 triangle 1 2 1 3 triangles 1 3 1");
  EXPECT_THROW(program::read_parameters(file("p.mmg3d")), InputError);
}

TEST_F(ParametersFile, IsObeyedByTheProgram) {
  write_text(file("in.mesh"), cube_text());
  write_text(file("p.json"),
             R"({"regions": [{"sphere": {"center": [1, 1, 1], "radius": 0.2}, "size": 0.03}]})");
  const Outcome outcome = cavea(
      {"remesh", "in.mesh", "-o", "out.mesh", "--params", "p.json", "--report", "report.json"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(read_text(file("report.json")).find("\"params\": \"p.json\""), std::string::npos);
  EXPECT_GT(read_text(file("out.mesh")).size(), 100000u) << "fine at the corner";
  write_text(file("bad.json"), R"({"regions": [{"size": 1}]})");
  const Outcome bad = cavea({"remesh", "in.mesh", "-o", "bad.mesh", "--params", "bad.json"});
  EXPECT_EQ(bad.status, 2);
  EXPECT_NE(bad.err.find("bad.json: /regions/0"), std::string::npos) << bad.err;
  EXPECT_EQ(
      cavea({"remesh", "in.mesh", "-o", "bad.mesh", "--params", "p.json", "--hsiz", "1"}).status,
      2);
}

}  // namespace
}  // namespace cavea::test
