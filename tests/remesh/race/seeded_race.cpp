// A data race on purpose: the thread sanitizer must report it in spite of what base/parallel.h
// tells it and of tests/tsan.supp, or a clean run of the other tests would mean nothing.
#include <atomic>
#include <chrono>
#include <cstdio>
#include <thread>

#include "cavea/base/parallel.h"

namespace {

/// Returns once two tasks are here, which orders nothing between them (relaxed), or after a while.
void meet(std::atomic<int>& arrived) {
  arrived.fetch_add(1, std::memory_order_relaxed);
  const auto start = std::chrono::steady_clock::now();
  while (arrived.load(std::memory_order_relaxed) < 2 &&
         std::chrono::steady_clock::now() - start < std::chrono::seconds(20))
    std::this_thread::yield();
}

}  // namespace

int main() {
  std::atomic<int> arrived = 0;
  int counter = 0;
  cavea::run_in_arena(2, [&] {
    cavea::parallel_for(
        2,
        [&](std::size_t) {
          meet(arrived);
          ++counter;
        },
        1);
  });
  std::printf("counted to %d\n", counter);
}
