// Damaged files: whatever is done to one, it is read or refused with InputError; nothing else
// happens. Run under the asan preset this finds reads beyond the end.
#include <algorithm>

#include "cavea/base/error.h"
#include "files.h"
#include "in_memory.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size);

namespace cavea::test {
namespace {

constexpr int kRuns = 3000;

/// One random change: bytes flipped, a piece cut out or doubled, an end cut off, a number replaced.
std::string damaged(std::string s, Random& random) {
  const auto place = [&] { return std::size_t(random.below(std::int32_t(s.size()))); };
  static constexpr const char* kPieces[] = {
      "0", "-1",        "4294967297",   "1e308",           "nan", "End", "Vertices", "#", "\n",
      " ", "999999999", "Tetrahedra 1", "\xff\xff\xff\xff"};
  const std::size_t at = place(), n = 1 + std::size_t(random.below(12));
  switch (random.below(6)) {
    case 0:
      s[at] = char(random.below(256));
      break;
    case 1:
      s[at] = char(s[at] ^ (1 << random.below(8)));
      break;
    case 2:
      s.erase(at, n);
      break;
    case 3:
      s.insert(place(), s.substr(at, n));
      break;
    case 4:
      s.resize(at + 1);
      break;
    default:
      s.replace(at, n, kPieces[random.below(std::int32_t(std::size(kPieces)))]);
  }
  return s.empty() ? std::string(1, '\0') : s;
}

std::string sample(Encoding encoding, bool sizes) {
  const Folder folder;
  MeshData data = parse(kFullText, Encoding::text);
  data.sizes.assign(data.vertices.size(), 0.5);
  const std::string letter = encoding == Encoding::bytes ? "b" : "";
  write_mesh(folder / ("a.mesh" + letter), data);
  return content_of(folder / ((sizes ? "a.sol" : "a.mesh") + letter));
}

class Fuzz : public testing::TestWithParam<int> {};

TEST_P(Fuzz, DamagedInputIsReadOrRefused) {
  const int selector = GetParam();
  const std::string good =
      sample(selector & 1 ? Encoding::bytes : Encoding::text, (selector & 2) != 0);
  const auto run = [&](const std::string& input) {
    const std::string all = char(selector) + input;
    return LLVMFuzzerTestOneInput(reinterpret_cast<const unsigned char*>(all.data()), all.size());
  };
  for (int seed = 0; seed < kRuns; ++seed) {
    Random random{std::uint64_t(seed)};
    std::string bad = good;
    for (int changes = 1 + random.below(4); changes > 0; --changes) bad = damaged(bad, random);
    EXPECT_NO_THROW(run(bad)) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Medit, Fuzz, testing::Range(0, 4));

bool all_below(const std::vector<std::int32_t>& list, std::size_t limit) {
  return std::all_of(list.begin(), list.end(),
                     [&](std::int32_t i) { return i >= 0 && std::size_t(i) < limit; });
}
template <std::size_t N>
bool all_below(const std::vector<std::array<std::int32_t, N>>& rows, std::size_t limit) {
  return std::all_of(rows.begin(), rows.end(), [&](const auto& row) {
    return all_below(std::vector<std::int32_t>(row.begin(), row.end()), limit);
  });
}

/// What is accepted must be usable: all indices in range, all coordinates finite.
bool is_usable(const MeshData& d) {
  const std::size_t n = d.vertices.size();
  return std::all_of(d.vertices.begin(), d.vertices.end(), is_finite) && all_below(d.tets, n) &&
         all_below(d.triangles, n) && all_below(d.edges, n) && all_below(d.corners, n) &&
         all_below(d.ridges, d.edges.size()) && all_below(d.required_vertices, n) &&
         all_below(d.required_edges, d.edges.size()) &&
         all_below(d.required_triangles, d.triangles.size()) &&
         all_below(d.required_tets, d.tets.size()) && d.tet_refs.size() == d.tets.size() &&
         d.vertex_refs.size() == n && d.tets.size() > 0;
}

TEST(Fuzz, WhatIsAcceptedIsInRange) {
  int accepted = 0;
  for (const Encoding encoding : {Encoding::text, Encoding::bytes}) {
    const std::string good = sample(encoding, false);
    for (int seed = 0; seed < kRuns; ++seed) {
      Random random{std::uint64_t(seed)};
      try {
        EXPECT_TRUE(is_usable(parse(damaged(good, random), encoding))) << "seed " << seed;
        ++accepted;
      } catch (const InputError&) {  // the other right answer
      }
    }
  }
  EXPECT_GT(accepted, kRuns / 50);
}

}  // namespace
}  // namespace cavea::test
