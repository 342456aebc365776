#include "cavea/io/medit.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "cavea/base/error.h"

namespace cavea::medit {
namespace {

constexpr std::array<Target, 4> all(Target t) { return {t, t, t, t}; }

constexpr Keyword kKeywords[] = {
    {SectionId::vertices, "Vertices", 4, "vertex"},
    {SectionId::corners, "Corners", 13, "corner"},
    {SectionId::required_vertices, "RequiredVertices", 15, "required vertex"},
    {SectionId::tets, "Tetrahedra", 8, "tetrahedron"},
    {SectionId::required_tets, "RequiredTetrahedra", 12, "required tetrahedron", all(Target::tet)},
    {SectionId::triangles, "Triangles", 6, "triangle"},
    {SectionId::required_triangles, "RequiredTriangles", 17, "required triangle",
     all(Target::triangle)},
    {SectionId::edges, "Edges", 5, "edge"},
    {SectionId::ridges, "Ridges", 14, "ridge", all(Target::edge)},
    {SectionId::required_edges, "RequiredEdges", 16, "required edge", all(Target::edge)},
    {SectionId::normals, "Normals", 60, "normal"},
    {SectionId::normal_at_vertices,
     "NormalAtVertices",
     20,
     "normal at vertex",
     {Target::vertex, Target::normal}},
    {SectionId::tangents, "Tangents", 59, "tangent"},
    {SectionId::tangent_at_vertices,
     "TangentAtVertices",
     61,
     "tangent at vertex",
     {Target::vertex, Target::tangent}},
};

/// Sections that real meshes have and Cavea has no use for.
constexpr std::pair<std::int32_t, std::string_view> kOtherNames[] = {
    {7, "Quadrilaterals"},
    {9, "Prisms"},
    {10, "Hexahedra"},
    {18, "RequiredQuadrilaterals"},
    {19, "TangentAtEdgeVertices"},
    {21, "NormalAtTriangleVertices"},
    {22, "NormalAtQuadrilateralVertices"},
    {23, "AngleOfCornerBound"},
    {49, "Pyramids"},
    {50, "BoundingBox"},
    {kSolutionCode, kSolutionName},
};

template <class Matches>
const Keyword* find_keyword_if(Matches&& matches) {
  const auto* found = std::find_if(std::begin(kKeywords), std::end(kKeywords), matches);
  return found == std::end(kKeywords) ? nullptr : found;
}

}  // namespace

std::span<const Keyword> keywords() { return kKeywords; }

const Keyword* find_keyword(std::string_view name) {
  return find_keyword_if([&](const Keyword& k) { return k.name == name; });
}

const Keyword* find_keyword(std::int32_t code) {
  return find_keyword_if([&](const Keyword& k) { return k.code == code; });
}

std::string_view name_of_code(std::int32_t code) {
  for (const auto& [other, name] : kOtherNames)
    if (other == code) return name;
  return {};
}

bool is_other_cell(std::string_view name) {
  constexpr std::string_view kCells[] = {"Quadrilaterals", "Prisms", "Hexahedra", "Pyramids"};
  return std::find(std::begin(kCells), std::end(kCells), name) != std::end(kCells);
}

void check_written_version(int version) {
  if (version != 2 && version != 3)
    throw OptionError(fmt::format("Medit version {} is not written, only 2 and 3", version));
}

}  // namespace cavea::medit
