// SPDX-License-Identifier: MIT
// Ctrl-C as a question that long work asks, so that what is done is not lost.
#pragma once

#include <csignal>

namespace limitcheck::cli {

inline constexpr int kInterrupted = 130;  ///< exit code: stopped by the user; 128 + SIGINT, as shells have it

/// While it lives, the first SIGINT or SIGTERM is kept for came(); the second ends the process as ever. One
/// at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  bool came() const;

 private:
  struct sigaction before_[2];
};

}  // namespace limitcheck::cli
