#include "cavea/base/error.h"
#include "cavea/base/parallel.h"
#include "files.h"
#include "in_memory.h"

namespace cavea::test {
namespace {

void expect_round_trip(const MeshData& data, const std::filesystem::path& file,
                       const WriteOptions& options) {
  write_mesh(file, data, options);
  std::vector<std::string> warnings;
  expect_same_mesh(read_mesh(file, &warnings), data);
  EXPECT_TRUE(warnings.empty());
}

class RoundTrip : public testing::TestWithParam<const char*> {};

TEST_P(RoundTrip, RandomListsComeBackBitForBit) {
  const Folder folder;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_round_trip(random_lists(seed), folder / GetParam(),
                      {.medit_version = 2 + int(seed % 2)});
  }
}

TEST_P(RoundTrip, ManyBlocksComeBack) {
  MeshData data = kuhn_cube(20);  // 48000 tets: several blocks of each reader and writer
  perturb_inside(data, 0.004, 1);
  for (std::size_t t = 0; t < data.tets.size(); ++t) data.tet_refs[t] = std::int32_t(t % 1000);
  const Folder folder;
  expect_round_trip(data, folder / GetParam(), {});
}

TEST_P(RoundTrip, BytesDoNotDependOnThreads) {
  MeshData data = kuhn_cube(14);
  perturb_inside(data, 0.005, 2);
  const Folder folder;
  std::string first;
  for (const int threads : {1, 2, 3, 8}) {
    MeshData again;
    run_in_arena(threads, [&] {
      write_mesh(folder / GetParam(), data);
      again = read_mesh(folder / GetParam(), nullptr);
    });
    expect_same_mesh(again, data);
    const std::string bytes = content_of(folder / GetParam());
    if (first.empty()) first = bytes;
    EXPECT_TRUE(bytes == first) << threads << " threads";
  }
}

TEST_P(RoundTrip, EmptyReferenceListsStandForZeros) {
  MeshData data = two_tets();
  data.tet_refs.clear();
  data.vertex_refs.clear();
  const Folder folder;
  write_mesh(folder / GetParam(), data);
  EXPECT_EQ(read_mesh(folder / GetParam(), nullptr).tet_refs, (std::vector<std::int32_t>{0, 0}));
}

TEST_P(RoundTrip, ListsThatDoNotFitTogetherAreRefused) {
  const Folder folder;
  MeshData short_refs = two_tets();
  short_refs.tet_refs = {1};
  EXPECT_THROW(write_mesh(folder / GetParam(), short_refs), InputError);
  MeshData wild_tet = two_tets();
  wild_tet.tets[1][2] = 5;
  EXPECT_THROW(write_mesh(folder / GetParam(), wild_tet), InputError);
  MeshData wild_normal = two_tets();
  wild_normal.normal_at_vertices = {{0, 0}};
  EXPECT_THROW(write_mesh(folder / GetParam(), wild_normal), InputError);
  EXPECT_THROW(write_mesh(folder / GetParam(), two_tets(), {.medit_version = 4}), OptionError);
  EXPECT_EQ(folder.entries(), 0u);
}

INSTANTIATE_TEST_SUITE_P(Medit, RoundTrip, testing::Values("x.mesh", "x.meshb"),
                         [](const auto& test) {
                           return std::string(test.param) == "x.mesh" ? "ascii" : "binary";
                         });

TEST(Formats, AreKnownByExtension) {
  EXPECT_TRUE(is_writable_format("a.mesh"));
  EXPECT_TRUE(is_writable_format("dir.x/a.meshb"));
  for (const char* name : {"a", "a.sol", "a.mesh.gz", "mesh", ".mesh", "a.stl", ""})
    EXPECT_FALSE(is_writable_format(name)) << name;
  EXPECT_GE(formats().size(), 2u);
  for (const FormatInfo& format : formats()) EXPECT_EQ(format.readable, format.extension != ".vtu");
}

TEST(Formats, UnknownExtensionsAreRefused) {
  EXPECT_NE(message_of<InputError>([] { read_mesh("a.stl", nullptr); }).find("'.stl'"),
            std::string::npos);
  EXPECT_THROW(write_mesh("a.stl", single_tet()), OutputError);
  EXPECT_THROW(read_sizes("a.mesh", 1), InputError);
  EXPECT_THROW(write_sizes("a.mesh", {}), OutputError);
}

TEST(Formats, FilesThatCannotBeReadAreRefused) {
  const Folder folder;
  const auto message = [&](const std::filesystem::path& path) {
    return message_of<InputError>([&] { read_mesh(path, nullptr); });
  };
  EXPECT_EQ(message(folder / "none.mesh"),
            (folder / "none.mesh").string() + ": cannot be read: No such file or directory");
  std::filesystem::create_directory(folder / "dir.mesh");
  EXPECT_EQ(message(folder / "dir.mesh"), (folder / "dir.mesh").string() + ": is a directory");
  EXPECT_EQ(message(folder.put("empty.meshb", "")),
            (folder / "empty.meshb").string() + ": is empty");
}

TEST(Formats, ReadingChangesNoFile) {
  const Folder folder;
  const std::string text = "# comments are blanked in memory only\n" + kFullText;
  const auto file = folder.put("a.mesh", text);
  read_mesh(file, nullptr);
  EXPECT_EQ(content_of(file), text);
}

}  // namespace
}  // namespace cavea::test
