// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <csignal>
#include <semaphore>
#include <stdexcept>

#include "verify/interrupt/interrupt.h"

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

namespace {

TEST(RunOrAbandon, WaitsForWorkAndPassesItsExceptionsOn) {
  const InterruptGuard guard;
  int done = 0;
  EXPECT_TRUE(run_or_abandon([&] { done = 1; }));
  EXPECT_EQ(done, 1);
  EXPECT_THROW((void)run_or_abandon([] { throw std::runtime_error("no"); }), std::runtime_error);
  EXPECT_THROW((void)run_or_abandon([] { throw Interrupted(); }), Interrupted);
}

TEST(RunOrAbandon, LetsInterruptedWorkEndInGoodOrder) {
  const InterruptGuard guard;
  int done = 0;
  EXPECT_TRUE(run_or_abandon([&] {
    raise(SIGTERM);
    done = 1;
  }));
  EXPECT_EQ(done, 1);
}

// The work can end only after it was left.
TEST(RunOrAbandon, LeavesWorkThatGoesOn) {
  const InterruptGuard guard;
  std::binary_semaphore left(0), ended(0);
  EXPECT_FALSE(run_or_abandon(
      [&] {
        raise(SIGTERM);
        left.acquire();
        ended.release();
      },
      std::chrono::milliseconds(1)));
  left.release();
  ended.acquire();
}

TEST(Leave, EndsTheProcessWithItsCode) {
  EXPECT_EXIT(leave(143, 2), testing::ExitedWithCode(143), "");
}

}  // namespace

}  // namespace limitcheck::verify
