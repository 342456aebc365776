#include <clocale>
#include <locale>

#include "cavea/base/error.h"
#include "files.h"
#include "in_memory.h"

namespace cavea::test {
namespace {

MeshData parse_text(const std::string& text, std::vector<std::string>* warnings = nullptr) {
  return parse(text, Encoding::text, warnings);
}

TEST(MeditText, EverySectionArrives) {
  const MeshData d = parse_text(kFullText);
  EXPECT_EQ(d.vertices[4], (Vec3{1, 1, 1}));
  EXPECT_EQ(d.vertex_refs, (std::vector<std::int32_t>{1, 2, 3, 4, 5}));
  EXPECT_EQ(d.tets[1], (std::array<std::int32_t, 4>{1, 2, 3, 4}));
  EXPECT_EQ(d.tet_refs, (std::vector<std::int32_t>{7, 8}));
  EXPECT_EQ(d.triangles[0], (std::array<std::int32_t, 3>{0, 2, 1}));
  EXPECT_EQ(d.triangle_refs, (std::vector<std::int32_t>{11, 12}));
  EXPECT_EQ(d.edges[1], (std::array<std::int32_t, 2>{0, 2}));
  EXPECT_EQ(d.edge_refs, (std::vector<std::int32_t>{21, 22}));
  EXPECT_EQ(d.corners, (std::vector<std::int32_t>{0}));
  EXPECT_EQ(d.ridges, (std::vector<std::int32_t>{1}));
  EXPECT_EQ(d.required_vertices, (std::vector<std::int32_t>{1, 2}));
  EXPECT_EQ(d.required_edges, (std::vector<std::int32_t>{0}));
  EXPECT_EQ(d.required_triangles, (std::vector<std::int32_t>{1}));
  EXPECT_EQ(d.required_tets, (std::vector<std::int32_t>{1}));
  EXPECT_EQ(d.normals[1], (Vec3{0, -1, 0}));
  EXPECT_EQ(d.normal_at_vertices[1], (std::array<std::int32_t, 2>{2, 1}));
  EXPECT_EQ(d.tangents[0], (Vec3{1, 0, 0}));
  EXPECT_EQ(d.tangent_at_vertices[0], (std::array<std::int32_t, 2>{1, 0}));
}

std::string replaced_all(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

TEST(MeditText, LayoutDoesNotMatter) {
  const MeshData expected = parse_text(kFullText);
  const std::string variants[] = {
      replaced_all(kFullText, "\n", "\r\n"),
      replaced_all(kFullText, "\n", " "),
      replaced_all(kFullText, " ", "\n"),
      replaced_all(kFullText, "\n", "\n\n \t\n"),
      replaced_all(kFullText, "\n", " # Vertices 7 nan\n"),
      replaced_all(kFullText, "\n", "# x\r\n"),
      "# before\n#\n" + kFullText + "anything 1 2 behind End",
      edited(kFullText, "Vertices\n5\n", "Vertices 5 "),
      edited(kFullText, "0 0 0 1\n", "+0.0 -0e3 0D+00 +1\n"),
      edited(kFullText, "End\n", "End"),
  };
  for (const std::string& text : variants) {
    SCOPED_TRACE(text.substr(0, 120));
    MeshData d = parse_text(text);
    for (Vec3& p : d.vertices) p += Vec3{};  // -0 becomes 0
    expect_same_mesh(d, expected);
  }
}

TEST(MeditText, FreeLayoutOverManyBlocks) {
  const Folder folder;
  const MeshData data = kuhn_cube(20);
  write_mesh(folder / "a.mesh", data);
  const std::string text = content_of(folder / "a.mesh");
  for (const char* separator : {" ", "\n\n"}) {
    std::string other = replaced_all(text, "\n", separator);
    expect_same_mesh(parse_text(other), data);
    // A number that is missing far behind the first block.
    other.erase(other.rfind(" 1", other.size() - 20), 2);
    EXPECT_THROW(parse_text(other), InputError);
  }
}

TEST(MeditText, AnyOrderOfSections) {
  std::string text = edited(kFullText, "Corners\n1\n1\n", "");
  text = edited(text, "Vertices\n5", "Corners\n1\n1\nVertices\n5");
  expect_same_mesh(parse_text(text), parse_text(kFullText));
}

TEST(MeditText, VersionsOneToFour) {
  for (const char* version : {"1", "2", "3", "4"})
    expect_same_mesh(
        parse_text(edited(kFullText, "Formatted 2", std::string("Formatted ") + version)),
        parse_text(kFullText));
}

TEST(MeditText, RareNumbers) {
  const auto first = [](const std::string& number) {
    return parse_text(edited(kFullText, "0 0 0 1", number + " 0 0 1")).vertices[0].x;
  };
  EXPECT_EQ(first("1.5D-3"), 1.5e-3);
  EXPECT_EQ(first("-2.5d2"), -250.0);
  EXPECT_EQ(first("+.5"), 0.5);
  EXPECT_EQ(first("3."), 3.0);
  EXPECT_EQ(first("1e-400"), 0.0);
  EXPECT_EQ(first("4.9406564584124654e-324"), 4.9406564584124654e-324);
  EXPECT_EQ(first("0.1000000000000000055511151231257827"), 0.1);
}

struct DecimalComma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// Numbers have a decimal comma while this lives: for C++, and for C where such a locale is
/// installed.
class CommaLocale {
 public:
  CommaLocale()
      : c_(std::setlocale(LC_ALL, nullptr)),
        cpp_(std::locale::global(std::locale(std::locale::classic(), new DecimalComma))) {
    if (!std::setlocale(LC_ALL, "de_DE.UTF-8")) std::setlocale(LC_ALL, "fr_FR.UTF-8");
  }
  ~CommaLocale() {
    std::locale::global(cpp_);
    std::setlocale(LC_ALL, c_.c_str());
  }

 private:
  std::string c_;
  std::locale cpp_;
};

TEST(MeditText, LocaleDoesNotMatter) {
  const CommaLocale comma;
  const Folder folder;
  MeshData data = single_tet();
  data.vertices[0].x = 0.25;
  data.tet_refs[0] = 1234567;
  write_mesh(folder / "a.mesh", data);
  expect_same_mesh(read_mesh(folder / "a.mesh", nullptr), data);
  EXPECT_EQ(content_of(folder / "a.mesh").find(','), std::string::npos);
}

TEST(MeditText, UnknownKeywordsAreSkippedWithOneWarningEach) {
  std::vector<std::string> warnings;
  const std::string text =
      edited(edited(edited(kFullText, "Triangles", "Fancy\n2\n1 2.5 -3\n4 5 6\nTriangles"), "Edges",
                    "Fancy\n3\n1 2 3\nBare\nEdges"),
             "Corners", "Quadrilaterals\n1\n1 2 3 4 0\nCorners");
  expect_same_mesh(parse_text(text, &warnings), parse_text(kFullText));
  EXPECT_EQ(warnings, (std::vector<std::string>{
                          "memory: keyword Bare (0 entries) is not understood and skipped",
                          "memory: keyword Fancy (5 entries) is not understood and skipped",
                          "memory: 1 Quadrilaterals ignored: only tetrahedra are read"}));
}

TEST(MeditText, LostTangentsAreDroppedWithAWarning) {
  std::vector<std::string> warnings;
  const MeshData d = parse_text(
      edited(kFullText, "TangentAtVertices\n1\n2 1", "TangentAtVertices\n1\n2 9"), &warnings);
  EXPECT_TRUE(d.tangents.empty() && d.tangent_at_vertices.empty());
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("tangents are skipped"), std::string::npos);
}

struct BadText {
  const char* name;
  const char* from;  ///< replaced in kFullText ...
  const char* to;
  const char* message;  ///< ... gives an error that contains this
};

class MeditTextError : public testing::TestWithParam<BadText> {};

TEST_P(MeditTextError, NamesLineAndEntity) {
  const BadText& bad = GetParam();
  const Folder folder;
  const auto file = folder.put("bad.mesh", edited(kFullText, bad.from, bad.to));
  const std::string message = message_of<InputError>([&] { read_mesh(file, nullptr); });
  EXPECT_EQ(message.find(file.string() + ": "), 0u) << message;
  EXPECT_NE(message.find(bad.message), std::string::npos) << message;
}

constexpr BadText kBadTexts[] = {
    {"Magic", "MeshVersionFormatted", "OFF", "line 1: not a Medit mesh"},
    {"JunkBefore", "MeshVersionFormatted", "7 MeshVersionFormatted", "line 1: not a Medit mesh"},
    {"Version0", "Formatted 2", "Formatted 0", "MeshVersionFormatted is 0; only 1 to 4"},
    {"Version5", "Formatted 2", "Formatted 5", "line 1: MeshVersionFormatted is 5; only 1 to 4"},
    {"VersionTwice", "Dimension 3", "Dimension 3 MeshVersionFormatted 2", "line 2: the keyword"},
    {"VersionNone", "Formatted 2", "Formatted", "MeshVersionFormatted is not given"},
    {"Dimension2", "Dimension 3", "Dimension 2", "line 2: Dimension is 2; only 3"},
    {"DimensionMore", "Dimension 3", "Dimension 3 3", "line 2: Dimension is followed by more"},
    {"DimensionMissing", "Dimension 3", "", "the keyword Dimension is missing"},
    {"DimensionTwice", "Dimension 3", "Dimension 3\nDimension 3", "line 3: the keyword Dimension"},
    {"CutShort", "RequiredEdges\n1\n1\n", "RequiredEdges\n1\n",
     "line 32: RequiredEdges announces 1"},
    {"NoEnd", "End\n", "", "line 55: the file is cut short: it ends without the keyword End"},
    {"NoVertices", "Vertices", "Verts", "the file has no section Vertices"},
    {"ZeroVertices", "Vertices\n5\n0 0 0 1\n1 0 0 2\n0 1 0 3\n0 0 1 4\n1 1 1 5\n", "Vertices\n0\n",
     "line 3: the file has no Vertices"},
    {"NoTetrahedra", "Tetrahedra", "Tets", "the file has no section Tetrahedra; it has Vertices, "},
    {"ZeroTetrahedra", "Tetrahedra\n2\n1 2 3 4 7\n2 3 4 5 8\n", "Tetrahedra\n0\n",
     "line 10: the file has no Tetrahedra"},
    {"Twice", "Corners\n1\n1\n", "Corners\n1\n1\nCorners\n1\n1\n",
     "line 25: the keyword Corners is"},
    {"CountTooLarge", "Tetrahedra\n2", "Tetrahedra\n3",
     "line 10: Tetrahedra announces 3 entities of 5 numbers, but 10 numbers stand before the word "
     "'Triangles' in line 14"},
    {"CountTooSmall", "Vertices\n5", "Vertices\n4", "line 3: Vertices announces 4 entities of 4"},
    {"CountHuge", "Tetrahedra\n2", "Tetrahedra\n4000000000000000000",
     "line 10: Tetrahedra announces"},
    {"CountBeyondInteger", "Tetrahedra\n2", "Tetrahedra\n99999999999999999999",
     "line 11: count of Tetrahedra: a whole number is due, not '99999999999999999999'"},
    {"CountNegative", "Edges\n2", "Edges\n-2", "Edges announces a negative count: -2"},
    {"CountNoNumber", "Edges\n2", "Edges\n2.5", "count of Edges: a whole number is due, not '2.5'"},
    {"CountMissing", "Corners\n1\n1\n", "Corners\n", "count of Corners: a number is due"},
    {"RowShort", "1 2 3 4 7", "1 2 3 4", "the first line that does not hold 5 is line 12"},
    {"RowLong", "0 1 0 3", "0 1 0 3 9", "the first line that does not hold 4 is line 7"},
    {"IndexZero", "1 2 3 4 7", "0 2 3 4 7", "line 12: tetrahedron 1: vertex 0 is not in 1..5"},
    {"IndexLarge", "2 3 4 5 8", "2 3 4 6 8", "line 13: tetrahedron 2: vertex 6 is not in 1..5"},
    {"IndexNegative", "1 3 2 11", "1 -3 2 11", "line 16: triangle 1: vertex -3 is not in 1..5"},
    {"IndexHuge", "1 2 21", "1 4294967298 21", "edge 1: vertex 4294967298 is not in 1..5"},
    {"CornerIndex", "Corners\n1\n1\n", "Corners\n1\n6\n", "line 24: corner 1: vertex 6 is not in"},
    {"RidgeIndex", "Ridges\n1\n2", "Ridges\n1\n3", "line 27: ridge 1: edge 3 is not in 1..2"},
    {"NoEdges", "\nEdges\n2\n1 2 21\n1 3 22", "",
     "ridge 1: edge 2 does not exist: the file has none"},
    {"RequiredTriangle", "RequiredTriangles\n1\n2", "RequiredTriangles\n1\n5",
     "required triangle 1: triangle 5 is not in 1..2"},
    {"RequiredTet", "RequiredTetrahedra\n1\n2", "RequiredTetrahedra\n1\n3",
     "required tetrahedron 1: tetrahedron 3 is not in 1..2"},
    {"NormalIndex", "NormalAtVertices\n2\n2 1", "NormalAtVertices\n2\n2 3",
     "normal at vertex 1: normal 3 is not in 1..2"},
    {"Nan", "0 1 0 3", "0 nan 0 3", "line 7: vertex 3: a number is not finite"},
    {"MinusNan", "0 1 0 3", "0 -NaN 0 3", "line 7: vertex 3: a number is not finite"},
    {"Inf", "0 0 1 4", "0 0 inf 4", "line 8: vertex 4: a number is not finite"},
    {"Infinity", "0 0 1 4", "0 0 -Infinity 4", "line 8: vertex 4: a number is not finite"},
    {"TooLarge", "0 0 1 4", "0 0 1e999 4", "line 8: vertex 4: '1e999' is too large for a double"},
    {"Junk", "0 0 1 4", "0 0 1x 4", "line 8: vertex 4: a number is due, not '1x'"},
    {"JunkSign", "0 0 1 4", "0 0 +-1 4", "line 8: vertex 4: a number is due, not '+-1'"},
    {"JunkUnseen", "0 0 1 4", "0 0 \x01\xff 4",
     "line 8: vertex 4: a number is due, not '?"
     "?'"},
    {"JunkWord", "0 0 1 4", "0 0 one 4",
     "line 3: Vertices announces 5 entities of 4 numbers, but 14 numbers stand before the word "
     "'one' "
     "in line 8"},
    {"RealIndex", "1 2 3 4 7", "1 2 3.0 4 7", "tetrahedron 1: a whole number is due, not '3.0'"},
    {"RefHuge", "1 2 3 4 7", "1 2 3 4 2147483648",
     "tetrahedron 1: reference 2147483648 does not fit into 32 bits"},
};

INSTANTIATE_TEST_SUITE_P(All, MeditTextError, testing::ValuesIn(kBadTexts),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(MeditText, TheFirstOfSeveralFaultsIsNamed) {
  const Folder folder;
  write_mesh(folder / "a.mesh", kuhn_cube(20));
  const std::string good = content_of(folder / "a.mesh");
  std::string text = good;
  const std::size_t tets = text.find("Tetrahedra");
  for (std::size_t at = tets + 300000; at < text.size() - 1000; at += 200000)
    text[text.find_first_of("0123456789", at)] = '?';
  std::string first;
  for (int run = 0; run < 20; ++run) {
    const std::string message = message_of<InputError>([&] { parse_text(text); });
    if (first.empty()) first = message;
    EXPECT_EQ(message, first);
  }
  const std::size_t line =
      1 +
      std::size_t(std::count(text.begin(), text.begin() + std::ptrdiff_t(text.find('?')), '\n'));
  EXPECT_NE(first.find("line " + std::to_string(line) + ": tetrahedron"), std::string::npos)
      << first;
}

TEST(MeditText, NoTruncationPasses) {
  const std::size_t whole = kFullText.find("End") + 3;
  for (std::size_t n = 0; n < whole; ++n)
    EXPECT_THROW(parse_text(kFullText.substr(0, n)), InputError) << n << " bytes";
  EXPECT_NO_THROW(parse_text(kFullText.substr(0, whole)));
}

}  // namespace
}  // namespace cavea::test
