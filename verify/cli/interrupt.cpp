// SPDX-License-Identifier: MIT
#include "verify/cli/interrupt.h"

#include <atomic>

namespace limitcheck::cli {
namespace {

constexpr int kSignals[2] = {SIGINT, SIGTERM};
std::atomic<bool> signalled = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch it");

void keep(int) {
  signalled = true;
}

}  // namespace

Interrupt::Interrupt() {
  signalled = false;
  struct sigaction action {};
  action.sa_handler = keep;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (int k = 0; k < 2; ++k) {
    sigaction(kSignals[k], nullptr, &before_[k]);
    if (before_[k].sa_handler != SIG_IGN) sigaction(kSignals[k], &action, nullptr);
  }
}

Interrupt::~Interrupt() {
  for (int k = 0; k < 2; ++k) sigaction(kSignals[k], &before_[k], nullptr);
}

bool Interrupt::came() const {
  return signalled;
}

}  // namespace limitcheck::cli
