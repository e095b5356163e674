// SPDX-License-Identifier: MIT
// The viewer: a pinhole camera with square pixels. Everything is explicit, nothing is read from a graphics
// library.
#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "data/error.h"
#include "fast/mesh/point3.h"

namespace limitcheck::fast {

/// A perspective view.
struct Camera {
  Point3 eye{0, 0, 4};
  Point3 target{0, 0, 0};
  Point3 up{0, 1, 0};
  double field_of_view = 45;  // vertical, degrees, in (0, 180)
  int width = 1024;           // viewport, pixels
  int height = 768;
  double near = 0.01;  // nothing is taken to be nearer to the eye than this

  /// Pixels that a length of 1 at distance 1 covers: height / (2 tan(field_of_view / 2)).
  double focal_pixels() const { return height / (2 * std::tan(field_of_view * std::numbers::pi / 360)); }

  /// Throws data::ArgumentError and says which value makes no view: eye equal to target, up along the view,
  /// field of view outside (0, 180), a viewport without pixels, near not positive, anything not finite.
  void validate() const {
    const auto refuse = [](const char* what) { throw data::ArgumentError(std::string("camera: ") + what); };
    if (!is_finite(eye) || !is_finite(target) || !is_finite(up)) refuse("eye, target and up must be finite");
    if (eye == target) refuse("eye and target are the same point");
    if (length(cross(target - eye, up)) == 0) refuse("up points along the view");
    if (!(field_of_view > 0 && field_of_view < 180))
      refuse("the field of view must lie between 0 and 180 degrees");
    if (width <= 0 || height <= 0) refuse("the viewport has no pixels");
    if (!(near > 0) || !std::isfinite(near)) refuse("near must be positive");
  }
};

}  // namespace limitcheck::fast
