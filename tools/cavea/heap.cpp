#include "heap.h"

#include <malloc.h>

namespace cavea::program {
namespace {

/// From here on memory counts: about 0.1 GB.
constexpr std::int64_t kLargeMesh = 800'000;

/// Blocks of this size and more are mapped one by one, and unmapped when they are freed. A part of
/// a round has arrays of 1 MiB and less; of these, those for vertices stay.
constexpr int kMapped = 384 << 10;
/// The most that glibc allows.
constexpr int kMappedOfSmall = 32 << 20;

/// The ends of heaps are kept: by default each smaller array that is freed there goes back, too.
constexpr int kKept = 64 << 20;

}  // namespace

Heap::Heap() {
  // By default the allocator learns from the first arrays to keep what is as large.
  mallopt(M_TRIM_THRESHOLD, kKept);
  // A mesh that is read needs many arrays in turn, and less memory than when it is remeshed.
  keep_arrays(true);
}

void Heap::expect(std::int64_t tets) {
  const bool keep = tets < kLargeMesh;
  if (keep == keeps_) return;
  keep_arrays(keep);
  if (!keep) malloc_trim(0);
}

void Heap::keep_arrays(bool keep) {
  mallopt(M_MMAP_THRESHOLD, keep ? kMappedOfSmall : kMapped);
  keeps_ = keep;
}

}  // namespace cavea::program
