// SPDX-License-Identifier: MIT
#include "verify/interrupt/interrupt.h"

#include <gtest/gtest.h>

#include <csignal>

namespace limitcheck::verify {
namespace {

TEST(InterruptGuard, KeepsTheFirstSignalAndLetsTheSecondEndTheProcess) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const InterruptGuard guard;
    EXPECT_EQ(interrupted(), 0);
    raise(signal);
    EXPECT_EQ(interrupted(), signal);
    EXPECT_EXIT(raise(signal), testing::KilledBySignal(signal), "");
  }
}

TEST(InterruptGuard, LeavesTheProcessAsItWas) {
  { const InterruptGuard guard; }
  EXPECT_EXIT(raise(SIGINT), testing::KilledBySignal(SIGINT), "");
}

}  // namespace
}  // namespace limitcheck::verify
