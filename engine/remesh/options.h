#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "cavea/field/local_parameters.h"
#include "cavea/field/size_regions.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// What progress() is told.
struct Progress {
  const char* phase = "";
  int round = 0;
  std::int64_t tets = 0;
  std::int64_t wanted = 0;  ///< about how many tets there will be, once that is known
  double seconds = 0;       ///< since the start of remesh()
};

/// What a run may not do.
struct Freezes {
  bool insert = false;    ///< no vertex comes
  bool collapse = false;  ///< no vertex goes
  bool swap = false;      ///< no edge or face is exchanged for others
  bool move = false;      ///< no vertex moves
  /// The surface, exterior and interfaces, stays to the bit: it is then the truth, and the lengths
  /// of its edges are the sizes wanted there.
  bool surface = false;
  /// What of the surface is nearer to each other than the tolerance is not joined, whatever tets
  /// that leaves.
  bool join = false;

  bool any_operator() const { return insert || collapse || swap || move; }
};

/// What the caller asks for. Lengths are in the mesh's own unit; what is not set follows from the
/// extent of the mesh (see resolve()).
struct Options {
  /// Distance to the ideal surface; default 0.001 box diagonals, or 0.08 of the thickness() if that
  /// is less.
  std::optional<double> hausd;
  /// Largest distance of the ideal surface from the input's triangles; default 3 hausd.
  std::optional<double> max_bulge;
  bool faceted = false;  ///< the input's triangles are the ideal surface: no bulge at all
  /// Shortest and longest wanted edge; by default hausd's default and 0.1 box diagonals, or the
  /// smallest and largest size that the user's field asks for at the vertices, if that is beyond.
  std::optional<double> hmin, hmax;
  std::optional<double> hsiz;  ///< one size everywhere; excludes hmin and hmax
  /// The mesh's own sizes in place of a field: at each vertex the mean length of its edges;
  /// excludes a field and hsiz.
  bool optim = false;
  /// Largest ratio of adjacent edges (paper, equation (1)); >= 1, none for no bound.
  std::optional<double> hgrad = 1.3;
  /// The same from required entities outwards, whose own edges' lengths are imposed as sizes; >= 1.
  /// None: they impose nothing. The default is mmg3d's.
  std::optional<double> hgradreq = 2.3;
  /// The mesh whose surface is the input's truth in place of its own: an earlier one, so that a
  /// loop does not drift. Read during remesh() only; may be the mesh that is remeshed.
  const TetMesh* surface = nullptr;
  /// Other bounds and tolerances by reference, and places with sizes of their own; both exclude
  /// hsiz.
  std::vector<LocalParameters> local;
  std::vector<SizeRegion> size_regions;
  /// A budget: where more tets than this are predicted, sizes (but those of required entities) and
  /// the operators' tolerance are made coarser until the result has about as many.
  std::optional<std::int64_t> max_tets;
  /// Bytes that the run may use: what is foreseen to need more is refused with MemoryError. Not
  /// given: what the machine has.
  std::optional<std::int64_t> max_memory;
  double angle = 45;  ///< degrees between normals above which an edge is a ridge
  bool detect_ridges = true;

  Freezes freeze;
  bool directions = false;  ///< the report is to have the surface's normals and tangents

  double min_quality = 0.1;  ///< target: worst quality
  double min_conform = 90;   ///< target: percent of lengths within [1/sqrt2, sqrt2]

  /// Moves vertices of a result before it is measured: onto a function that the surface stands for,
  /// say. No tet may become flat, no vertex of the exterior boundary leave it by more than hausd.
  std::function<void(TetMesh&)> finish;

  /// Size of the parts that rounds cut the mesh into; 0: what fits caches. The result depends on
  /// it.
  std::int64_t tets_per_part = 0;
  int threads = 0;                                ///< 0: all cores
  std::function<void(const Progress&)> progress;  ///< called from the calling thread only
  const std::atomic<bool>* cancel = nullptr;      ///< when true, remesh() throws Cancelled
};

/// \throw OptionError saying why: not finite, not positive, contradictory.
void validate_entry(const LocalParameters& local);
void validate_entry(const SizeRegion& region);

/// \throw OptionError naming the option and why: not finite, not positive, contradictory.
void validate(const Options& options);

}  // namespace cavea
