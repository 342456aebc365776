// Each operator on all the edges, faces or vertices of small meshes, in a random order.
#include <functional>
#include <limits>

#include "cavea/mesh/statistics.h"
#include "cavea/operator/surface_insert.h"
#include "cavea/operator/surface_merge.h"
#include "cavea/operator/vertex_insert.h"
#include "operator/stage.h"

namespace cavea::test {
namespace {

/// The two ends of an edge, a tet and its face, or a vertex and nothing.
using Item = std::array<std::int32_t, 2>;

struct Action {
  Operator op;
  std::vector<Item> (*items)(const TetMesh&);
  bool (*attempt)(Stage&, const Item&);  ///< does it, if the operator accepts
};

bool commit_if(Stage& stage, Verdict verdict) {
  if (verdict != Verdict::kAccept) return false;
  stage.editor.commit(stage.cavity);
  return true;
}

std::vector<Item> faces_of(const TetMesh& mesh) {
  std::vector<Item> faces;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (int f = 0; f < 4; ++f) faces.push_back({TetId(t), f});
  return faces;
}

std::vector<Item> tets_of(const TetMesh& mesh) {
  std::vector<Item> tets;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) tets.push_back({TetId(t), 0});
  return tets;
}

std::vector<Item> vertices_of(const TetMesh& mesh) {
  std::vector<Item> vertices;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) vertices.push_back({VertexId(v), 0});
  return vertices;
}

bool relocate_and_move(Stage& stage, const Item& item) {
  NewVertex to;
  if (!stage.mesh.vertex_alive(item[0]) || relocate(stage.context, item[0], to) != Verdict::kAccept)
    return false;
  stage.editor.move(item[0], to, stage.context.ball.tets, stage.context.qualities);
  return true;
}

bool insert_in_the_middle(Stage& stage, const Item& item) {
  if (!stage.mesh.tet_alive(item[0])) return false;
  const auto [a, b, c, d] = stage.mesh.corners(item[0]);
  NewVertex x;
  x.point = (a + b + c + d) / 4;
  x.size = float(distance(x.point, a));
  constexpr double kFar = std::numeric_limits<double>::max();
  VertexInsert insert(stage.mesh, Box{{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}});
  const VertexId id = stage.editor.next_vertex();
  return insert(x, id, item[0], stage.cavity) == Verdict::kAccept &&
         commit_if(stage, Verdict::kAccept);
}

/// The second end of an edge to the first.
bool merge_features(Stage& s, const Item& e) {
  if (!s.mesh.vertex_alive(e[0]) || !s.mesh.vertex_alive(e[1])) return false;
  const Junction junction{{e[0], e[1]}, {}, s.mesh.points[e[0]]};
  return commit_if(s, surface_merge(s.context, junction, 0.3, s.editor.next_vertex(), s.cavity));
}

const Action kActions[] = {
    {Operator::kEdgeSplit, edges_of,
     [](Stage& s, const Item& e) { return s.find_edge(e[0], e[1]) && commit_if(s, s.split()); }},
    {Operator::kEdgeCollapse, edges_of,
     [](Stage& s, const Item& e) { return s.find_edge(e[0], e[1]) && commit_if(s, s.collapse()); }},
    {Operator::kEdgeSwap, edges_of,
     [](Stage& s, const Item& e) {
       return s.find_edge(e[0], e[1]) && commit_if(s, s.swap_edge());
     }},
    {Operator::kFaceSwap, faces_of,
     [](Stage& s, const Item& f) {
       return s.mesh.tet_alive(f[0]) && commit_if(s, face_swap(s.context, f[0], f[1], s.cavity));
     }},
    {Operator::kRelocate, vertices_of, relocate_and_move},
    {Operator::kEdgeStar, edges_of,
     [](Stage& s, const Item& e) {
       return s.find_edge(e[0], e[1]) &&
              commit_if(s, edge_star(s.context, s.editor.next_vertex(), s.cavity));
     }},
    {Operator::kReconnect, tets_of,
     [](Stage& s, const Item& t) {
       return s.mesh.tet_alive(t[0]) && commit_if(s, reconnect(s.context, t[0], true, s.cavity));
     }},
    {Operator::kVertexInsert, tets_of, insert_in_the_middle},
    {Operator::kSurfaceInsert, edges_of,
     [](Stage& s, const Item& e) {
       if (!s.find_edge(e[0], e[1])) return false;
       return commit_if(s, SurfaceInsert(s.context)(s.editor.next_vertex(), s.cavity));
     }},
    {Operator::kSurfaceMerge, edges_of, merge_features},
};

const Action& action(Operator op) { return kActions[std::size_t(op)]; }

/// Attempts all items; `accepted` is called after each that was done.
std::int64_t sweep(Stage& stage, Operator op, std::uint64_t seed,
                   const std::function<void()>& accepted) {
  std::vector<Item> items = action(op).items(stage.mesh);
  shuffle(items, seed);
  std::int64_t done = 0;
  for (const Item& item : items)
    if (action(op).attempt(stage, item)) {
      ++done;
      accepted();
      if (testing::Test::HasFailure()) break;
    }
  return done;
}

/// Makes a mesh worse, so that there is something to improve.
void spoil(Stage& stage, std::uint64_t seed) {
  std::vector<Item> edges = edges_of(stage.mesh);
  shuffle(edges, seed);
  edges.resize(edges.size() / 3);
  for (const Item& e : edges) action(Operator::kEdgeSplit).attempt(stage, e);
  stage.context.limits.quality_ratio = 0.1;
  sweep(stage, Operator::kEdgeCollapse, seed + 1, [] {});
}

class Operators : public testing::TestWithParam<std::tuple<std::size_t, int>> {};

TEST_P(Operators, KeepTheMeshSoundAndTheDomainAsItIs) {
  constexpr std::uint64_t kSeed = 17;
  const Subject subject = subjects()[std::get<0>(GetParam())];
  const auto op = Operator(std::get<1>(GetParam()));
  SCOPED_TRACE(testing::Message() << name(op) << " on " << subject.name << ", seed " << kSeed);
  Stage stage(subject.data);
  const Shape shape(stage.mesh);
  const Euler before = euler(stage.mesh);
  if (op != Operator::kEdgeSplit && op != Operator::kEdgeCollapse) spoil(stage, kSeed);
  const std::int64_t stride = kSanitized ? 50 : 5;
  std::int64_t commits = 0;
  const std::int64_t done = sweep(stage, op, kSeed, [&] {
    if (commits++ % stride == 0) expect_sound(stage.mesh);
  });
  EXPECT_GT(done, 0);
  expect_sound(stage.mesh);
  EXPECT_EQ(count(stage.mesh).tets, stage.editor.living_tets());
  if (op == Operator::kSurfaceMerge)  // makes corners, and moves the surface within its tolerance
    EXPECT_EQ(euler(stage.mesh), before);
  else if (subject.polyhedral)
    shape.expect_polyhedron(stage.mesh);
  else
    shape.expect_topology_of(stage.mesh);
}

INSTANTIATE_TEST_SUITE_P(All, Operators,
                         testing::Combine(testing::Range<std::size_t>(0, subjects().size()),
                                          testing::Range(0, kOperators)),
                         [](const auto& pair) {
                           return subjects()[std::get<0>(pair.param)].name + "_" +
                                  name(Operator(std::get<1>(pair.param)));
                         });

/// All edges of the surface longer than a length, longest first, until there are none.
void refine_surface(Stage& stage, double length, Operator op) {
  for (bool again = true; again;) {
    again = false;
    std::vector<Item> edges = edges_of(stage.mesh);
    std::ranges::stable_sort(edges, std::greater{}, [&](const Item& e) {
      return distance(stage.mesh.points[e[0]], stage.mesh.points[e[1]]);
    });
    for (const Item& e : edges) {
      if (distance(stage.mesh.points[e[0]], stage.mesh.points[e[1]]) <= length) break;
      if (!stage.find_edge(e[0], e[1]) || !stage.context.shell.on_surface()) continue;
      again |= action(op).attempt(stage, e);
    }
  }
}

TEST(SurfaceInsert, MakesBetterTetsOfNeedlesThanSplits) {
  MeshData rod = kuhn_cube(2);
  for (Vec3& p : rod.vertices) p.z *= 20;
  Stage split(rod), insert(rod);
  refine_surface(split, 0.4, Operator::kEdgeSplit);
  refine_surface(insert, 0.4, Operator::kSurfaceInsert);
  expect_sound(insert.mesh);
  EXPECT_NEAR(volume(insert.mesh), 20, 1e-9);
  EXPECT_GT(quality_statistics(insert.mesh).mean, 1.1 * quality_statistics(split.mesh).mean);
}

TEST(Operators, OfQualityRaiseTheWorstOfTheirCavity) {
  constexpr std::uint64_t kSeed = 23;
  Stage stage(kuhn_cube(4));
  spoil(stage, kSeed);
  std::vector<Item> edges = edges_of(stage.mesh);
  shuffle(edges, kSeed);
  int accepted = 0;
  for (const Item& e : edges) {
    if (!stage.find_edge(e[0], e[1]) || stage.swap_edge() != Verdict::kAccept) continue;
    double before = 1, after = 1;
    for (const TetId t : stage.cavity.removed_tets)
      before = std::min(before, double(stage.mesh.qualities[t]));
    for (const NewTet& t : stage.cavity.tets) after = std::min(after, double(t.quality));
    EXPECT_GT(after, 1.01 * before) << "seed " << kSeed;
    ++accepted;
    stage.editor.commit(stage.cavity);
  }
  EXPECT_GT(accepted, 10);
}

}  // namespace
}  // namespace cavea::test
