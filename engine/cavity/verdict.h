#pragma once
#include <array>
#include <cstdint>

namespace cavea {

/// What an operator says about a local operation; everything but accept says why not.
enum class Verdict : std::uint8_t {
  kAccept,
  kNotNeeded,       ///< nothing asks for it here
  kInverted,        ///< a new tet would not be certainly positive
  kWorseQuality,    ///< below the floor of the phase, or no gain
  kOffSurface,      ///< the surface would leave its tolerance
  kFolded,          ///< a surface triangle would turn away from the ideal surface
  kBreaksFeature,   ///< a ridge, corner, reference or required entity forbids it
  kBreaksTopology,  ///< link condition
  kBadLength,       ///< an edge would become too long or too short
  kFrozen,          ///< belongs to the interface between parts
  kTooLarge,        ///< a ring or ball beyond what the operator handles
};
inline constexpr int kVerdicts = 11;

inline const char* name(Verdict v) {
  constexpr std::array<const char*, kVerdicts> kNames = {
      "accept",         "not_needed",      "inverted",   "worse_quality", "off_surface", "folded",
      "breaks_feature", "breaks_topology", "bad_length", "frozen",        "too_large"};
  return kNames[static_cast<std::size_t>(v)];
}

enum class Operator : std::uint8_t {
  kEdgeSplit,
  kEdgeCollapse,
  kEdgeSwap,
  kFaceSwap,
  kRelocate,
  kEdgeStar,
  kReconnect,
  kVertexInsert,
  kSurfaceInsert,
  kSurfaceMerge
};
inline constexpr int kOperators = 10;

inline const char* name(Operator o) {
  constexpr std::array<const char*, kOperators> kNames = {
      "edge_split", "edge_collapse", "edge_swap",     "face_swap",      "relocate",
      "edge_star",  "reconnect",     "vertex_insert", "surface_insert", "surface_merge"};
  return kNames[static_cast<std::size_t>(o)];
}

/// Counts of verdicts per operator.
struct VerdictTable {
  std::array<std::array<std::int64_t, kVerdicts>, kOperators> count{};

  void add(Operator o, Verdict v) { ++count[std::size_t(o)][std::size_t(v)]; }
  std::int64_t accepted(Operator o) const { return count[std::size_t(o)][0]; }
  VerdictTable& operator+=(const VerdictTable& b) {
    for (std::size_t o = 0; o < kOperators; ++o)
      for (std::size_t v = 0; v < kVerdicts; ++v) count[o][v] += b.count[o][v];
    return *this;
  }
};

}  // namespace cavea
