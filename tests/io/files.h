#pragma once
// Files in a folder of their own, and the sample meshes that the tests of this folder share.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "../support/meshes.h"
#include "cavea/io/formats.h"

namespace cavea::test {

/// A new folder, removed at the end with what it holds.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "cavea-io-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { std::filesystem::remove_all(path_); }

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  std::filesystem::path put(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }
  std::size_t entries() const {
    return std::size_t(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

 private:
  std::filesystem::path path_;
};

inline std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Two tets with every section that there is, one entity a line.
inline const std::string kFullText = R"(MeshVersionFormatted 2
Dimension 3
Vertices
5
0 0 0 1
1 0 0 2
0 1 0 3
0 0 1 4
1 1 1 5
Tetrahedra
2
1 2 3 4 7
2 3 4 5 8
Triangles
2
1 3 2 11
1 2 4 12
Edges
2
1 2 21
1 3 22
Corners
1
1
Ridges
1
2
RequiredVertices
2
2
3
RequiredEdges
1
1
RequiredTriangles
1
2
RequiredTetrahedra
1
2
Normals
2
0 0 -1
0 -1 0
NormalAtVertices
2
2 1
3 2
Tangents
1
1 0 0
TangentAtVertices
1
2 1
End
)";

/// The text with the first occurrence of `from` replaced.
inline std::string edited(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the text has no " + from);
  return text.replace(at, from.size(), to);
}

/// Bit for bit: 0 and -0 differ.
template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// All that a mesh file holds: not the sizes and the parts.
inline void expect_same_mesh(const MeshData& a, const MeshData& b) {
  EXPECT_TRUE(same_bits(a.vertices, b.vertices));
  EXPECT_EQ(a.vertex_refs, b.vertex_refs);
  EXPECT_EQ(a.tets, b.tets);
  EXPECT_EQ(a.tet_refs, b.tet_refs);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.triangle_refs, b.triangle_refs);
  EXPECT_EQ(a.edges, b.edges);
  EXPECT_EQ(a.edge_refs, b.edge_refs);
  EXPECT_EQ(a.corners, b.corners);
  EXPECT_EQ(a.ridges, b.ridges);
  EXPECT_EQ(a.required_vertices, b.required_vertices);
  EXPECT_EQ(a.required_edges, b.required_edges);
  EXPECT_EQ(a.required_triangles, b.required_triangles);
  EXPECT_EQ(a.required_tets, b.required_tets);
  EXPECT_TRUE(same_bits(a.normals, b.normals));
  EXPECT_EQ(a.normal_at_vertices, b.normal_at_vertices);
  EXPECT_TRUE(same_bits(a.tangents, b.tangents));
  EXPECT_EQ(a.tangent_at_vertices, b.tangent_at_vertices);
}

/// A double of any magnitude and sign: random bits that are a finite number.
inline double any_double(Random& random) {
  double x;
  do {
    const std::uint64_t bits =
        (std::uint64_t(random.unit() * 0x1p32) << 32) | std::uint64_t(random.unit() * 0x1p32);
    std::memcpy(&x, &bits, sizeof x);
  } while (!std::isfinite(x));
  return x;
}

/// Lists of random lengths with random content; no mesh, but a file must bear it.
inline MeshData random_lists(std::uint64_t seed) {
  Random random(seed);
  MeshData d;
  const auto length = [&] { return std::size_t(random.below(40)); };
  const auto any_ref = [&] { return std::int32_t(random.between(-0x1p31, 0x1p31)); };
  const auto fill = [&](auto& list, std::size_t n, auto&& make) {
    for (std::size_t i = 0; i < n; ++i) list.push_back(make());
  };
  const auto vector = [&] {
    return Vec3{any_double(random), any_double(random), any_double(random)};
  };
  const auto index_into = [&](const auto& list) {
    return [&] { return random.below(std::int32_t(list.size())); };
  };
  const auto tuples = [&](auto& list, std::size_t n) {
    list.resize(n);
    for (auto& row : list)
      for (auto& v : row) v = random.below(std::int32_t(d.vertices.size()));
  };
  const auto pairs = [&](auto& list, const auto& to) {
    if (!to.empty())
      fill(list, length(), [&] { return std::array{index_into(d.vertices)(), index_into(to)()}; });
  };
  fill(d.vertices, 1 + length(), vector);
  fill(d.vertex_refs, d.vertices.size(), any_ref);
  tuples(d.tets, 1 + length());
  fill(d.tet_refs, d.tets.size(), any_ref);
  tuples(d.triangles, length());
  fill(d.triangle_refs, d.triangles.size(), any_ref);
  tuples(d.edges, length());
  fill(d.edge_refs, d.edges.size(), any_ref);
  fill(d.corners, length(), index_into(d.vertices));
  fill(d.required_vertices, length(), index_into(d.vertices));
  fill(d.required_tets, length(), index_into(d.tets));
  if (!d.edges.empty()) fill(d.ridges, length(), index_into(d.edges));
  if (!d.edges.empty()) fill(d.required_edges, length(), index_into(d.edges));
  if (!d.triangles.empty()) fill(d.required_triangles, length(), index_into(d.triangles));
  fill(d.normals, length(), vector);
  fill(d.tangents, length(), vector);
  pairs(d.normal_at_vertices, d.normals);
  pairs(d.tangent_at_vertices, d.tangents);
  fill(d.sizes, d.vertices.size(), [&] { return random.between(1e-9, 1e9); });
  return d;
}

/// Runs f, which must throw an E; returns its message.
template <class E, class F>
std::string message_of(F&& f) {
  try {
    f();
  } catch (const E& e) {
    return e.what();
  }
  ADD_FAILURE() << "no error was thrown";
  return {};
}

}  // namespace cavea::test
