// SPDX-License-Identifier: MIT
// Processor time of the calling thread: what a proof costs, however many share the machine.
#pragma once

#include <ctime>

namespace limitcheck::verify {

class ThreadClock {
 public:
  double seconds() const { return now() - start_; }

 private:
  static double now() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }
  double start_ = now();
};

}  // namespace limitcheck::verify
