#include <cmath>
#include <nlohmann/json.hpp>

#include "run_program.h"

namespace cavea::test {
namespace {

using Json = nlohmann::json;

constexpr const char* kSample = CAVEA_SOURCE "/tools/sample/bracket.mesh";

class InfoTest : public ProgramTest {
 protected:
  Json info(const std::string& name, int expected_status) {
    const Outcome outcome = cavea({"info", name, "--json", "info.json"});
    EXPECT_EQ(outcome.status, expected_status) << outcome.out << outcome.err;
    return Json::parse(read_text(file("info.json")));
  }
  std::string replaced(std::string text, const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
    return text;
  }
};

TEST_F(InfoTest, MeasuresACubeOfSixTets) {
  write_text(file("cube.mesh"), cube_text());
  const Json cube = info("cube.mesh", 0);
  EXPECT_TRUE(cube["sound"]);
  EXPECT_EQ(cube["counts"]["vertices"], 8);
  EXPECT_EQ(cube["counts"]["tets"], 6);
  EXPECT_EQ(cube["counts"]["triangles"], 12);
  EXPECT_EQ(cube["counts"]["components"], 1);
  EXPECT_NEAR(cube["counts"]["volume"], 1, 1e-12);
  // 72 sqrt3 / 6 / (3 + 2 * 2 + 3)^1.5: edges of length 1 (three), sqrt2 (two), sqrt3 (one).
  EXPECT_NEAR(cube["quality"]["worst"], 72 * std::sqrt(3.0) / 6 / std::pow(10.0, 1.5), 1e-6);
  EXPECT_NEAR(cube["dihedral"]["smallest"], 45, 1e-6);
  EXPECT_NEAR(cube["dihedral"]["largest"], 90, 1e-6);
  EXPECT_EQ(cube["edge_lengths"]["edges"], 19);
  EXPECT_NEAR(cube["edge_lengths"]["shortest"], 1, 1e-6);
  EXPECT_NEAR(cube["edge_lengths"]["longest"], std::sqrt(3.0), 1e-6);
  EXPECT_TRUE(cube["lengths"].is_null());
}

TEST_F(InfoTest, MeasuresTheSampleByReference) {
  const Json sample = info(kSample, 0);
  EXPECT_EQ(sample["counts"]["tet_references"].size(), 2u);
  EXPECT_EQ(sample["counts"]["triangle_references"].size(), 11u);
  EXPECT_LT(sample["quality"]["worst"], 0.02) << "ill-shaped on purpose";
  EXPECT_LT(sample["quality"]["mean"], 0.4);
}

TEST_F(InfoTest, KnowsTheLengthsInTheSizesBesideTheFile) {
  write_text(file("cube.mesh"), cube_text());
  write_text(file("cube.sol"),
             "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n8\n1 1\n"
             "2 2 2 2 2 2 2 2\nEnd\n");
  const Json cube = info("cube.mesh", 0);
  EXPECT_NEAR(cube["lengths"]["shortest"], 0.5, 1e-6);
  EXPECT_NEAR(cube["edge_lengths"]["shortest"], 1, 1e-6);
}

TEST_F(InfoTest, TurnedAndFlatTetsAreNotSound) {
  write_text(file("turned.mesh"), replaced(cube_text(), "1 2 4 8 1", "2 1 4 8 1"));
  EXPECT_FALSE(info("turned.mesh", 1)["sound"]);
  write_text(file("flat.mesh"), replaced(cube_text(), "1 2 4 8 1", "1 2 4 3 1"));
  EXPECT_FALSE(info("flat.mesh", 1)["sound"]);
}

TEST_F(InfoTest, AFaceInThreeTetsIsNotSound) {
  write_text(file("thrice.mesh"), replaced(cube_text(), "1 6 2 8 1", "1 2 8 3 1"));
  const Json thrice = info("thrice.mesh", 1);
  EXPECT_FALSE(thrice["sound"]);
  EXPECT_EQ(thrice["violations"].size(), 1u);
}

}  // namespace
}  // namespace cavea::test
