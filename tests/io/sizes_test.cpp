#include "binary_builder.h"
#include "cavea/base/error.h"
#include "files.h"
#include "in_memory.h"

namespace cavea::test {
namespace {

const std::string kSizes =
    "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n3\n1 1\n0.5\n2\n1e-3\nEnd\n";

TEST(Sizes, AreWrittenBesideTheMesh) {
  const Folder folder;
  for (const auto& [mesh, sizes] : {std::pair{"a.mesh", "a.sol"}, {"b.meshb", "b.solb"}}) {
    MeshData data = random_lists(3);
    write_mesh(folder / mesh, data);
    EXPECT_TRUE(same_bits(read_sizes(folder / sizes, data.vertices.size()), data.sizes));
  }
}

TEST(Sizes, AreNotWrittenUnasked) {
  const Folder folder;
  write_mesh(folder / "a.mesh", random_lists(3), {.sizes = false});
  write_mesh(folder / "b.meshb", single_tet());
  EXPECT_EQ(folder.entries(), 2u);
}

TEST(Sizes, RoundTripAlone) {
  const Folder folder;
  std::vector<double> sizes(100000);
  Random random(5);
  for (double& h : sizes) h = std::abs(any_double(random));
  for (const char* name : {"a.sol", "a.solb"}) {
    write_sizes(folder / name, sizes);
    EXPECT_TRUE(same_bits(read_sizes(folder / name, sizes.size()), sizes)) << name;
  }
}

TEST(Sizes, AnyLayoutIsRead) {
  const std::vector<double> expected = {0.5, 2, 1e-3};
  EXPECT_EQ(parse_sizes(kSizes, Encoding::text, 3), expected);
  EXPECT_EQ(
      parse_sizes("MeshVersionFormatted\n\n2\n Dimension\n3\nSolAtVertices 3 1 1 .5 2. 1D-3 End",
                  Encoding::text, 3),
      expected);
  for (int version = 1; version <= 4; ++version)
    for (const bool swapped : {false, true}) {
      BinaryBuilder b(version, swapped);
      b.dimension(3).keyword(62, [&] {
        b.integer(3);
        b.small(1);
        b.small(1);
        for (const double h : {0.5, 2.0, 0.25}) b.real(h);
      });
      EXPECT_EQ(parse_sizes(b.end().bytes(), Encoding::bytes, 3), (std::vector{0.5, 2.0, 0.25}));
    }
}

TEST(Sizes, ErrorsSayWhy) {
  const auto expect = [](const char* from, const char* to, const std::string& wanted) {
    const std::string message =
        message_of<InputError>([&] { parse_sizes(edited(kSizes, from, to), Encoding::text, 3); });
    EXPECT_NE(message.find(wanted), std::string::npos) << message;
  };
  expect("1 1\n", "1 3\n", "holds a field of tensors (an anisotropic metric); sizes are scalars");
  expect("1 1\n", "1 2\n", "holds a field of vectors");
  expect("1 1\n", "1 9\n", "holds a field of unknown type 9");
  expect("1 1\n", "2 1 1\n", "line 3: SolAtVertices holds 2 fields; sizes are one");
  expect("3\n1 1\n0.5\n", "2\n1 1\n", "holds 2 sizes for the mesh's 3 vertices");
  expect("\n3\n", "\n4\n", "SolAtVertices announces 4 entities of 1 numbers, but 3 numbers stand");
  expect("\n3\n", "\n-3\n", "announces no count");
  expect("0.5", "0", "size of vertex 1: 0 is not positive");
  expect("0.5", "-1", "size of vertex 1: -1 is not positive");
  expect("0.5", "nan", "line 6: size of vertex 1: a number is not finite");
  expect("0.5", "0.5x", "line 6: size of vertex 1: a number is due, not '0.5x'");
  expect("SolAtVertices", "SolAtEdges", "the file has no section SolAtVertices");
  expect("End", "SolAtVertices 3 1 1 1 1 1 End", "given twice");
  expect("End", "", "cut short");
  expect("Dimension 3", "Dimension 2", "Dimension is 2");
}

TEST(Sizes, BinaryErrorsSayWhy) {
  const auto message = [](std::int32_t fields, std::int32_t type, std::int64_t count) {
    BinaryBuilder b(2, true);
    b.dimension(3).keyword(62, [&] {
      b.integer(count);
      b.small(fields);
      b.small(type);
      b.real(1);
    });
    return message_of<InputError>([&] { parse_sizes(b.end().bytes(), Encoding::bytes, 1); });
  };
  EXPECT_NE(message(1, 3, 1).find("tensors"), std::string::npos);
  EXPECT_NE(message(2, 1, 1).find("2 fields"), std::string::npos);
  EXPECT_NE(message(1, 1, 2).find("announces 2 entities of 8 bytes"), std::string::npos);
  EXPECT_NE(message(1, 1, -1).find("announces no count"), std::string::npos);
  BinaryBuilder bare(2, false);
  bare.dimension(3).rows(62, 1, {1}).end();
  EXPECT_THROW(parse_sizes(bare.bytes(), Encoding::bytes, 1), InputError);
}

}  // namespace
}  // namespace cavea::test
