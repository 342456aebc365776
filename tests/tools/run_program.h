#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace cavea::test {

/// What a program left behind.
struct Outcome {
  int status = -1;  ///< of its exit; 128 plus the signal if one killed it
  std::string out, err;
};

/// Reads a whole file; a failure of the test if it is not there.
std::string read_text(const std::filesystem::path& file);
void write_text(const std::filesystem::path& file, const std::string& text);

/// A directory of its own for each test, removed at the end.
class ProgramTest : public testing::Test {
 protected:
  ProgramTest();
  ~ProgramTest() override;

  const std::filesystem::path& directory() const { return directory_; }
  std::filesystem::path file(const std::string& name) const { return directory_ / name; }
  /// Names of all files in the directory, hidden ones too.
  std::set<std::string> files() const;

  /// Runs a program in the directory; after `interrupt_after` seconds (0: never) sends it `signal`.
  Outcome run(const std::vector<std::string>& command, double interrupt_after = 0,
              int signal = 0) const;
  /// Runs `cavea` with these words.
  Outcome cavea(std::vector<std::string> words) const;

 private:
  std::filesystem::path directory_;
  std::filesystem::path streams_;  ///< where standard output and error go, out of sight of files()
};

/// The text of a unit cube in six tets, in Medit's format, without triangles.
std::string cube_text();

}  // namespace cavea::test
