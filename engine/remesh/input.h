#pragma once
#include <utility>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// The mesh of the caller, from which runs start. It is needed again where another run is tried,
/// and must be whole if one fails; but as long as a run has only labelled its tets and vertices, it
/// works on the structure of that mesh itself: to copy a large one is a tenth of a run that finds
/// nothing to do.
class Input {
 public:
  /// \param may_lend nothing looks at `mesh` while a run works on it
  Input(TetMesh& mesh, bool may_lend) : mesh_(mesh), may_lend_(may_lend) {}

  /// The mesh for a run to work on. \throw InternalError while the structure is lent
  TetMesh lend();
  bool is_lent() const { return lent_; }
  /// Makes the input whole before the run changes the structure of the mesh that was lent to it.
  void keep(const TetMesh& lent);
  /// The same where the run needs its mesh no more.
  void take_back(TetMesh& lent);

  /// \pre the structure is not lent
  const TetMesh& mesh() const { return mesh_; }

 private:
  TetMesh& mesh_;  ///< its structure is elsewhere while it is lent
  bool may_lend_, lent_ = false;
};

/// The mesh of a run: what was lent to it and is no result goes back, whatever ends the run.
class Loan {
 public:
  explicit Loan(Input& input) : input_(input), mesh_(input.lend()) {}
  ~Loan() {
    if (!is_taken_) input_.take_back(mesh_);
  }
  Loan(const Loan&) = delete;
  Loan& operator=(const Loan&) = delete;

  TetMesh& mesh() { return mesh_; }
  /// For good: if nothing was changed, with what was lent.
  TetMesh take() {
    is_taken_ = true;
    return std::move(mesh_);
  }

 private:
  Input& input_;
  TetMesh mesh_;
  bool is_taken_ = false;
};

}  // namespace cavea
