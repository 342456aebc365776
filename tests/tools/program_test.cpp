// Runs of the program that do something: statuses, files, reports.
#include <signal.h>

#include <nlohmann/json.hpp>

#include "cavea/io/formats.h"
#include "run_program.h"
#include "support/meshes.h"

namespace cavea::test {
namespace {

using Json = nlohmann::json;
using Files = std::set<std::string>;

constexpr const char* kSample = CAVEA_SOURCE "/tools/sample/bracket.mesh";

class RunTest : public ProgramTest {
 protected:
  Json read_json(const std::string& name) const { return Json::parse(read_text(file(name))); }
};

TEST_F(RunTest, RemeshesTheSampleWithinAllTargets) {
  const Outcome outcome = cavea({"remesh", kSample, "-o", "out.mesh", "-o", "out.meshb"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(files(), (Files{"out.mesh", "out.sol", "out.meshb", "out.solb"}));
  for (const char* word : {"before", "after", "worst quality", "conforming", "tets/s", "hausd",
                           "peak memory", "written out.mesh\n"})
    EXPECT_NE(outcome.out.find(word), std::string::npos) << word;
  for (const char* name : {"out.mesh", "out.meshb"}) EXPECT_EQ(cavea({"info", name}).status, 0);
}

TEST_F(RunTest, GivesTheSameBytesAtAnyNumberOfThreads) {
  ASSERT_EQ(cavea({"remesh", kSample, "-o", "1.meshb", "--threads", "1"}).status, 0);
  const std::string expected = read_text(file("1.meshb"));
  for (const char* threads : {"2", "3", "8"}) {
    ASSERT_EQ(cavea({"remesh", kSample, "-o", "n.meshb", "--threads", threads}).status, 0);
    EXPECT_TRUE(read_text(file("n.meshb")) == expected) << threads << " threads";
  }
}

TEST_F(RunTest, MissedTargetIsStatusOneAndNamed) {
  const Outcome outcome = cavea({"remesh", kSample, "-o", "out.mesh", "--min-quality", "0.99",
                                 "--report", "report.json", "--quiet"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("target missed: worst quality"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(files(), (Files{"out.mesh", "out.sol", "report.json"}));
  const Json report = read_json("report.json");
  EXPECT_FALSE(report["targets_met"]);
  bool found = false;
  for (const Json& target : report["targets"])
    if (target["name"] == "worst quality") {
      found = true;
      EXPECT_FALSE(target["met"]);
      EXPECT_EQ(target["wanted"], 0.99);
      EXPECT_NE(target["where"], "");
    }
  EXPECT_TRUE(found);
  EXPECT_EQ(cavea({"info", "out.mesh"}).status, 0) << "a valid mesh is written all the same";
}

TEST_F(RunTest, NamesEveryFlatTetThatIsLeft) {
  // 54 of no volume that must stay as they are; no other target forbids them.
  write_mesh(file("in.meshb"), cube_with_flat_tets(7, true));
  const Outcome outcome = cavea({"remesh", "in.meshb", "-o", "out.meshb", "--report", "report.json",
                                 "--min-quality", "0", "--min-conform", "0", "--quiet"});
  EXPECT_EQ(outcome.status, 1);
  const Json quality = read_json("report.json")["after"]["quality"];
  EXPECT_EQ(quality["worst"], 0);
  const MeshData out = read_mesh(file("out.meshb"), nullptr);
  std::set<std::int32_t> named;
  for (const Json& flat : quality["flat_tets"]) named.insert(flat["tet"].get<std::int32_t>() - 1);
  EXPECT_EQ(named, std::set(out.required_tets.begin(), out.required_tets.end()));
  EXPECT_EQ(named.size(), 54u);

  EXPECT_NE(outcome.err.find("target missed: flat tetrahedra: 54"), std::string::npos);
  std::size_t lines = 0;
  for (auto at = outcome.err.find("flat: tetrahedron"); at != std::string::npos;
       at = outcome.err.find("flat: tetrahedron", at + 1))
    ++lines;
  EXPECT_EQ(lines, 20u) << outcome.err;
  EXPECT_NE(outcome.err.find("and 34 more"), std::string::npos) << outcome.err;
}

TEST_F(RunTest, WritesNormalsAndTangents) {
  ASSERT_EQ(cavea({"remesh", kSample, "-o", "out.meshb", "--quiet"}).status, 0);
  const MeshData out = read_mesh(file("out.meshb"), nullptr);
  std::set<std::int32_t> surface, told(out.corners.begin(), out.corners.end());
  for (const auto& t : out.triangles) surface.insert(t.begin(), t.end());
  for (const auto& [v, n] : out.normal_at_vertices) {
    EXPECT_TRUE(told.insert(v).second) << "vertex " << v << " is a corner, too";
    EXPECT_NEAR(norm(out.normals[n]), 1, 1e-14);
  }
  for (const auto& [v, t] : out.tangent_at_vertices) {
    told.insert(v);
    EXPECT_NEAR(norm(out.tangents[t]), 1, 1e-14);
  }
  EXPECT_EQ(told, surface);
}

TEST_F(RunTest, TakesALevelSetOfAMeshWithUnusedVertices) {
  MeshData data = kuhn_cube(4);
  std::string values = std::to_string(2 * data.vertices.size()) + " 1 1\n";
  MeshData spread;  // every second vertex is of no tet
  for (const Vec3& p : data.vertices) {
    spread.vertices.insert(spread.vertices.end(), {p, Vec3{9, 9, 9}});
    values += std::to_string(p.z - 0.3) + " 5\n";
  }
  for (auto tet : data.tets) {
    for (auto& v : tet) v *= 2;
    spread.tets.push_back(tet);
  }
  write_mesh(file("in.mesh"), spread);
  write_text(file("phi.sol"),
             "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n" + values + "End\n");
  const Outcome outcome =
      cavea({"implicit", "in.mesh", "--sol", "phi.sol", "-o", "out.meshb", "--report", "r.json"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const Json report = read_json("r.json");
  for (const Json& ref : report["after"]["counts"]["tet_references"])
    EXPECT_NEAR(ref["volume"].get<double>(), ref["reference"] == 3 ? 0.3 : 0.7, 1e-6);
}

TEST_F(RunTest, RidsTheInputOfFlatTets) {
  write_mesh(file("in.meshb"), cube_with_flat_tets(7, false));
  const Outcome outcome =
      cavea({"remesh", "in.meshb", "-o", "out.meshb", "--report", "report.json", "--quiet"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const Json report = read_json("report.json");
  EXPECT_EQ(report["before"]["quality"]["flat_tets"].size(), 54u);
  EXPECT_TRUE(report["after"]["quality"]["flat_tets"].empty());
}

TEST_F(RunTest, QuietPrintsNothing) {
  const Outcome outcome = cavea({"remesh", kSample, "-o", "out.mesh", "--quiet"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "");
}

TEST_F(RunTest, ProgressIsPlainLinesWhereThereIsNoTerminal) {
  const Outcome outcome = cavea({"remesh", kSample, "-o", "out.mesh", "--verbose"});
  EXPECT_NE(outcome.err.find(" tets/s"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find('\r'), std::string::npos);
  EXPECT_EQ(outcome.err.find('\033'), std::string::npos);
  EXPECT_NE(outcome.out.find("verdict"), std::string::npos);
}

TEST_F(RunTest, ReportHoldsWhatTheDocumentationPromises) {
  ASSERT_EQ(cavea({"remesh", kSample, "-o", "out.mesh", "--report", "report.json", "--hausd", "0.2",
                   "--threads", "2"})
                .status,
            0);
  const Json report = read_json("report.json");
  const std::string documentation = read_text(CAVEA_SOURCE "/docs/report.md");
  for (const auto& [key, value] : report.items())
    EXPECT_NE(documentation.find("`" + key + "`"), std::string::npos) << key;
  EXPECT_EQ(report["version"], CAVEA_VERSION);
  EXPECT_EQ(report["input"], kSample);
  EXPECT_EQ(report["outputs"], Json::array({"out.mesh"}));
  EXPECT_EQ(report["options"]["hausd"], 0.2);
  EXPECT_EQ(report["options"]["angle"], 45);
  EXPECT_TRUE(report["options"]["hsiz"].is_null());
  EXPECT_GT(report["options"]["hmax"], report["options"]["hmin"]);
  EXPECT_EQ(report["threads"], 2);
  EXPECT_GT(report["seconds"], 0);
  EXPECT_GT(report["tets_per_second"], 0);
  EXPECT_GT(report["peak_resident_bytes"], 1e6);
  EXPECT_FALSE(report["phases"].empty());
  EXPECT_FALSE(report["verdicts"].empty());
  EXPECT_TRUE(report["targets_met"]);
  EXPECT_EQ(report["targets"].size(), 5u);
  EXPECT_GE(report["surface_distance"], 0);
  EXPECT_GE(report["bulge"], 0);
  EXPECT_TRUE(report["warnings"].is_array());
}

TEST_F(RunTest, HistogramsOfTheReportAddUp) {
  ASSERT_EQ(cavea({"remesh", kSample, "-o", "out.mesh", "--report", "report.json"}).status, 0);
  const Json report = read_json("report.json");
  const auto sum = [](const Json& histogram) {
    std::int64_t total = 0;
    for (const Json& bin : histogram) total += bin.get<std::int64_t>();
    return total;
  };
  EXPECT_EQ(report["before"]["counts"]["tets"], 4428);
  for (const char* state : {"before", "after"}) {
    const Json& mesh = report[state];
    const std::int64_t tets = mesh["counts"]["tets"];
    EXPECT_EQ(sum(mesh["quality"]["histogram"]), tets);
    EXPECT_EQ(sum(mesh["dihedral"]["histogram"]), 6 * tets);
  }
  const Json& lengths = report["after"]["lengths"];
  EXPECT_EQ(sum(lengths["histogram"]), lengths["edges"]);
}

TEST_F(RunTest, TakesItsSizesFromAFile) {
  write_text(file("in.mesh"), cube_text());
  write_text(file("in.sol"),
             "MeshVersionFormatted 2 Dimension 3 SolAtVertices 8 1 1\n"
             "0.2 0.2 0.2 0.2 0.2 0.2 0.2 0.2 End");
  const Outcome outcome =
      cavea({"remesh", "in.mesh", "--sol", "in.sol", "-o", "out.mesh", "--report", "report.json"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const Json report = read_json("report.json");
  EXPECT_EQ(report["options"]["sol"], "in.sol");
  EXPECT_NEAR(report["options"]["hmax"].get<double>(), 0.2, 1e-7);
  EXPECT_GT(report["after"]["counts"]["tets"], 500);
  EXPECT_LT(report["after"]["counts"]["tets"], 2000);
}

TEST_F(RunTest, KeepsToABudget) {
  const Outcome outcome = cavea({"remesh", kSample, "-o", "out.mesh", "--max-tets", "3000",
                                 "--hausd", "0.001", "--report", "report.json"});
  EXPECT_EQ(outcome.status, 1) << "so few cannot hold the surface";
  EXPECT_NE(outcome.err.find("surface distance"), std::string::npos) << outcome.err;
  const Json report = read_json("report.json");
  EXPECT_EQ(report["options"]["max_tets"], 3000);
  EXPECT_NEAR(report["after"]["counts"]["tets"].get<double>(), 3000, 300);
  EXPECT_EQ(report["targets"].size(), 6u);
}

TEST_F(RunTest, RefusesWhatMemoryCannotHold) {
  const Outcome outcome =
      cavea({"remesh", kSample, "-o", "out.mesh", "--hsiz", "1", "--max-memory", "10M"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("0.01 GB may be used"), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(file("out.mesh")));
  EXPECT_EQ(
      cavea({"remesh", kSample, "-o", "out.mesh", "--hsiz", "1e-7", "--max-memory", "1T"}).status,
      2)
      << "beyond what ids can name";
}

TEST_F(RunTest, ReportsWhichGradationsAreOff) {
  write_text(file("in.mesh"), cube_text());
  ASSERT_EQ(cavea({"remesh", "in.mesh", "--optim", "--no-hgrad", "--no-hgradreq", "-o", "out.mesh",
                   "--report", "report.json", "--min-conform", "0"})
                .status,
            0);
  const Json options = read_json("report.json")["options"];
  EXPECT_TRUE(options["hgrad"].is_null());
  EXPECT_TRUE(options["hgradreq"].is_null());
  EXPECT_EQ(options["optim"], true);
}

TEST_F(RunTest, FreezesWhatItIsTold) {
  ASSERT_EQ(cavea({"remesh", kSample, "-o", "out.mesh", "--report", "report.json", "--no-surface",
                   "--no-swap", "--min-quality", "0", "--min-conform", "0"})
                .status,
            0);
  const Json report = read_json("report.json");
  EXPECT_EQ(report["options"]["frozen"], Json::array({"swap", "surface"}));
  EXPECT_FALSE(report["verdicts"].contains("edge_swap"));
  EXPECT_TRUE(report["verdicts"].contains("edge_split"));
  EXPECT_EQ(report["before"]["counts"]["triangles"], report["after"]["counts"]["triangles"]);
}

TEST_F(RunTest, OverwritesAnOlderOutput) {
  write_text(file("out.mesh"), "old");
  ASSERT_EQ(cavea({"remesh", kSample, "-o", "out.mesh"}).status, 0);
  EXPECT_EQ(read_text(file("out.mesh")).substr(0, 4), "Mesh");
  EXPECT_EQ(files(), (Files{"out.mesh", "out.sol"}));
}

TEST_F(RunTest, StoppedBySignalsItWritesNothing) {
  // Small enough a size that no machine ends the run before the signal comes.
  const std::vector<std::string> command = {CAVEA_PROGRAM, "remesh",   kSample,
                                            "-o",          "out.mesh", "--hsiz",
                                            "0.5",         "--report", "report.json"};
  constexpr double kSecondsUntilStop = 0.5;
  EXPECT_EQ(run(command, kSecondsUntilStop, SIGINT).status, 128 + SIGINT);
  EXPECT_EQ(run(command, kSecondsUntilStop, SIGTERM).status, 128 + SIGTERM);
  EXPECT_EQ(files(), Files{});
}

TEST_F(RunTest, ReadmeProgramCompilesAndRuns) {
  const std::string text = read_text(CAVEA_SOURCE "/docs/snippets/library.cpp");
  EXPECT_NE(read_text(CAVEA_SOURCE "/README.md").find("```cpp\n" + text + "```"), std::string::npos)
      << "README.md does not hold docs/snippets/library.cpp as it stands";
  std::filesystem::copy_file(kSample, file("part.mesh"));
  const Outcome outcome = run({CAVEA_SNIPPET});
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_EQ(cavea({"info", "part.out.meshb"}).status, 0);
}

}  // namespace
}  // namespace cavea::test
