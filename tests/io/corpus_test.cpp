// The stored corpus of the fuzz target is what our own writer writes: it starts from files that
// are read whole, in every encoding and version.
#include <map>

#include "cavea/base/error.h"
#include "files.h"
#include "in_memory.h"

namespace cavea::test {
namespace {

/// A file as the fuzz target takes it: the first byte chooses the reader (fuzz/medit.cpp).
std::string written(const MeshData& data, const std::string& name, char selector, int version) {
  const Folder folder;
  WriteOptions options;
  options.medit_version = version;
  write_mesh(folder / (name.ends_with("b") ? "a.meshb" : "a.mesh"), data, options);
  return selector + content_of(folder / name);
}

std::map<std::string, std::string> corpus() {
  MeshData full = parse(kFullText, Encoding::text), cube = kuhn_cube(1);
  full.sizes = {0.5, 0.25, 1, 2, 1e-3};
  return {{"full_text", written(full, "a.mesh", '0', 2)},
          {"full_binary", written(full, "a.meshb", '1', 2)},
          {"full_binary_64", written(full, "a.meshb", '1', 3)},
          {"sizes_text", written(full, "a.sol", '2', 2)},
          {"sizes_binary", written(full, "a.solb", '3', 2)},
          {"sizes_binary_64", written(full, "a.solb", '3', 3)},
          {"cube_text", written(cube, "a.mesh", '0', 2)},
          {"cube_binary", written(cube, "a.meshb", '1', 2)}};
}

TEST(Corpus, IsWhatTheWriterWrites) {
  const std::filesystem::path stored = CAVEA_FUZZ_CORPUS;
  for (const auto& [name, content] : corpus())
    EXPECT_EQ(content_of(stored / name), content) << name;
}

TEST(Corpus, IsReadWhole) {
  for (const auto& [name, content] : corpus()) {
    const std::string_view input = std::string_view(content).substr(1);
    const Encoding encoding = content[0] & 1 ? Encoding::bytes : Encoding::text;
    std::vector<std::string> warnings;
    if (content[0] & 2)
      EXPECT_EQ(parse_sizes(input, encoding, 5).size(), 5u) << name;
    else
      EXPECT_NO_THROW(parse(input, encoding, &warnings)) << name;
    EXPECT_TRUE(warnings.empty()) << name;
  }
}

}  // namespace
}  // namespace cavea::test
