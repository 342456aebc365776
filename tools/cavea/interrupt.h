#pragma once
#include <signal.h>

#include <atomic>
#include <thread>

namespace cavea::program {

/// While it lives, SIGINT and SIGTERM raise a flag instead of ending the program; a second one ends
/// it. Must be made before any other thread, which would not inherit the blocked signals. A thread
/// that waits for the signals needs no global variable, as a signal handler would.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  const std::atomic<bool>* flag() const { return &raised_; }
  bool raised() const { return raised_; }
  /// The signal that came, 0 if none did.
  int signal() const { return signal_; }

 private:
  void watch();
  /// One of `set`, in which the watcher is woken when the run is over.
  int wait_for(const sigset_t& set) const;

  std::atomic<bool> raised_{false}, finished_{false};
  std::atomic<int> signal_{0};
  std::thread watcher_;
};

}  // namespace cavea::program
