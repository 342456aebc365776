#include "interrupt.h"

#include <pthread.h>
#include <signal.h>
#include <time.h>

#include <chrono>

namespace cavea::program {
namespace {

// How long the watcher sleeps before it looks whether the run is over: delays the end of the
// program by at most this.
constexpr std::chrono::milliseconds kNap{20};

sigset_t stop_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

}  // namespace

Interrupt::Interrupt() {
  const sigset_t set = stop_signals();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  watcher_ = std::thread([this] { watch(); });
}

Interrupt::~Interrupt() {
  finished_ = true;
  watcher_.join();
  const sigset_t set = stop_signals();
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

void Interrupt::watch() {
  const sigset_t set = stop_signals();
  const timespec nap{0, std::chrono::nanoseconds(kNap).count()};
  while (!finished_ && !raised_) {
    const int received = sigtimedwait(&set, nullptr, &nap);
    if (received <= 0) continue;
    signal_ = received;
    raised_ = true;
  }
  if (!raised_) return;
  // From here on this thread takes the next signal with its default action: the end.
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
  while (!finished_) std::this_thread::sleep_for(kNap);
}

}  // namespace cavea::program
