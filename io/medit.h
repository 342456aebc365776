#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "cavea/mesh/mesh_data.h"

// What the ASCII and the binary Medit format have in common: the sections of a mesh.
namespace cavea::medit {

/// What an index in a section counts.
enum class Target { vertex, edge, triangle, tet, normal, tangent };
inline constexpr int kTargets = 6;

enum class SectionId {
  vertices,
  corners,
  required_vertices,
  tets,
  required_tets,
  triangles,
  required_triangles,
  edges,
  ridges,
  required_edges,
  normals,
  normal_at_vertices,
  tangents,
  tangent_at_vertices,
};

/// A section that Cavea understands.
struct Keyword {
  SectionId id;
  std::string_view name;
  std::int32_t code;        ///< in the binary format
  std::string_view entity;  ///< one of its rows, in words
  std::array<Target, 4> targets = {Target::vertex, Target::vertex, Target::vertex,
                                   Target::vertex};  ///< of the indices of a row
};

inline constexpr std::string_view kVersionName = "MeshVersionFormatted";
inline constexpr std::string_view kDimensionName = "Dimension";
inline constexpr std::string_view kEndName = "End";
inline constexpr std::string_view kSolutionName = "SolAtVertices";
inline constexpr std::int32_t kDimensionCode = 3;
inline constexpr std::int32_t kEndCode = 54;
inline constexpr std::int32_t kSolutionCode = 62;
inline constexpr int kFirstVersion = 1, kLastVersion = 4;
inline constexpr int kDimension = 3;
inline constexpr int kScalar = 1, kVector = 2, kTensor = 3;  ///< types of a field in a solution

/// In the order in which they are written. Codes: the public header libmeshb7.h of libMeshb 7. That
/// one has no RequiredTetrahedra; 12, reserved there, is what mmg3d 5.8 writes and reads.
std::span<const Keyword> keywords();
const Keyword* find_keyword(std::string_view name);
const Keyword* find_keyword(std::int32_t code);
/// Name of a code that is not understood, where the format has one; else empty.
std::string_view name_of_code(std::int32_t code);
/// Cells other than tetrahedra: part of a mesh, so a warning says that they are lost.
bool is_other_cell(std::string_view name);
/// \throw OptionError for a version that Cavea does not write.
void check_written_version(int version);

/// Calls f(rows, refs) with the lists of a section; refs is a null constant where it has none.
template <class Data, class F>
void visit_section(SectionId id, Data& d, F&& f) {
  switch (id) {
    case SectionId::vertices:
      return f(d.vertices, &d.vertex_refs);
    case SectionId::corners:
      return f(d.corners, nullptr);
    case SectionId::required_vertices:
      return f(d.required_vertices, nullptr);
    case SectionId::tets:
      return f(d.tets, &d.tet_refs);
    case SectionId::required_tets:
      return f(d.required_tets, nullptr);
    case SectionId::triangles:
      return f(d.triangles, &d.triangle_refs);
    case SectionId::required_triangles:
      return f(d.required_triangles, nullptr);
    case SectionId::edges:
      return f(d.edges, &d.edge_refs);
    case SectionId::ridges:
      return f(d.ridges, nullptr);
    case SectionId::required_edges:
      return f(d.required_edges, nullptr);
    case SectionId::normals:
      return f(d.normals, nullptr);
    case SectionId::normal_at_vertices:
      return f(d.normal_at_vertices, nullptr);
    case SectionId::tangents:
      return f(d.tangents, nullptr);
    case SectionId::tangent_at_vertices:
      return f(d.tangent_at_vertices, nullptr);
  }
}

/// Numbers in one row of a section.
struct RowLayout {
  int reals = 0, integers = 0;
};
constexpr RowLayout layout_of(const Vec3*, bool with_ref) { return {3, with_ref}; }
constexpr RowLayout layout_of(const double*, bool) { return {1, 0}; }
constexpr RowLayout layout_of(const std::int32_t*, bool) { return {0, 1}; }
template <std::size_t N>
constexpr RowLayout layout_of(const std::array<std::int32_t, N>*, bool with_ref) {
  return {0, int(N) + with_ref};
}

}  // namespace cavea::medit
