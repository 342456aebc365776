#pragma once
#include <cstdint>
#include <vector>

#include "cavea/cavity/cavity.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// The only writer of topology in place: keeps the holes of one mesh and applies cavities to it.
/// One editor a mesh; not shared between threads.
class MeshEditor {
 public:
  explicit MeshEditor(TetMesh& mesh);

  /// Ids of holes that an editor is to use.
  struct Holes {
    TetId first_tet = 0;
    std::int32_t tets = 0;
    VertexId first_vertex = 0;
    std::int32_t vertices = 0;
  };
  /// An editor of those holes only, for cavities inside the volume. Several may work on one mesh at
  /// the same time, if the vertices of their cavities are apart, and as long as they fit().
  MeshEditor(TetMesh& mesh, const Holes& holes);

  /// Whether the holes suffice for a cavity.
  bool fits(const Cavity& cavity) const {
    return cavity.tets.size() <= cavity.removed_tets.size() + free_tets_.size() &&
           (!cavity.inserts_vertex || !free_vertices_.empty());
  }

  TetMesh& mesh() { return mesh_; }
  const TetMesh& mesh() const { return mesh_; }

  /// Id that the next inserted vertex will get.
  VertexId next_vertex() const;

  /// Whether each face of the new tets is one of exactly two, or a new triangle: a surface that
  /// passes through itself may have a triangle and a face inside with the same vertices, which
  /// positive volumes do not see.
  bool closes(const Cavity& cavity);

  /// Replaces the removed entities of the cavity by the new ones. New tets are flagged kAskAll.
  /// \throw InternalError when the cavity does not close: the mesh is then broken.
  void commit(const Cavity& cavity);

  /// Moves a vertex; `tets` is its ball, `qualities` their new qualities.
  void move(VertexId v, const NewVertex& to, const std::vector<TetId>& tets,
            const std::vector<float>& qualities);

  std::int64_t living_tets() const { return living_tets_; }

  /// Ids given to the new tets of the last commit.
  const std::vector<TetId>& created() const { return created_; }

 private:
  /// A face of the hole or of a new tet, waiting for its other side.
  struct Face {
    std::array<VertexId, 3> key;
    std::uint32_t epoch = 0;
    FaceLink link;         ///< a tet face to connect, a triangle to attach, or a cut
    std::int8_t side = 0;  ///< of the triangle, where the link is one; -1: a new triangle
    bool open = false;
    std::int8_t uses = 0;  ///< counted by closes()
  };

  bool is_at_surface(const Cavity& cavity) const;
  bool has_closed_faces(const Cavity& cavity);
  void clear_table(const Cavity& cavity);
  Face& slot(VertexId a, VertexId b, VertexId c);
  void mark_leaving(const Cavity& cavity);
  void unmark_leaving(const Cavity& cavity);
  bool stays(FaceLink link) const;
  void open_face(TetId t, int f, Face& face);
  void open_hole(const Cavity& cavity);
  void place_vertex(const Cavity& cavity);
  void add_triangles(const Cavity& cavity);
  void add_tets(const Cavity& cavity);
  void link_by_table(const Cavity& cavity);
  void open_bases(const Cavity& cavity);
  void link_as_told(const Cavity& cavity);
  void attach(TetId t, int f, Face& face);
  void release(const Cavity& cavity);
  TetId new_tet();

  TetMesh& mesh_;
  /// Not where others may look up the places of vertices at the same time.
  bool reuses_vertices_ = true;
  std::vector<TetId> free_tets_;
  std::vector<TriangleId> free_triangles_;
  std::vector<VertexId> free_vertices_;
  std::vector<Face> table_;  ///< open addressing; size a power of two
  std::size_t mask_ = 0;     ///< of the part of it that a cavity uses: a small one a small part
  std::uint32_t epoch_ = 0;
  std::vector<Face> bases_;  ///< of the new tets, where the cavity tells them
  std::int64_t open_faces_ = 0, living_tets_ = 0;
  std::vector<TetId> created_;
};

}  // namespace cavea
