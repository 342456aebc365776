#include "sample_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cavea::program {
namespace {

constexpr Vec3 kCenter{0.5, 0.5, 0.5};

double sphere(const Vec3& p) { return distance(p, kCenter) - 0.3; }

double torus(const Vec3& p) {
  const Vec3 q = p - kCenter;
  return std::hypot(std::hypot(q.x, q.y) - 0.28, q.z) - 0.12;
}

double gyroid(const Vec3& p) {
  constexpr double s = 4 * std::numbers::pi;
  const Vec3 q = p * s;
  return (std::sin(q.x) * std::cos(q.y) + std::sin(q.y) * std::cos(q.z) +
          std::sin(q.z) * std::cos(q.x)) /
         s;
}

/// The polynomial smooth minimum (Quilez) of the distances from two spheres.
double smooth_union(const Vec3& p) {
  constexpr double kBlend = 0.1;
  const double a = distance(p, {0.36, 0.5, 0.5}) - 0.2, b = distance(p, {0.66, 0.5, 0.5}) - 0.16;
  const double h = std::max(kBlend - std::abs(a - b), 0.0) / kBlend;
  return std::min(a, b) - h * h * kBlend / 4;
}

struct Named {
  const char* name;
  double (*value)(const Vec3&);
  double steepest;
};

/// The gyroid's slope is at most sqrt 3, that of each of its terms 1 along each of two axes.
constexpr Named kShapes[] = {
    {"sphere", sphere, 1}, {"torus", torus, 1}, {"gyroid", gyroid, 2}, {"union", smooth_union, 1}};

}  // namespace

std::vector<std::string> sample_shape_names() {
  std::vector<std::string> names;
  for (const Named& shape : kShapes) names.emplace_back(shape.name);
  return names;
}

SampleShape sample_shape(const std::string& name) {
  const auto* shape = std::ranges::find_if(kShapes, [&](const Named& s) { return name == s.name; });
  return {shape->value, {{0, 0, 0}, {1, 1, 1}}, shape->steepest};
}

}  // namespace cavea::program
