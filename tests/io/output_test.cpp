#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

#include "cavea/base/error.h"
#include "cavea/io/output_file.h"
#include "files.h"

namespace cavea::test {
namespace {

/// No file may grow beyond `bytes` while this lives: writing fails as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_;
  void (*handler_)(int);
};

class Output : public testing::TestWithParam<std::string> {};

TEST_P(Output, AFullDiskLeavesTheOlderFileAndNothingElse) {
  const Folder folder;
  const auto file = folder.put(GetParam(), "older");
  MeshData data = kuhn_cube(6);
  data.sizes.assign(data.vertices.size(), 0.5);
  {
    const FileSizeLimit limit(2000);
    const std::string message = message_of<OutputError>([&] { write_mesh(file, data); });
    EXPECT_NE(message.find("cannot be written"), std::string::npos) << message;
  }
  EXPECT_EQ(content_of(file), "older");
  EXPECT_EQ(folder.entries(), 1u);
  write_mesh(file, data);
  EXPECT_NE(content_of(file), "older");
}

TEST_P(Output, PlacesThatCannotBeWrittenAreRefused) {
  const Folder folder;
  folder.put("plain", "");
  EXPECT_THROW(write_mesh(folder / "missing" / GetParam(), single_tet()), OutputError);
  EXPECT_THROW(write_mesh(folder / "plain" / GetParam(), single_tet()), OutputError);
  std::filesystem::create_directory(folder / GetParam());
  EXPECT_THROW(write_mesh(folder / GetParam(), single_tet()), OutputError);
  EXPECT_EQ(folder.entries(), 2u);
}

TEST_P(Output, AnUnwritableFolderIsRefused) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  const Folder folder;
  std::filesystem::create_directory(folder / "closed");
  std::filesystem::permissions(
      folder / "closed", std::filesystem::perms::owner_exec | std::filesystem::perms::owner_read);
  EXPECT_THROW(write_mesh(folder / "closed" / GetParam(), single_tet()), OutputError);
  EXPECT_TRUE(std::filesystem::is_empty(folder / "closed"));
}

std::vector<std::string> written_formats() {
  std::vector<std::string> names;
  for (const FormatInfo& format : formats())
    if (format.writable) names.push_back("a" + std::string(format.extension));
  return names;
}

INSTANTIATE_TEST_SUITE_P(All, Output, testing::ValuesIn(written_formats()),
                         [](const auto& test) { return test.param.substr(2); });

TEST(OutputFile, IsSeenOnlyWhenPublished) {
  const Folder folder;
  {
    OutputFile file(folder / "a");
    file.append(std::string_view("some"));
    EXPECT_FALSE(std::filesystem::exists(folder / "a"));
    EXPECT_EQ(folder.entries(), 1u);
    file.append(std::string_view(" text"));
    file.publish();
  }
  EXPECT_EQ(content_of(folder / "a"), "some text");
  { OutputFile abandoned(folder / "b"); }
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(OutputFile, TwoAtOnceDoNotMeet) {
  const Folder folder;
  OutputFile first(folder / "a"), second(folder / "a");
  first.append(std::string_view("first"));
  second.append(std::string_view("second"));
  second.publish();
  first.publish();
  EXPECT_EQ(content_of(folder / "a"), "first");
}

TEST(OutputFile, HasThePermissionsOfAnyNewFile) {
  const Folder folder;
  const mode_t mask = umask(027);
  OutputFile file(folder / "a");
  file.publish();
  umask(mask);
  struct stat status;
  ASSERT_EQ(stat((folder / "a").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0640u);
}

TEST(OutputFile, RefusesAPipe) {
  const Folder folder;
  ASSERT_EQ(mkfifo((folder / "pipe.mesh").c_str(), 0600), 0);
  EXPECT_THROW(OutputFile(folder / "pipe.mesh"), OutputError);
  EXPECT_THROW(read_mesh(folder / "pipe.mesh", nullptr), InputError);
}

}  // namespace
}  // namespace cavea::test
