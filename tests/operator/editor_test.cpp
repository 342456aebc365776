#include "cavea/base/error.h"
#include "operator/stage.h"

namespace cavea::test {
namespace {

/// A stage whose cavity is the split of an edge inside the volume.
void split_inside(Stage& stage) {
  for (const Edge& e : edges_of(stage.mesh))
    if (stage.find_edge(e[0], e[1]) && stage.context.shell.closed &&
        stage.split() == Verdict::kAccept)
      return;
  FAIL() << "no edge could be split";
}

TEST(MeshEditor, RefusesACavityThatDoesNotClose) {
  {
    SCOPED_TRACE("a new tet is missing");
    Stage stage(kuhn_cube(2));
    split_inside(stage);
    stage.cavity.tets.pop_back();
    EXPECT_THROW(stage.editor.commit(stage.cavity), InternalError);
  }
  {
    SCOPED_TRACE("a tet is not removed");
    Stage stage(kuhn_cube(2));
    split_inside(stage);
    stage.cavity.removed_tets.pop_back();
    EXPECT_THROW(stage.editor.commit(stage.cavity), InternalError);
  }
  {
    SCOPED_TRACE("a new tet has a wrong vertex");
    Stage stage(kuhn_cube(2));
    split_inside(stage);
    auto& v = stage.cavity.tets[0].v;
    for (VertexId other = 0; other < VertexId(stage.mesh.points.size()); ++other)
      if (std::find(v.begin(), v.end(), other) == v.end()) {
        v[2] = other;
        break;
      }
    EXPECT_THROW(stage.editor.commit(stage.cavity), InternalError);
  }
}

/// A stage whose cavity is the split of an edge of the surface.
void split_on_surface(Stage& stage) {
  for (const Edge& e : edges_of(stage.mesh))
    if (stage.find_edge(e[0], e[1]) && stage.context.shell.on_surface() &&
        stage.split() == Verdict::kAccept)
      return;
  FAIL() << "no edge of the surface could be split";
}

TEST(MeshEditor, TellsOfACavityAtTheSurfaceWhetherItCloses) {
  Stage stage(kuhn_cube(2));
  split_on_surface(stage);
  const Cavity whole = stage.cavity;
  const TetMesh before = stage.mesh;
  EXPECT_TRUE(stage.editor.closes(whole));
  const auto expect_open = [&](const char* what, auto&& change) {
    SCOPED_TRACE(what);
    Cavity cavity = whole;
    change(cavity);
    EXPECT_FALSE(stage.editor.closes(cavity));
  };
  expect_open("a new tet is missing", [](Cavity& c) { c.tets.pop_back(); });
  expect_open("a new triangle is missing", [](Cavity& c) { c.triangles.pop_back(); });
  expect_open("a tet is not removed", [](Cavity& c) { c.removed_tets.pop_back(); });
  // As two faces of the same vertices: each face is used an even number of times.
  expect_open("a new tet is there three times", [](Cavity& c) {
    const NewTet t = c.tets.front();
    c.tets.insert(c.tets.end(), 2, t);
  });
  expect_open("a tet is removed twice, and two more are new", [](Cavity& c) {
    c.removed_tets.push_back(c.removed_tets.front());
    const NewTet t = c.tets.front();
    c.tets.insert(c.tets.end(), 2, t);
  });
  EXPECT_EQ(stage.mesh.tet_flags, before.tet_flags);
  stage.editor.commit(whole);
  expect_sound(stage.mesh);
}

TEST(MeshEditor, FillsTheHolesThatItHasMade) {
  Stage stage(kuhn_cube(3));
  std::int64_t collapsed = 0;
  for (const Edge& e : edges_of(stage.mesh))
    if (stage.find_edge(e[0], e[1]) && stage.collapse() == Verdict::kAccept) {
      stage.editor.commit(stage.cavity);
      ++collapsed;
    }
  ASSERT_GT(collapsed, 0);
  const std::size_t points = stage.mesh.points.size();
  EXPECT_FALSE(stage.mesh.vertex_alive(stage.editor.next_vertex()));
  for (std::int64_t i = 0; i < collapsed; ++i) {
    split_inside(stage);
    stage.editor.commit(stage.cavity);
  }
  EXPECT_EQ(stage.mesh.points.size(), points);
  expect_sound(stage.mesh);
}

TEST(MeshEditor, KnowsTetsOfVerticesThatNoNewTetHas) {
  MeshData data;  // two tets, one on the other
  data.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1}, {0.3, 0.3, -1}};
  data.tets = {{0, 2, 1, 4}, {0, 1, 2, 3}};
  data.vertex_refs.assign(5, 0), data.tet_refs.assign(2, 1);
  for (const VertexId cut : {3, 4}) {
    TetMesh mesh = build(data).mesh;
    const TetId tet = mesh.local_index(0, cut) < 4 ? 0 : 1;
    Cavity cavity;
    cavity.removed_tets = {tet};
    cavity.removed_vertices = {cut};
    for (const FaceLink link : mesh.links[tet])
      if (link.is_triangle()) cavity.removed_triangles.push_back(link.triangle());
    Triangle face = mesh.triangles[cavity.removed_triangles[0]];
    face.v = cut == 3 ? std::array<VertexId, 3>{0, 1, 2} : std::array<VertexId, 3>{0, 2, 1};
    cavity.triangles = {face};
    MeshEditor(mesh).commit(cavity);
    expect_sound(mesh);
  }
}

TEST(MeshEditor, AnotherOneOfTheSameMeshKnowsItsHoles) {
  Stage stage(kuhn_cube(3));
  for (const Edge& e : edges_of(stage.mesh))
    if (stage.find_edge(e[0], e[1]) && stage.collapse() == Verdict::kAccept)
      stage.editor.commit(stage.cavity);
  const MeshEditor another(stage.mesh);
  EXPECT_EQ(another.living_tets(), stage.editor.living_tets());
  EXPECT_FALSE(stage.mesh.vertex_alive(another.next_vertex()));
}

}  // namespace
}  // namespace cavea::test
