#pragma once
#include <cstdint>
#include <optional>

namespace cavea {

/// What is asked for, instead of the run's own values, where triangles or tets have one reference.
struct LocalParameters {
  enum class Entity { kTriangles, kTets };

  Entity entity = Entity::kTriangles;
  std::int32_t reference = 0;
  /// Shortest and longest wanted edge, in the mesh's unit; the run's where not set.
  std::optional<double> hmin, hmax;
  std::optional<double> hausd;  ///< of triangles only
};

}  // namespace cavea
