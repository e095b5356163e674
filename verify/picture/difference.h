// SPDX-License-Identifier: MIT
// How much the picture of a tessellation differs from the picture of the surface.
#pragma once

#include <cstdint>
#include <vector>

#include "verify/picture/canvas.h"

namespace limitcheck::verify {

/// Pixel by pixel, over those that show a surface in either picture. A pixel's error is the difference of the
/// shades, in 0 .. 255, and 255 where only one of the pictures shows a surface.
struct Difference {
  std::int64_t pixels = 0;
  double mean = 0, median = 0, percentile_99 = 0;
  double share = 0;              // of pixels whose error exceeds 4
  std::int64_t missing = 0;      // the true picture shows a surface, the other none
  std::int64_t extra = 0;        // the other way round
  std::int64_t largest_gap = 0;  // pixels of the largest connected area that is missing
  /// How far the farthest missing pixel lies from what is drawn, or the farthest extra one from the true
  /// surface; in pixels.
  double contour = 0;
};

/// Over any number of pairs of pictures.
class DifferenceMeter {
 public:
  /// Throws data::ArgumentError if the pictures are not of one size.
  void add(const Picture& truth, const Picture& seen);
  Difference result() const;

 private:
  std::vector<float> errors_;
  Difference sum_;
};

}  // namespace limitcheck::verify
