#pragma once
#include "cavea/pass/cycle.h"

namespace cavea {

/// What the passes over one part share.
struct PartState {
  PartState(TetMesh& mesh, const SurfaceModel& surface, const CycleSettings& s)
      : editor(mesh), context(mesh, surface), settings(s) {
    context.limits = s.limits;
  }
  TetMesh& mesh() { return editor.mesh(); }
  /// Counts a verdict; true if it is accept.
  bool count(Operator o, Verdict v) {
    result.verdicts.add(o, v);
    return v == Verdict::kAccept;
  }
  /// The same for one that has filled the cavity, which is refused if it does not close.
  bool takes(Operator o, Verdict v) {
    if (v == Verdict::kAccept && !editor.closes(cavity)) v = Verdict::kBreaksTopology;
    return count(o, v);
  }
  bool at_interface(VertexId v) const { return context.tags(v) & tag::kFrozen; }
  /// To be called when an operator has refused the tet because the interface is in the way, which
  /// will move. Required edges, which operators refuse alike, stay.
  void block(TetId t) { mesh().tet_flags[t] |= tet_flag::kAskLater | tet_flag::kBlocked; }
  void commit() {
    editor.commit(cavity);
    ++result.changes;
  }

  MeshEditor editor;
  OperatorContext context;
  CycleSettings settings;
  Cavity cavity;
  CycleResult result;
  /// Whether lengths may still be off by the first sweep's slack.
  bool slack = false;
  /// Whether bad tets are offered more than swaps: many are good again after the first sweep.
  bool last_resorts = false;
};

/// Each returns the number of accepted operations.
std::int64_t surface_pass(PartState& state);
std::int64_t split_pass(PartState& state);
std::int64_t collapse_pass(PartState& state);
std::int64_t quality_pass(PartState& state);
std::int64_t move_pass(PartState& state);
std::int64_t shake_pass(PartState& state);

}  // namespace cavea
