// SPDX-License-Identifier: MIT
// How much the picture of a tessellation differs from the picture of the surface.
// What sections 6 and 7 say of strategies, measured on pictures.
// [mueller2000, 6, 7; C31, C74, C76, C79]
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "data/control_mesh.h"
#include "fast/plan/crack.h"
#include "fast/plan/depth.h"
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

/// The viewer of all pictures and timings: distance 4 for a bumpy sphere of radius 0.5 to 1.5, 1024 x 768
/// pixels. (The paper does not say.) Turning the object by `turn` of a full turn is moving the viewer round
/// it.
fast::Camera viewer(double turn);

/// project-sphere or combined from coarse to fine: a sphere of so many pixels, and half the number of
/// degrees. The paper states neither; 60 pixels and 30 degrees are what the tables and timings use.
fast::DepthOptions adaptive(fast::Strategy strategy, double pixels);
fast::DepthOptions uniform(int depth);

/// What a strategy draws, and how it looks.
struct Seen {
  double triangles = 0;     // mean of the views
  double limit_points = 0;  // evaluated; mean of the views
  Difference difference;    // from deep uniform depth, all views together
};

/// One mesh seen from two opposite sides.
class Judge {
 public:
  /// truth_depth: the uniform depth, 0 .. 10, whose pictures count as the surface. Each level quarters its
  /// own error. Throws data::ArgumentError as the engine does for the mesh.
  Judge(data::ControlMesh mesh, int truth_depth);

  Seen see(const fast::DepthOptions& strategy, const fast::CrackOptions& cracks = {}) const;

 private:
  data::ControlMesh mesh_;
  std::vector<Picture> truth_;
};

/// y at x on the curve through points (x, y), both positive: straight lines between neighbours, in
/// logarithms. Nothing where x lies outside the points. Errors against triangles and triangles against errors
/// are read off so: what a strategy needs lies between two of its settings.
std::optional<double> on_curve(std::vector<std::pair<double, double>> points, double x);

}  // namespace limitcheck::verify
