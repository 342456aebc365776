#include "cavea/remesh/input.h"

#include "cavea/base/error.h"
#include "cavea/mesh/compact.h"
#include "cavea/mesh/copy.h"

namespace cavea {

TetMesh Input::lend() {
  if (lent_) throw InternalError("the input is lent already");
  // A run would have to change the structure at once.
  if (!may_lend_ || has_holes(mesh_)) return copy_of(mesh_);
  TetMesh lent;
  copy_labels(mesh_, lent);
  move_structure(mesh_, lent);
  lent_ = true;
  return lent;
}

void Input::keep(const TetMesh& lent) {
  if (lent_) copy_structure(lent, mesh_);
  lent_ = false;
}

void Input::take_back(TetMesh& lent) {
  if (lent_) move_structure(lent, mesh_);
  lent_ = false;
}

}  // namespace cavea
