#include <limits>

#include "binary_builder.h"
#include "cavea/base/error.h"
#include "files.h"
#include "in_memory.h"

namespace cavea::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// kFullText, encoded.
std::string full_bytes(int version, bool swapped) {
  BinaryBuilder b(version, swapped);
  b.dimension(3).vertices(5, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1});
  b.rows(8, 2, {1, 2, 3, 4, 7, 2, 3, 4, 5, 8}).rows(6, 2, {1, 3, 2, 11, 1, 2, 4, 12});
  b.rows(5, 2, {1, 2, 21, 1, 3, 22}).rows(13, 1, {1}).rows(14, 1, {2}).rows(15, 2, {2, 3});
  b.rows(16, 1, {1}).rows(17, 1, {2}).rows(12, 1, {2});
  const auto vectors = [&](std::int32_t code, std::int64_t n, std::initializer_list<double> xyz) {
    b.keyword(code, [&] {
      b.integer(n);
      for (const double x : xyz) b.real(x);
    });
  };
  vectors(60, 2, {0, 0, -1, 0, -1, 0});
  b.rows(20, 2, {2, 1, 3, 2});
  vectors(59, 1, {1, 0, 0});
  b.rows(61, 1, {2, 1});
  return b.end().bytes();
}

TEST(MeditBytes, AllVersionsAndByteOrders) {
  const MeshData expected = parse(kFullText, Encoding::text);
  for (int version = 1; version <= 4; ++version)
    for (const bool swapped : {false, true}) {
      SCOPED_TRACE(version * 10 + swapped);
      expect_same_mesh(parse(full_bytes(version, swapped), Encoding::bytes), expected);
    }
}

TEST(MeditBytes, CoordinatesOfVersionOneAreFloats) {
  BinaryBuilder b(1, false);
  b.dimension(3).vertices(4, {0.1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}).rows(8, 1, {1, 2, 3, 4, 0});
  EXPECT_EQ(parse(b.end().bytes(), Encoding::bytes).vertices[0].x, double(0.1f));
}

TEST(MeditBytes, WrittenFilesSayTheirVersion) {
  const Folder folder;
  for (const char version : {'\2', '\3'}) {
    write_mesh(folder / "a.meshb", single_tet(), {.medit_version = version});
    const std::string bytes = content_of(folder / "a.meshb");
    EXPECT_EQ(bytes.substr(0, 8), std::string({1, 0, 0, 0, version, 0, 0, 0}));
  }
}

/// A valid mesh of version 2 in this machine's byte order, with `more` before its End.
template <class More>
std::string with(More&& more) {
  BinaryBuilder b(2, false);
  b.dimension(3).vertices(4, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}).rows(8, 1, {1, 2, 3, 4, 0});
  more(b);
  return b.end().bytes();
}

TEST(MeditBytes, UnknownKeywordsAreSkippedWithAWarning) {
  std::vector<std::string> warnings;
  const std::string bytes = with([](BinaryBuilder& b) {
    b.rows(10, 1, {1, 2, 3, 4, 1, 2, 3, 4, 0}).rows(999, 3, {1, 2, 3}).rows(18, 0, {});
    b.keyword(77, [] {});
  });
  EXPECT_EQ(parse(bytes, Encoding::bytes, &warnings).tets.size(), 1u);
  EXPECT_EQ(
      warnings,
      (std::vector<std::string>{
          "memory: keyword 77 (0 entries) is not understood and skipped",
          "memory: keyword 999 (3 entries) is not understood and skipped",
          "memory: 1 Hexahedra ignored: only tetrahedra are read",
          "memory: keyword RequiredQuadrilaterals (0 entries) is not understood and skipped"}));
}

void expect_error(const std::string& bytes, const std::string& wanted) {
  const Folder folder;
  const auto file = folder.put("bad.meshb", bytes);
  const std::string message = message_of<InputError>([&] { read_mesh(file, nullptr); });
  EXPECT_EQ(message.find(file.string() + ": "), 0u) << message;
  EXPECT_NE(message.find(wanted), std::string::npos) << message << "\nwanted: " << wanted;
}

TEST(MeditBytes, BadHeaders) {
  expect_error("junk of some length", "byte 0: not a binary Medit mesh");
  expect_error(kFullText, "byte 0: not a binary Medit mesh");
  expect_error("\x01", "byte 1: the file is cut short");
  expect_error(BinaryBuilder(5, false).end().bytes(), "byte 4: version 5; only 1 to 4");
  expect_error(BinaryBuilder(0, false).end().bytes(), "byte 4: version 0; only 1 to 4");
  expect_error(BinaryBuilder(2, false).end().bytes(), "the keyword Dimension is missing");
  expect_error(BinaryBuilder(2, false).dimension(2).end().bytes(), "byte 8: Dimension is 2");
  expect_error(BinaryBuilder(2, false).dimension(3).dimension(3).end().bytes(),
               "the keyword Dimension is given twice");
}

TEST(MeditBytes, BadSections) {
  const auto vertices = [] {
    BinaryBuilder b(2, false);
    b.dimension(3).vertices(4, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
    return b;
  };
  const auto tets = [&](std::int64_t count, std::initializer_list<std::int64_t> rows) {
    return vertices().rows(8, count, rows).end().bytes();
  };
  expect_error(vertices().end().bytes(), "the file has no section Tetrahedra");
  expect_error(BinaryBuilder(2, false).dimension(3).rows(8, 1, {1, 2, 3, 4, 0}).end().bytes(),
               "the file has no section Vertices");
  expect_error(tets(0, {}), "byte 144: the file has no Tetrahedra");
  expect_error(tets(1, {1, 2, 3, 5, 0}), "byte 168: tetrahedron 1: vertex 5 is not in 1..4");
  expect_error(tets(1, {0, 2, 3, 4, 0}), "byte 156: tetrahedron 1: vertex 0 is not in 1..4");
  expect_error(tets(2, {1, 2, 3, 4, 0}),
               "byte 144: Tetrahedra announces 2 entities of 20 bytes, but has 20 bytes");
  expect_error(tets(1, {1, 2, 3, 4}), "byte 144: Tetrahedra announces 1 entities of 20");
  expect_error(tets(-1, {1, 2, 3, 4, 0}), "byte 144: Tetrahedra announces a negative count");
  expect_error(tets(2147483647, {1, 2, 3, 4, 0}), "byte 144: Tetrahedra announces 2147483647");
  expect_error(vertices().keyword(8, [] {}).end().bytes(), "announces a negative count, or none");
  expect_error(with([](BinaryBuilder& b) { b.rows(13, 1, {1}).rows(13, 1, {1}); }),
               "the keyword Corners is given twice");
  expect_error(with([](BinaryBuilder& b) { b.rows(14, 1, {1}); }),
               "ridge 1: edge 1 does not exist: the file has none");
  expect_error(BinaryBuilder(2, false)
                   .dimension(3)
                   .vertices(1, {0, kNan, 0})
                   .rows(8, 1, {1, 1, 1, 1, 0})
                   .end()
                   .bytes(),
               "byte 40: vertex 1: a number is not finite");
  expect_error(BinaryBuilder(4, false)
                   .dimension(3)
                   .vertices(1, {0, 0, 0})
                   .rows(8, 1, {1, 1, 1, 1, std::int64_t{1} << 40})
                   .end()
                   .bytes(),
               "tetrahedron 1: reference 1099511627776 does not fit into 32 bits");
}

TEST(MeditBytes, BadPositionsOfTheNextKeyword) {
  const std::string good = with([](BinaryBuilder&) {});
  for (const std::int32_t position : {0, -1, 8, 19, 1 << 30}) {
    std::string bad = good;
    std::memcpy(bad.data() + 12, &position, sizeof position);
    EXPECT_THROW(parse(bad, Encoding::bytes), InputError) << position;
  }
}

TEST(MeditBytes, NoTruncationPasses) {
  for (int version = 1; version <= 4; ++version) {
    const std::string good = full_bytes(version, false);
    const std::size_t position = version >= 3 ? 8 : 4;  // End's own: nothing depends on it
    for (std::size_t n = 0; n < good.size() - position; ++n)
      EXPECT_THROW(parse(good.substr(0, n), Encoding::bytes), InputError) << n << " bytes";
    EXPECT_NO_THROW(parse(good, Encoding::bytes));
  }
}

}  // namespace
}  // namespace cavea::test
