// SPDX-License-Identifier: MIT
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
#include "verify/picture/difference.h"

namespace limitcheck::verify {

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
