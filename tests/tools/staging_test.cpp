#include "staging.h"

#include "cavea/base/error.h"
#include "run_program.h"

namespace cavea::test {
namespace {

using program::OutputSet;
using StagingTest = ProgramTest;
using Files = std::set<std::string>;

TEST_F(StagingTest, NothingAppearsBeforePublish) {
  {
    OutputSet outputs;
    outputs.add_text(file("a.txt"), "new");
    for (const std::string& name : files()) EXPECT_EQ(name[0], '.') << name;
  }
  EXPECT_EQ(files(), Files{});
}

TEST_F(StagingTest, PublishesAllOverOlderFiles) {
  write_text(file("a.txt"), "old");
  OutputSet outputs;
  outputs.add_text(file("a.txt"), "new");
  outputs.add_text(file("b.txt"), "newer");
  EXPECT_EQ(outputs.publish(), (std::vector<std::filesystem::path>{file("a.txt"), file("b.txt")}));
  EXPECT_EQ(read_text(file("a.txt")), "new");
  EXPECT_EQ(read_text(file("b.txt")), "newer");
  EXPECT_EQ(files(), (Files{"a.txt", "b.txt"}));
}

TEST_F(StagingTest, AFailureHalfWayPutsTheOlderFilesBack) {
  write_text(file("a.txt"), "old");
  std::filesystem::create_directory(file("c.txt"));  // no file can be renamed to this
  {
    OutputSet outputs;
    outputs.add_text(file("a.txt"), "new");
    outputs.add_text(file("b.txt"), "new");
    outputs.add_text(file("c.txt"), "new");
    EXPECT_THROW(outputs.publish(), OutputError);
  }
  EXPECT_EQ(read_text(file("a.txt")), "old");
  EXPECT_EQ(files(), (Files{"a.txt", "c.txt"}));
}

}  // namespace
}  // namespace cavea::test
