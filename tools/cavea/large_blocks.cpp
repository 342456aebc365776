// Replaces the operators new and delete of the program, whose arrays of large meshes are so many
// pages that touching them for the first time is a tenth of a run: they are put on huge pages,
// where the system has these for those who ask. What a library may not decide, a program may.
// Sanitizers have their own, of which all must be of one kind.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

constexpr std::size_t kHugePage = std::size_t{1} << 21;
/// Smaller blocks would be mostly beginning and end, which stay on small pages.
constexpr std::size_t kLarge = 2 * kHugePage;

void* allocate(std::size_t size) {
  if (size < kLarge) return std::malloc(size ? size : 1);
  void* block = nullptr;
  if (posix_memalign(&block, kHugePage, size) != 0) return nullptr;
  // The end of it is not rounded up: memory that is not asked for must not count. Where there are
  // no huge pages this fails, and nothing is lost.
  madvise(block, size / kHugePage * kHugePage, MADV_HUGEPAGE);
  return block;
}

}  // namespace

void* operator new(std::size_t size) {
  for (;;) {
    if (void* block = allocate(size)) return block;
    const std::new_handler handler = std::get_new_handler();
    if (!handler) throw std::bad_alloc();
    handler();
  }
}

void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }

#endif
