// Collapses beside the cuts between parts.
#include "cavea/cavity/mesh_editor.h"
#include "cavea/operator/context.h"
#include "cavea/operator/edge_collapse.h"
#include "part/support.h"

namespace cavea::test {
namespace {

/// The face 0 1 2 between tets of one reference, and an interface of three triangles right above
/// it that meet in vertex 3: when that goes, the face becomes the interface.
MeshData blister() {
  MeshData data;
  data.vertices = {{0, 0, 0}, {1, 0, 0}, {.5, .9, 0}, {.5, .3, .01}, {.5, .3, .9}, {.5, .3, -.9}};
  data.tets = {{0, 1, 2, 3}, {0, 1, 3, 4}, {1, 2, 3, 4}, {2, 0, 3, 4}, {0, 2, 1, 5}};
  data.tet_refs = {2, 1, 1, 1, 2};
  return data;
}

/// Asks to collapse the blister's vertex onto one of its face.
struct Asked {
  explicit Asked(TetMesh& mesh, const SurfaceModel& surface) : context(mesh, surface) {
    const auto at = [&](const Vec3& x) {
      return VertexId(std::find(mesh.points.begin(), mesh.points.end(), x) - mesh.points.begin());
    };
    const MeshData data = blister();
    const VertexId p = at(data.vertices[3]), q = at(data.vertices[0]);
    gather_ball(mesh, p, context.marker, context.ball);
    for (const TetId t : context.ball.tets)
      if (const int j = mesh.local_index(t, q); j < 4)
        gather_shell(mesh, t, mesh.local_index(t, p), j, context.shell);
    verdict = edge_collapse(context, false, cavity);
  }
  OperatorContext context;
  Cavity cavity;
  Verdict verdict;
};

struct Scene {
  TetMesh mesh = [] {
    TetMesh m = build(blister()).mesh;
    classify_features(m, {});
    return m;
  }();
  SurfaceModel surface{mesh, {.02, .06, .1, 100}};
  Scene() { mesh.sizes.assign(mesh.points.size(), 100.f); }
};

TEST(Collapse, MakesAFaceInsideAnInterface) {
  Scene scene;
  Asked asked(scene.mesh, scene.surface);
  ASSERT_EQ(asked.verdict, Verdict::kAccept);
  MeshEditor(scene.mesh).commit(asked.cavity);
  compact(scene.mesh);
  expect_sound(scene.mesh);
  EXPECT_EQ(scene.mesh.tets.size(), 2u);
}

TEST(Collapse, LeavesFacesOfCutsAlone) {
  Scene scene;
  Labels labels;
  for (const auto& tet : scene.mesh.tets)
    labels.push_back(std::count(tet.begin(), tet.end(), VertexId(5)) ? 1 : 0);
  std::vector<Part> parts = extract_parts(scene.mesh, labels, 2);
  ASSERT_EQ(parts[0].mesh.tets.size(), 4u);
  EXPECT_EQ(Asked(parts[0].mesh, scene.surface).verdict, Verdict::kFrozen);
}

}  // namespace
}  // namespace cavea::test
