#include "interrupt.h"

#include <pthread.h>
#include <signal.h>

namespace cavea::program {
namespace {

/// Wakes the watcher when the run is over; one that nobody else sends.
int wake_signal() { return SIGRTMIN; }

sigset_t stop_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

sigset_t with_wake(sigset_t set) {
  sigaddset(&set, wake_signal());
  return set;
}

}  // namespace

Interrupt::Interrupt() {
  const sigset_t set = with_wake(stop_signals());
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  watcher_ = std::thread([this] { watch(); });
}

Interrupt::~Interrupt() {
  finished_ = true;
  pthread_kill(watcher_.native_handle(), wake_signal());
  watcher_.join();
  const sigset_t set = with_wake(stop_signals());
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

int Interrupt::wait_for(const sigset_t& set) const {
  for (int received = 0;;)
    if (sigwait(&set, &received) == 0 && (received != wake_signal() || finished_)) return received;
}

void Interrupt::watch() {
  const sigset_t stop = stop_signals();
  const int received = wait_for(with_wake(stop));
  if (received == wake_signal()) return;
  signal_ = received;
  raised_ = true;
  // From here on this thread takes the next signal with its default action: the end.
  pthread_sigmask(SIG_UNBLOCK, &stop, nullptr);
  sigset_t none;
  sigemptyset(&none);
  wait_for(with_wake(none));
}

}  // namespace cavea::program
