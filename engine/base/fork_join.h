#pragma once
#include <tbb/blocked_range.h>

#include <cstddef>

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#define CAVEA_UNWATCHED __attribute__((no_sanitize("thread")))
#else
#define CAVEA_UNWATCHED
#endif

namespace cavea {

/// One fork into tasks and their join, as the thread sanitizer is to see it: what came before the
/// fork happens before each task, and each task before what comes after the join; the tasks are not
/// ordered among themselves. oneTBB orders them so, but inside a library that is not built for the
/// sanitizer. Nothing at all in other builds.
class ForkJoin {
 public:
#ifdef __SANITIZE_THREAD__
  ForkJoin() { __tsan_release(&fork_); }
  ~ForkJoin() { __tsan_acquire(&join_); }
  class Task {
   public:
    explicit Task(ForkJoin& of) : of_(of) { __tsan_acquire(&of_.fork_); }
    ~Task() { __tsan_release(&of_.join_); }
    Task(const Task&) = delete;
    Task& operator=(const Task&) = delete;

   private:
    ForkJoin& of_;
  };

 private:
  char fork_ = 0, join_ = 0;
#else
  ForkJoin() {}
  struct Task {
    explicit Task(ForkJoin&) {}
  };
#endif
 public:
  ForkJoin(const ForkJoin&) = delete;
  ForkJoin& operator=(const ForkJoin&) = delete;

  /// f(begin, end) as the body of a loop. oneTBB copies it into its tasks: reading that copy goes
  /// unwatched, what f does does not.
  template <class F>
  struct Body {
    ForkJoin* fork;
    F* f;
    CAVEA_UNWATCHED void operator()(const tbb::blocked_range<std::size_t>& r) const {
      fork->run(*f, r.begin(), r.end());
    }
  };
  template <class F>
  Body<F> body(F& f) {
    return {this, &f};
  }
  template <class F>
  void run(F& f, std::size_t begin, std::size_t end) {
    const Task task(*this);
    f(begin, end);
  }
};

}  // namespace cavea

#undef CAVEA_UNWATCHED
