#pragma once
#include <cstdint>

namespace cavea::program {

/// What the allocator does with arrays that are freed. Of large meshes they go back to the system,
/// since what is kept has holes: a fifth of the memory of a million tets. Of smaller ones they are
/// kept for the next arrays, as pages that the system hands out have to be cleared first: 5% of a
/// run. So they are at first, until it is known how large the mesh is. Of no effect where the
/// allocator has no such choice.
class Heap {
 public:
  Heap();
  /// For a mesh of so many tets, which may be more or fewer than before. Not while other threads of
  /// the caller's run.
  void expect(std::int64_t tets);

 private:
  void keep_arrays(bool keep);
  bool keeps_ = false;
};

}  // namespace cavea::program
