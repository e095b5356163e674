// SPDX-License-Identifier: MIT
#include "verify/picture/judge.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fast/window/tessellator.h"
#include "verify/picture/canvas.h"

namespace limitcheck::verify {

namespace {

constexpr double kViews[] = {0, .5};  // of a turn

}  // namespace

fast::Camera viewer(double turn) {
  fast::Camera camera;
  const double angle = 2 * std::numbers::pi * turn;
  camera.eye = {4 * std::sin(angle), 1, 4 * std::cos(angle)};
  return camera;
}

fast::DepthOptions adaptive(fast::Strategy strategy, double pixels) {
  fast::DepthOptions options;
  options.strategy = strategy;
  options.target_pixels = pixels;
  options.angle_front = options.angle_silhouette = std::min(180., pixels / 2);
  return options;
}

fast::DepthOptions uniform(int depth) {
  fast::DepthOptions options;
  options.strategy = fast::Strategy::kUniform;
  options.depth = depth;
  return options;
}

Judge::Judge(data::ControlMesh mesh, int truth_depth) : mesh_(std::move(mesh)) {
  fast::TessellatorOptions options;
  options.max_depth = truth_depth;
  fast::Tessellator<float> engine(mesh_, options);
  for (const double turn : kViews) {
    Canvas canvas(viewer(turn));
    engine.frame(uniform(truth_depth), viewer(turn), canvas);
    truth_.push_back(canvas.picture());
  }
}

Seen Judge::see(const fast::DepthOptions& strategy, const fast::CrackOptions& cracks) const {
  fast::TessellatorOptions options;
  options.cracks = cracks;
  fast::Tessellator<float> engine(mesh_, options);
  Seen seen;
  DifferenceMeter meter;
  for (std::size_t k = 0; k < std::size(kViews); ++k) {
    Canvas canvas(viewer(kViews[k]));
    const fast::FrameStats stats = engine.frame(strategy, viewer(kViews[k]), canvas);
    seen.triangles += static_cast<double>(stats.triangles) / std::size(kViews);
    seen.limit_points += static_cast<double>(stats.limit_points) / std::size(kViews);
    meter.add(truth_[k], canvas.picture());
  }
  seen.difference = meter.result();
  return seen;
}

std::optional<double> on_curve(std::vector<std::pair<double, double>> points, double x) {
  std::sort(points.begin(), points.end());
  for (std::size_t k = 1; k < points.size(); ++k) {
    const auto [x0, y0] = points[k - 1];
    const auto [x1, y1] = points[k];
    if (x < x0 || x > x1) continue;
    const double t = x1 > x0 ? std::log(x / x0) / std::log(x1 / x0) : 0;
    return y0 * std::pow(y1 / y0, t);
  }
  return {};
}

}  // namespace limitcheck::verify
