#include "run_program.h"

namespace cavea::test {
namespace {

using SampleTest = ProgramTest;

TEST_F(SampleTest, CommittedFileIsWhatTheProgramMakes) {
  ASSERT_EQ(run({CAVEA_MAKE_SAMPLE, "bracket.mesh"}).status, 0);
  EXPECT_TRUE(read_text(file("bracket.mesh")) ==
              read_text(CAVEA_SOURCE "/tools/sample/bracket.mesh"));
}

}  // namespace
}  // namespace cavea::test
