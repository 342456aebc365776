#pragma once
#include "cavea/operator/context.h"
#include "cavea/operator/delaunay_cavity.h"
#include "cavea/operator/edge_split.h"

namespace cavea {

/// Splits edges of the surface by the Delaunay kernel: the vertex comes to the middle of the edge,
/// on the ideal surface, and the cavity grows from the edge's shell through the volume on all sides
/// of the surface, and over smooth surface triangles whose circumcircle contains the vertex. A
/// split divides all tets of the shell, so that needles across a thin body become ever more; here
/// they vanish as vertices come.
class SurfaceInsert {
 public:
  explicit SurfaceInsert(OperatorContext& context) : c_(context), hole_(context.mesh) {}

  /// \pre context.shell is the shell of the edge
  Verdict operator()(VertexId id, Cavity& cavity);

 private:
  /// A side of a triangle that may vanish.
  struct Side {
    VertexId a, b;  ///< a < b
    TriangleId triangle;
    int k;  ///< opposite this corner
  };
  /// A triangle that vanishes, and the triangle at the edge from which it is reached.
  struct Opened {
    TriangleId triangle;
    int sheet;
  };

  Verdict grow();
  double least_quality() const;
  Verdict try_cavity(const EdgeOnSurface& edge, VertexId id, bool wide, Cavity& cavity);
  Verdict admit(TetId t) const;
  bool is_on_hole(const Triangle& t) const;
  bool is_candidate(TriangleId id);
  void collect_sides();
  void open_edge();
  void open_sheet(int sheet, TriangleId first);
  bool may_open(TriangleId id, const Triangle& from, const Vec3& normal) const;
  bool is_inner(const Triangle& t, int k, int sheet) const;
  bool are_discs();
  bool drop_lost_sides();
  void open_sheets();
  void add_triangles(const EdgeOnSurface& edge, VertexId id, Cavity& cavity) const;
  bool is_flat() const;
  Verdict judge(VertexId id, const Cavity& cavity) const;
  bool is_open(TriangleId t) const;
  int sheet_of(TriangleId t) const;

  OperatorContext& c_;
  DelaunayCavity hole_;
  NewVertex vertex_;
  std::vector<TriangleId> on_hole_;  ///< that may vanish beside those at the edge
  std::vector<Side> sides_;          ///< of these, by rising (a, b, triangle)
  std::vector<Opened> opened_;
  std::vector<VertexId> rim_;
};

}  // namespace cavea
