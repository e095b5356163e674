// SPDX-License-Identifier: MIT
// Ending early on a signal, with the results so far.
#pragma once

#include <array>
#include <csignal>
#include <string>

namespace limitcheck::verify {

/// While it lives, the first SIGINT, SIGTERM or SIGHUP is noted and nothing more; a second one of the same
/// kind takes its usual course and ends the process. Signals that were ignored stay ignored. One at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  std::array<struct sigaction, 3> before_{};
};

/// The number of the signal noted, or 0. Safe, and cheap, in any thread and inner loop.
int interrupted() noexcept;

/// "SIGINT", "SIGTERM", "SIGHUP".
std::string signal_name(int signal);

/// Thrown where long work cannot end in another way. It is not a std::exception, because code that turns
/// those into faults of the subject must not catch it.
struct Interrupted {};

inline void end_if_interrupted() {
  if (interrupted() != 0) throw Interrupted();
}

}  // namespace limitcheck::verify
