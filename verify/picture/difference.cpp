// SPDX-License-Identifier: MIT
#include "verify/picture/difference.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "data/error.h"

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

}  // namespace limitcheck::verify
