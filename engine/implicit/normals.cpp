#include "cavea/implicit/normals.h"

#include "cavea/base/parallel.h"
#include "cavea/mesh/statistics.h"

namespace cavea {
namespace {

// 2^-40 of an edge: beyond any tolerance, and well above the rounding of the function's values.
constexpr int kBisections = 40;

// Of the box diagonal. The error of central differences is of second order in it, that of rounding
// is 1e-16 over it: about 1e-10 each.
constexpr double kDifferenceStep = 1e-5;

Vec3 gradient(const std::function<double(const Vec3&)>& f, const Vec3& p, double h) {
  return {f({p.x + h, p.y, p.z}) - f({p.x - h, p.y, p.z}),
          f({p.x, p.y + h, p.z}) - f({p.x, p.y - h, p.z}),
          f({p.x, p.y, p.z + h}) - f({p.x, p.y, p.z - h})};
}

}  // namespace

double zero_on_edge(const std::function<double(const Vec3&)>& function, double isovalue,
                    const Vec3& a, const Vec3& b, double at_a, double at_b) {
  if ((at_a < 0) == (at_b < 0)) return at_a == 0 ? 0 : 1;
  double low = 0, high = 1;
  for (int k = 0; k < kBisections; ++k) {
    const double middle = (low + high) / 2;
    const double value = function(a + (b - a) * middle) - isovalue;
    ((value < 0) == (at_a < 0) ? low : high) = middle;
  }
  return (low + high) / 2;
}

void add_normals(const std::function<double(const Vec3&)>& function, const TetMesh& mesh,
                 std::span<const char> on_interface, MeshData& data) {
  const double h = kDifferenceStep * box_diagonal(mesh);
  std::vector<Vec3> normals(on_interface.size());
  parallel_for(normals.size(), [&](std::size_t v) {
    if (on_interface[v]) normals[v] = gradient(function, mesh.points[v], h);
  });
  for (std::size_t v = 0; v < normals.size(); ++v) {
    if (!on_interface[v] || !is_finite(normals[v])) continue;
    data.normal_at_vertices.push_back({std::int32_t(v), std::int32_t(data.normals.size())});
    data.normals.push_back(normals[v]);
  }
}

}  // namespace cavea
