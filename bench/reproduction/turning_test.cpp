// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

#include "bench/reproduction/reproduction.h"
#include "bench/reproduction/scene.h"
#include "data/generators/bumpy_sphere.h"

namespace limitcheck::bench {
namespace {

using namespace std::chrono_literals;

// Another program that has the processor for 20 ms of each frame.
Frame disturbed() {
  return [](const fast::DepthOptions&, const fast::Camera&, fast::DrawList<float>&) {
    std::this_thread::sleep_for(20ms);
    return fast::FrameStats{};
  };
}

TEST(Turn, ProcessorTimeDoesNotCountWhatOthersTake) {
  EXPECT_LT(turn(disturbed(), {}, 2, 1, Clock::kProcessor).seconds, .02);
  EXPECT_GE(turn(disturbed(), {}, 2, 1, Clock::kWall).seconds, .04);
}

TEST(Turn, TakesOfEachFrameTheLeastTimeAndSaysHowFarRepetitionsDiffer) {
  int calls = 0;
  const Frame once_slow = [&](const fast::DepthOptions&, const fast::Camera&, fast::DrawList<float>&) {
    std::this_thread::sleep_for(++calls == 2 ? 60ms : 2ms);  // the first call is not part of the turn
    return fast::FrameStats{};
  };
  const Turn t = turn(once_slow, {}, 2, 1, Clock::kWall);
  EXPECT_EQ(t.frames, 2);
  EXPECT_GE(t.spread, 2) << "60 + 2 against 2 + 2, with room for a busy machine";
  EXPECT_LT(t.seconds, .06);
}

TEST(Turn, CountsTheFramesOfOneRepetition) {
  const auto mesh = data::bumpy_sphere(60, kSphereSeed);
  const auto c = counts(turn(sliding_window(mesh, 1), verify::uniform(2), 3, 10, Clock::kProcessor));
  EXPECT_EQ(c["triangles"], 60 * 16);
}

TEST(Outcome, IsOnlySaidWhereTheRepetitionsAgree) {
  EXPECT_EQ(std::string(outcome(1.5, 1, 1.2)), "as the text says");
  EXPECT_EQ(std::string(outcome(.5, 1, 1.2)), "not as the text says");
  EXPECT_EQ(std::string(outcome(1.1, 1, 1.2)), "could not be measured");
  EXPECT_EQ(std::string(outcome(.9, 1, 1.2)), "could not be measured");
}

}  // namespace
}  // namespace limitcheck::bench
