#include "run_program.h"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace cavea::test {
namespace {

namespace fs = std::filesystem;

fs::path make_directory() {
  std::string name = (fs::temp_directory_path() / "cavea-test-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("cannot make " + name);
  return name;
}

/// In the child: becomes the command.
[[noreturn]] void become(const std::vector<std::string>& command, const fs::path& directory,
                         const fs::path& streams) {
  constexpr int kCouldNotStart = 127;  // the shell's own
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  const int out = open((streams / "out").c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
  const int err = open((streams / "err").c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
  if (chdir(directory.c_str()) == 0 && dup2(out, STDOUT_FILENO) >= 0 &&
      dup2(err, STDERR_FILENO) >= 0)
    execv(words[0], words.data());
  _exit(kCouldNotStart);
}

}  // namespace

std::string read_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << file;
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

ProgramTest::ProgramTest() : directory_(make_directory()), streams_(make_directory()) {}

ProgramTest::~ProgramTest() {
  fs::remove_all(directory_);
  fs::remove_all(streams_);
}

std::set<std::string> ProgramTest::files() const {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(directory_))
    names.insert(entry.path().filename().string());
  return names;
}

Outcome ProgramTest::run(const std::vector<std::string>& command, double interrupt_after,
                         int signal) const {
  const pid_t child = fork();
  if (child == 0) become(command, directory_, streams_);
  if (interrupt_after > 0) {
    std::this_thread::sleep_for(std::chrono::duration<double>(interrupt_after));
    kill(child, signal);
  }
  int status = 0;
  waitpid(child, &status, 0);
  Outcome outcome;
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.out = read_text(streams_ / "out");
  outcome.err = read_text(streams_ / "err");
  return outcome;
}

Outcome ProgramTest::cavea(std::vector<std::string> words) const {
  words.insert(words.begin(), CAVEA_PROGRAM);
  return run(words);
}

std::string cube_text() {
  return R"(MeshVersionFormatted 2
Dimension 3
Vertices
8
0 0 0 0
1 0 0 0
0 1 0 0
1 1 0 0
0 0 1 0
1 0 1 0
0 1 1 0
1 1 1 0
Tetrahedra
6
1 2 4 8 1
1 4 3 8 1
1 3 7 8 1
1 7 5 8 1
1 5 6 8 1
1 6 2 8 1
End
)";
}

}  // namespace cavea::test
