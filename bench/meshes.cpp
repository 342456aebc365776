#include "meshes.h"

#include <map>
#include <utility>

#include "cavea/mesh/build.h"
#include "support/meshes.h"
#include "support/shells.h"

namespace cavea::bench {
namespace {

constexpr std::uint64_t kSeed = 7;
/// Of a brick's width: all tets stay positive.
constexpr double kAmplitude = 0.1;

void append(const MeshData& shell, MeshData& all) {
  const auto first = std::int32_t(all.vertices.size());
  all.vertices.insert(all.vertices.end(), shell.vertices.begin(), shell.vertices.end());
  for (auto tet : shell.tets) {
    for (std::int32_t& v : tet) v += first;
    all.tets.push_back(tet);
  }
}

TetMesh make_shells(std::int64_t tets, std::int64_t count) {
  test::Random random(kSeed);
  MeshData all;
  for (std::int64_t made = 0; made < count;) {
    const MeshData shell = test::random_shell(int(tets), random);
    if (shell.tets.empty()) continue;
    append(shell, all);
    ++made;
  }
  all.vertex_refs.assign(all.vertices.size(), 0);
  all.tet_refs.assign(all.tets.size(), 1);
  return build(all).mesh;
}

TetMesh make_lattice(std::int64_t n) {
  MeshData data = test::kuhn_cube(int(n));
  test::perturb_inside(data, kAmplitude / double(n), kSeed);
  return build(data).mesh;
}

}  // namespace

const TetMesh& lattice(std::int64_t n) {
  static std::map<std::int64_t, TetMesh> made;
  const auto at = made.find(n);
  return at != made.end() ? at->second : made.emplace(n, make_lattice(n)).first->second;
}

const TetMesh& shells(std::int64_t tets, std::int64_t count) {
  static std::map<std::pair<std::int64_t, std::int64_t>, TetMesh> made;
  const std::pair key(tets, count);
  const auto at = made.find(key);
  return at != made.end() ? at->second : made.emplace(key, make_shells(tets, count)).first->second;
}

std::vector<std::int32_t> random_order(std::size_t n) {
  test::Random random(kSeed);
  return test::random_order(n, random);
}

}  // namespace cavea::bench
