// SPDX-License-Identifier: MIT
// Limit points and normals of a refined mesh, by the masks written out again: a way to OpenSubdiv's results
// that shares nothing with OpenSubdiv (nor with reference/). For tests of this folder.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "verify/subject/host.h"

namespace limitcheck::verify::test {

using Point = std::array<double, 3>;

struct Ring {
  Point centre;
  std::vector<Point> points;  // counter-clockwise, from boundary to boundary if open
  bool open;
};

/// The rings of all vertices of a tessellation whose vertices are shared.
inline std::vector<Ring> rings(const Tessellation& t) {
  std::vector<std::map<std::uint32_t, std::uint32_t>> next(static_cast<std::size_t>(t.vertex_count()));
  for (const auto& corners : t.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) next[corners[k]][corners[(k + 1) % 3]] = corners[(k + 2) % 3];
  }
  std::vector<Ring> result;
  for (std::size_t v = 0; v < next.size(); ++v) {
    auto first = next[v].begin()->first;
    bool open = false;
    for (const auto& [from, to] : next[v]) {
      bool reached = false;
      for (const auto& [other, target] : next[v]) reached = reached || target == from;
      if (!reached) first = from, open = true;
    }
    Ring ring{t.position(static_cast<std::int64_t>(v)), {t.position(first)}, open};
    for (auto at = next[v].find(first); at != next[v].end() && at->second != first;
         at = next[v].find(at->second)) {
      ring.points.push_back(t.position(at->second));
    }
    result.push_back(std::move(ring));
  }
  return result;
}

inline Point weighted(const Ring& ring, double centre, const std::vector<double>& weights) {
  Point sum{};
  for (std::size_t c = 0; c < 3; ++c) {
    sum[c] = centre * ring.centre[c];
    for (std::size_t k = 0; k < weights.size(); ++k) sum[c] += weights[k] * ring.points[k][c];
  }
  return sum;
}

/// C14, D1.
inline Point limit_position(const Ring& ring) {
  const auto n = ring.points.size();
  std::vector<double> weights(n, 1.0);
  double centre = 4;
  if (ring.open) {
    for (std::size_t k = 1; k + 1 < n; ++k) weights[k] = 0;
  } else {
    const double a =
        0.625 - std::pow(3 + 2 * std::cos(2 * std::numbers::pi / static_cast<double>(n)), 2) / 64;
    centre = 3 * static_cast<double>(n) / (8 * a);
  }
  const double total = ring.open ? 6 : centre + static_cast<double>(n);
  Point sum = weighted(ring, centre, weights);
  for (double& x : sum) x /= total;
  return sum;
}

inline Point unit_cross(const Point& a, const Point& b) {
  const Point n{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  return {n[0] / length, n[1] / length, n[2] / length};
}

/// C17.
inline Point interior_normal(const Ring& ring) {
  std::vector<double> cosine, sine;
  for (std::size_t k = 0; k < ring.points.size(); ++k) {
    const double angle =
        2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(ring.points.size());
    cosine.push_back(std::cos(angle));
    sine.push_back(std::sin(angle));
  }
  return unit_cross(weighted(ring, 0, cosine), weighted(ring, 0, sine));
}

/// Along the boundary x across it. `hoppe`: D4, the mask of another rule that OpenSubdiv uses from K = 4 on;
/// else D2, the mask of the rule itself.
inline Point boundary_normal(const Ring& ring, bool hoppe) {
  const std::size_t faces = ring.points.size() - 1;
  const double theta = std::numbers::pi / static_cast<double>(faces), c = std::cos(theta),
               s = std::sin(theta);
  std::vector<double> across(faces + 1), along(faces + 1);
  double centre = -2;
  if (faces == 1) {
    across = {1, 1};
  } else {
    for (std::size_t k = 1; k < faces; ++k) across[k] = std::sin(static_cast<double>(k) * theta);
    across.front() = across.back() = hoppe ? s / (2 * c - 2) : -c * (1 + c) / ((1 + 2 * c) * s);
    centre = hoppe ? 0 : (2 * c - 1) * across.front() - s;
  }
  along.front() = 1;
  along.back() = -1;
  return unit_cross(weighted(ring, 0, along), weighted(ring, centre, across));
}

/// Keeps the worst value seen in the test's record.
inline void record(const std::string& what, double worst) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", worst);
  testing::Test::RecordProperty(what, text);
}

/// In degrees; NaN if either is.
inline double angle(const Point& a, const Point& b) {
  const Point n{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  const double sine = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  return std::atan2(sine, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) * 180 / std::numbers::pi;
}

}  // namespace limitcheck::verify::test
