// The writer: two tets become three and two again, at faces in random order.
#include <benchmark/benchmark.h>

#include "cavea/cavity/mesh_editor.h"
#include "meshes.h"

namespace {

using namespace cavea;

/// The two tets at face `f` of `t` become three around the line between their apices, whatever
/// their volumes: the writer asks for none.
void two_to_three(const TetMesh& m, TetId t, int f, Cavity& cavity) {
  const FaceLink other = m.links[t][f];
  const VertexId top = m.tets[t][f], bottom = m.tets[other.tet()][other.face()];
  cavity.clear();
  for (int k = 0; k < 3; ++k) {
    const VertexId a = m.tets[t][kFaceVertices[f][k]], b = m.tets[t][kFaceVertices[f][(k + 1) % 3]];
    cavity.tets.push_back({{top, bottom, a, b}, m.tet_refs[t], m.qualities[t]});
  }
  cavity.removed_tets = {t, other.tet()};
}

/// What takes back the flip in `cavity`, whose new tets got the ids `created`: the tets that it
/// removed come back as they were `before`, with the same ids.
void three_to_two(const TetMesh& before, const std::vector<TetId>& created, Cavity& cavity) {
  const std::vector<TetId> gone = cavity.removed_tets;
  cavity.clear();
  for (const TetId t : gone)
    cavity.tets.push_back({before.tets[t], before.tet_refs[t], before.qualities[t]});
  cavity.removed_tets = created;
}

/// One living tet in ten, with a face that it shares with another one: in random order.
std::vector<FaceLink> some_faces(const TetMesh& mesh) {
  std::vector<FaceLink> faces;
  const std::vector<std::int32_t> order = bench::random_order(mesh.tets.size());
  for (std::size_t i = 0; i < order.size(); i += 10)
    for (int f = 0; f < 4; ++f)
      if (mesh.links[order[i]][f].is_tet()) {
        faces.push_back(FaceLink::to_tet(order[i], f));
        break;
      }
  return faces;
}

void commit(benchmark::State& state) {
  const TetMesh& before = bench::lattice(state.range(0));
  const std::vector<FaceLink> faces = some_faces(before);
  TetMesh mesh = before;
  MeshEditor editor(mesh);
  Cavity cavity;
  for (auto _ : state)
    for (const FaceLink face : faces) {
      two_to_three(mesh, face.tet(), face.face(), cavity);
      editor.commit(cavity);
      three_to_two(before, editor.created(), cavity);
      editor.commit(cavity);
    }
  state.SetItemsProcessed(2 * state.iterations() * std::int64_t(faces.size()));
}
BENCHMARK(commit)->Arg(bench::kSmall)->Arg(bench::kLarge);

}  // namespace
