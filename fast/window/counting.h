// SPDX-License-Identifier: MIT
// What the tests of claims may hang into a sliding window: counters, or another order of arguments.
// [mueller2000, 4.3.1; C43, C48-C55]
#pragma once

#include <cstdint>

namespace limitcheck::fast {

/// Vectors stored by one or more runs, by the array they go to.
struct WindowCounts {
  std::int64_t rows = 0;            // outtop, top, middle, bottom, outbottom, by subdivision
  std::int64_t corners = 0;         // corner0 .. corner3, by subdivision
  std::int64_t middle_corners = 0;  // mcorner0, mcorner1: copies of points of the others
  std::int64_t filled = 0;          // level 0, from the mesh
  std::int64_t limit_points = 0;    // evaluated: a position and a normal each
  std::int64_t carried = 0;         // strip points taken over from the strip before
  std::int64_t strips = 0;

  std::int64_t stored() const { return rows + corners + middle_corners; }
  friend bool operator==(const WindowCounts&, const WindowCounts&) = default;
};

/// Changes nothing, counts nothing and costs nothing.
struct NoProbe {
  static constexpr void add(std::int64_t WindowCounts::*, std::int64_t) {}
  /// The two recursive calls, with their arguments in the order in which they are printed. A test may exchange
  /// some, to show that no other order works. [C43]
  static void upper(auto&& call, auto*... arguments) { call(arguments...); }
  static void lower(auto&& call, auto*... arguments) { call(arguments...); }
};

/// Counts into `counts`.
struct Counting : NoProbe {
  WindowCounts counts;
  void add(std::int64_t WindowCounts::*what, std::int64_t n) { counts.*what += n; }
};

}  // namespace limitcheck::fast
