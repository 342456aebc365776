// What the program refuses: exit status 2, a message that names the culprit, nothing written.
#include <filesystem>

#include "run_program.h"

namespace cavea::test {
namespace {

using Words = std::vector<std::string>;

class UsageTest : public ProgramTest {
 protected:
  UsageTest() { write_text(file("in.mesh"), cube_text()); }

  void expect_refused(const Words& words, const std::string& named) {
    const std::set<std::string> before = files();
    const Outcome outcome = cavea(words);
    std::string line = "cavea";
    for (const std::string& word : words) line += " '" + word + "'";
    EXPECT_EQ(outcome.status, 2) << line << "\n" << outcome.err;
    EXPECT_EQ(outcome.err.rfind("cavea: error: ", 0), 0u) << line << "\n" << outcome.err;
    EXPECT_NE(outcome.err.find(named), std::string::npos) << line << "\n" << outcome.err;
    EXPECT_EQ(outcome.out, "") << line;
    EXPECT_EQ(files(), before) << line;
  }

  /// `cavea remesh in.mesh -o out.mesh ...`
  void expect_option_refused(const Words& more, const std::string& named) {
    Words words = {"remesh", "in.mesh", "-o", "out.mesh"};
    words.insert(words.end(), more.begin(), more.end());
    expect_refused(words, named);
  }
};

TEST_F(UsageTest, HelpAndVersionAreNoErrors) {
  EXPECT_EQ(cavea({"--version"}).out, "cavea " CAVEA_VERSION "\n");
  for (const Words& words : {Words{"--help"}, {"remesh", "--help"}, {"info", "--help"}}) {
    const Outcome outcome = cavea(words);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_NE(outcome.out.find("Usage: "), std::string::npos);
  }
}

TEST_F(UsageTest, RefusesACommandLineThatMakesNoSense) {
  expect_refused({}, "subcommand");
  expect_refused({"frobnicate"}, "subcommand");
  expect_refused({"remesh"}, "IN");
  expect_refused({"remesh", "in.mesh"}, "--out");
  expect_refused({"remesh", "in.mesh", "-o"}, "--out");
  expect_refused({"info"}, "FILE");
  expect_option_refused({"--frobnicate"}, "--frobnicate");
  expect_option_refused({"surplus"}, "surplus");
  expect_option_refused({"--verbose", "--quiet"}, "--quiet");
  expect_option_refused({"--angle", "30", "--no-angle"}, "--angle");
  expect_option_refused({"--hmin", "0.1", "--hmin", "0.2"}, "--hmin");
}

TEST_F(UsageTest, RefusesLevelSetsThatAreNone) {
  const auto expect_level_set_refused = [&](const std::string& values, const std::string& named,
                                            const Words& more = {}) {
    write_text(file("phi.sol"),
               "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n" + values + "\nEnd\n");
    Words words = {"implicit", "in.mesh", "--sol", "phi.sol", "-o", "out.mesh"};
    words.insert(words.end(), more.begin(), more.end());
    expect_refused(words, named);
  };
  const std::string good = "8 1 1 -1 1 1 1 1 1 1 1";
  expect_level_set_refused("8 1 1 2 1 1 1 1 1 1 1",
                           "phi.sol: the level set is nowhere 0: its values are from 1 to 2");
  expect_level_set_refused(good, "nowhere 7", {"--iso", "7"});
  expect_level_set_refused("7 1 1 -1 1 1 1 1 1 1", "phi.sol: line 3: SolAtVertices holds 7");
  expect_level_set_refused("8 1 1 nan 1 1 1 1 1 1 1", "phi.sol");
  expect_level_set_refused(good, "--reference-map", {"--reference-map", "1:5"});
  expect_level_set_refused(good, "--inside-ref", {"--inside-ref", "2"});
  expect_level_set_refused(good, "--keep", {"--keep", "middle"});
  expect_level_set_refused(good, "share of components", {"--remove-components", "1"});
  expect_refused({"implicit", "in.mesh", "-o", "out.mesh"}, "--sol");
}

TEST_F(UsageTest, TellsThatALevelSetLeavesNoInterface) {
  write_text(file("phi.sol"),
             "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n"
             "8 1 1 -1e-9 1 1 1 1 1 1 1\nEnd\n");
  const Outcome outcome = cavea({"implicit", "in.mesh", "--sol", "phi.sol", "-o", "out.mesh"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.err.find("phi.sol: there is no interface"), std::string::npos) << outcome.err;
}

TEST_F(UsageTest, RefusesNumbersThatAreNone) {
  for (const char* name :
       {"hausd", "hmin", "hmax", "hsiz", "hgrad", "angle", "min-quality", "min-conform", "threads"})
    for (const char* value : {"x", "1x", ""})
      expect_option_refused({std::string("--") + name, value}, std::string("--") + name);
  expect_option_refused({"--threads", "1.5"}, "--threads");
  for (const char* value : {"x", "1.5", ""})
    expect_option_refused({"--max-tets", value}, "--max-tets");
  for (const char* value : {"x", "8Q", ""})
    expect_option_refused({"--max-memory", value}, "--max-memory");
}

TEST_F(UsageTest, RefusesSizesThatAreNotPositive) {
  for (const char* name : {"hausd", "hmin", "hmax", "hsiz"})
    for (const char* value : {"0", "-1", "nan", "inf", "-inf"})
      expect_option_refused({std::string("--") + name, value}, name);
}

TEST_F(UsageTest, RefusesOtherSenselessOptions) {
  for (const char* value : {"0.9", "0", "-1", "nan", "inf"})
    expect_option_refused({"--hgrad", value}, "hgrad");
  for (const char* value : {"0.9", "nan"}) expect_option_refused({"--hgradreq", value}, "hgradreq");
  expect_option_refused({"--hgrad", "2", "--no-hgrad"}, "--no-hgrad");
  expect_option_refused({"--hgradreq", "2", "--no-hgradreq"}, "--no-hgradreq");
  for (const char* value : {"-1", "181", "nan", "inf"})
    expect_option_refused({"--angle", value}, "angle");
  for (const char* value : {"0", "-2"}) expect_option_refused({"--threads", value}, "threads");
  for (const char* value : {"0", "-5"}) expect_option_refused({"--max-tets", value}, "max_tets");
  expect_option_refused({"--max-memory", "0"}, "max_memory");
  expect_option_refused({"--tets-per-part", "5"}, "tets_per_part");
  expect_option_refused({"--max-memory", "-5G"}, "--max-memory");
  for (const char* value : {"nan", "1.5", "-0.1"})
    expect_option_refused({"--min-quality", value}, "quality");
  for (const char* value : {"nan", "101", "-1"})
    expect_option_refused({"--min-conform", value}, "conform");
  expect_option_refused({"--hmin", "2", "--hmax", "1"}, "hmin");
  expect_option_refused({"--hsiz", "0.2", "--hmin", "0.1"}, "hsiz");
  expect_option_refused({"--hsiz", "0.2", "--hmax", "0.3"}, "hsiz");
}

TEST_F(UsageTest, RefusesOutputsThatNameTheInput) {
  std::filesystem::create_hard_link(file("in.mesh"), file("hard.mesh"));
  std::filesystem::create_symlink("in.mesh", file("soft.mesh"));
  std::filesystem::create_directory(file("below"));
  for (const std::string& name :
       {std::string("in.mesh"), std::string("./in.mesh"), std::string("hard.mesh"),
        std::string("soft.mesh"), std::string("below/../in.mesh"), file("in.mesh").string()}) {
    expect_refused({"remesh", "in.mesh", "-o", name}, name);
    expect_option_refused({"-o", name}, name);
    expect_option_refused({"--report", name}, name);
    expect_refused({"info", "in.mesh", "--json", name}, name);
  }
  EXPECT_EQ(read_text(file("in.mesh")), cube_text());
}

TEST_F(UsageTest, RefusesOutputsThatNameEachOther) {
  expect_option_refused({"-o", "./out.mesh"}, "./out.mesh");
  expect_option_refused({"-o", file("out.mesh").string()}, "same file");
  expect_option_refused({"--report", "out.mesh"}, "--report");
  expect_option_refused({"--report", "./out.sol"}, "out.sol");
}

TEST_F(UsageTest, RefusesPlacesThatCannotBeWritten) {
  std::filesystem::create_directory(file("folder.mesh"));
  expect_refused({"remesh", "in.mesh", "-o", "out.xyz"}, ".xyz");
  expect_refused({"remesh", "in.mesh", "-o", "out"}, "out");
  expect_refused({"remesh", "in.mesh", "-o", "missing/out.mesh"}, "missing");
  expect_refused({"remesh", "in.mesh", "-o", "in.mesh/out.mesh"}, "in.mesh");
  expect_refused({"remesh", "in.mesh", "-o", "folder.mesh"}, "folder.mesh");
  expect_refused({"remesh", "in.mesh", "-o", ""}, "--out");
  expect_option_refused({"--report", ""}, "--report");
  expect_option_refused({"--report", "missing/report.json"}, "missing");
  expect_option_refused({"--report", "/dev/null"}, "/dev/null");
}

/// A file of sizes for the cube's eight vertices, of one field of this type.
std::string sizes_text(const std::string& type, const std::string& sizes) {
  return "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n8\n1 " + type + "\n" + sizes +
         "\nEnd\n";
}

TEST_F(UsageTest, RefusesSizesThatAreNone) {
  const auto expect = [&](const std::string& text, const std::string& named) {
    write_text(file("bad.sol"), text);
    expect_option_refused({"--sol", "bad.sol"}, named);
  };
  expect(sizes_text("3", "1 0 1 0 0 1"), "tensors");
  expect(sizes_text("2", "1 0 1"), "vectors");
  expect(sizes_text("1", "1 1 1 1 1 1 1"), "bad.sol");
  expect(sizes_text("1", "1 1 1 1 1 1 1 1 1"), "bad.sol");
  expect(sizes_text("1", "1 1 nan 1 1 1 1 1"), "vertex 3");
  expect(sizes_text("1", "1 1 1 0 1 1 1 1"), "vertex 4");
  expect(sizes_text("1", "1 1 1 1 -1 1 1 1"), "vertex 5");
  expect(sizes_text("1", "1 1 1 1 1 1e-300 1 1"), "vertex 6");
  expect_option_refused({"--sol", "missing.sol"}, "missing.sol");
  expect_option_refused({"--sol", "in.mesh"}, "in.mesh");
  expect_option_refused({"--sol", ""}, "--sol");
}

TEST_F(UsageTest, RefusesSizesBesideOneSizeAndUnderAnOutput) {
  write_text(file("in.sol"), sizes_text("1", "1 1 1 1 1 1 1 1"));
  write_text(file("out.sol"), sizes_text("1", "1 1 1 1 1 1 1 1"));
  expect_option_refused({"--sol", "in.sol", "--hsiz", "0.2"}, "--hsiz");
  expect_option_refused({"--sol", "in.sol", "--optim"}, "--optim");
  expect_option_refused({"--hsiz", "0.2", "--optim"}, "--optim");
  expect_option_refused({"--sol", "out.sol"}, "out.sol");
  expect_option_refused({"--sol", "in.sol", "--report", "in.sol"}, "--sol");
}

TEST_F(UsageTest, RefusesInputsThatAreNoMesh) {
  write_text(file("empty.mesh"), "");
  write_text(file("cut.mesh"), cube_text().substr(0, 150));
  write_text(file("in.xyz"), cube_text());
  for (const char* name : {"missing.mesh", "empty.mesh", "cut.mesh", "in.xyz"}) {
    expect_refused({"remesh", name, "-o", "out.mesh"}, name);
  }
  for (const char* name : {"missing.mesh", "cut.mesh", "in.xyz"})
    expect_refused({"info", name}, name);
}

}  // namespace
}  // namespace cavea::test
