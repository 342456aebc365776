#include "distort.h"

#include <cstdint>
#include <vector>

#include "cavea/geometry/quality.h"

namespace cavea::sample {
namespace {

constexpr double kWorstQuality = 0.01;  // of the distorted mesh
constexpr double kReach = 6;            // longest single move in millimetres: about one brick
constexpr int kSweeps = 8;
constexpr int kHalvings = 6;  // of a move that would go below the worst quality
constexpr std::uint64_t kSeed = 20240229;

/// SplitMix64 (Steele, Lea, Flood 2014): the same numbers with every library, unlike <random>'s
/// distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// In [-1, 1).
  double symmetric() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
    return static_cast<double>(z >> 11) * 0x1.0p-52 - 1;
  }

 private:
  std::uint64_t state_;
};

using Balls = std::vector<std::vector<std::size_t>>;

Balls find_balls(const MeshData& mesh) {
  Balls balls(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (const auto v : mesh.tets[t]) balls[v].push_back(t);
  return balls;
}

double worst_quality(const MeshData& mesh, const std::vector<std::size_t>& ball) {
  double worst = 1;
  for (const std::size_t t : ball) {
    const auto& k = mesh.tets[t];
    const auto& p = mesh.vertices;
    worst = std::min(worst, tet_quality(p[k[0]], p[k[1]], p[k[2]], p[k[3]]));
  }
  return worst;
}

void throw_vertex(MeshData& mesh, std::size_t v, Vec3 move, const std::vector<std::size_t>& ball) {
  const Vec3 home = mesh.vertices[v];
  for (int k = 0; k < kHalvings; ++k, move *= 0.5) {
    mesh.vertices[v] = rounded(home + move);
    if (worst_quality(mesh, ball) >= kWorstQuality) return;
  }
  mesh.vertices[v] = home;
}

}  // namespace

void distort(Bracket& bracket) {
  const Balls balls = find_balls(bracket.mesh);
  Random random(kSeed);
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (std::size_t v = 0; v < bracket.mesh.vertices.size(); ++v) {
      const int axis = fixed_axis(bracket.surfaces_of_vertex[v]);
      if (axis < 0) continue;
      // One call a line: the order in which arguments are evaluated is the compiler's choice.
      Vec3 move;
      move.x = kReach * random.symmetric();
      move.y = kReach * random.symmetric();
      move.z = kReach * random.symmetric();
      if (axis == 0) move.x = 0;
      if (axis == 1) move.y = 0;
      if (axis == 2) move.z = 0;
      throw_vertex(bracket.mesh, v, move, balls[v]);
    }
}

}  // namespace cavea::sample
