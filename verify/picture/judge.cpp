// SPDX-License-Identifier: MIT
#include "verify/picture/judge.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "data/error.h"
#include "fast/window/tessellator.h"

namespace limitcheck::verify {
namespace {

bool shows(float shade) {
  return shade != Picture::kNothing;
}

/// Distance from a pixel to the nearest one that shows a surface: rings of growing size until no nearer one
/// can follow. The diagonal of the picture if there is none.
double distance_to_surface(const Picture& picture, int x, int y) {
  double nearest = std::hypot(picture.width, picture.height);
  bool found = false;
  const int largest = std::max(picture.width, picture.height);
  for (int r = 1; r <= largest && (!found || r < nearest); ++r) {
    for (int k = -r; k <= r; ++k) {
      for (const auto& [dx, dy] : {std::pair{k, -r}, {k, r}, {-r, k}, {r, k}}) {
        const int u = x + dx, v = y + dy;
        if (u < 0 || v < 0 || u >= picture.width || v >= picture.height) continue;
        if (!shows(picture.at(u, v))) continue;
        found = true;
        nearest = std::min(nearest, std::hypot(dx, dy));
      }
    }
  }
  return nearest;
}

/// Pixels of the largest area, connected along sides, of those that are set. Clears them.
std::int64_t largest_area(std::vector<bool>& set, int width) {
  std::int64_t largest = 0;
  std::vector<std::size_t> open;
  const auto w = static_cast<std::size_t>(width);
  const auto take = [&](std::size_t p) {
    if (set[p]) set[p] = false, open.push_back(p);
  };
  for (std::size_t start = 0; start < set.size(); ++start) {
    std::int64_t area = 0;
    for (take(start); !open.empty(); ++area) {
      const std::size_t p = open.back();
      open.pop_back();
      if (p % w > 0) take(p - 1);
      if (p % w + 1 < w) take(p + 1);
      if (p >= w) take(p - w);
      if (p + w < set.size()) take(p + w);
    }
    largest = std::max(largest, area);
  }
  return largest;
}

double quantile(std::vector<float>& values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return static_cast<double>(*at);
}

constexpr double kViews[] = {0, .5};  // of a turn

}  // namespace

void DifferenceMeter::add(const Picture& truth, const Picture& seen) {
  if (truth.width != seen.width || truth.height != seen.height)
    throw data::ArgumentError("picture: the two to compare are not of one size");
  std::vector<bool> missing(truth.shade.size());
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      const float is = truth.at(x, y), looks = seen.at(x, y);
      if (!shows(is) && !shows(looks)) continue;
      const bool both = shows(is) && shows(looks);
      errors_.push_back(both ? std::abs(is - looks) : 255);
      if (both) continue;
      // Missing pixels are that far outside the contour drawn, extra pixels outside the true contour.
      sum_.contour = std::max(sum_.contour, distance_to_surface(shows(is) ? seen : truth, x, y));
      ++(shows(is) ? sum_.missing : sum_.extra);
      if (shows(is))
        missing[static_cast<std::size_t>(y) * static_cast<std::size_t>(truth.width) +
                static_cast<std::size_t>(x)] = true;
    }
  }
  sum_.largest_gap = std::max(sum_.largest_gap, largest_area(missing, truth.width));
}

Difference DifferenceMeter::result() const {
  Difference d = sum_;
  if (errors_.empty()) return d;
  d.pixels = static_cast<std::int64_t>(errors_.size());
  const auto n = static_cast<double>(errors_.size());
  double sum = 0, beyond = 0;
  for (const float e : errors_) sum += e, beyond += e > 4;
  d.mean = sum / n, d.share = beyond / n;
  std::vector<float> sorted = errors_;
  d.median = quantile(sorted, .5), d.percentile_99 = quantile(sorted, .99);
  return d;
}

fast::Camera viewer(double turn) {
  const double angle = 2 * std::numbers::pi * turn;
  return {.eye = {4 * std::sin(angle), 1, 4 * std::cos(angle)}};
}

fast::DepthOptions adaptive(fast::Strategy strategy, double pixels) {
  const double angle = std::min(180., pixels / 2);
  return {.strategy = strategy, .target_pixels = pixels, .angle_front = angle, .angle_silhouette = angle};
}

fast::DepthOptions uniform(int depth) {
  return {.strategy = fast::Strategy::kUniform, .depth = depth};
}

Judge::Judge(data::ControlMesh mesh, int truth_depth) : mesh_(std::move(mesh)) {
  fast::Tessellator<float> engine(mesh_, {.max_depth = truth_depth});
  for (const double turn : kViews) {
    Canvas canvas(viewer(turn));
    engine.frame(uniform(truth_depth), viewer(turn), canvas);
    truth_.push_back(canvas.picture());
  }
}

Seen Judge::see(const fast::DepthOptions& strategy, const fast::CrackOptions& cracks) const {
  fast::Tessellator<float> engine(mesh_, {.cracks = cracks});
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
