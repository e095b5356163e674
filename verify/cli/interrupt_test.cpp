// SPDX-License-Identifier: MIT
#include "verify/cli/interrupt.h"

#include <gtest/gtest.h>

#include <csignal>

namespace limitcheck::cli {
namespace {

TEST(Interrupt, KeepsTheFirstSignalAndLetsTheSecondEndTheProcess) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const Interrupt interrupt;
    EXPECT_FALSE(interrupt.came());
    raise(signal);
    EXPECT_TRUE(interrupt.came());
    EXPECT_EXIT(raise(signal), testing::KilledBySignal(signal), "");
  }
}

TEST(Interrupt, LeavesTheProcessAsItWas) {
  { const Interrupt interrupt; }
  EXPECT_EXIT(raise(SIGINT), testing::KilledBySignal(SIGINT), "");
}

}  // namespace
}  // namespace limitcheck::cli
