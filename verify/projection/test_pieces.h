// SPDX-License-Identifier: MIT
// How far flat pieces are from the surface. For tests.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "verify/projection/closest_point.h"

namespace limitcheck::verify {

/// The largest distance of points of a piece from those of the surface with the same parameters.
inline double measured(const Piece& piece, const LimitSurface& surface, int n) {
  double worst = 0;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j) {
      const double a = static_cast<double>(i) / n, b = static_cast<double>(j) / n;
      const std::array<double, 3> weight{1 - a - b, a, b};
      worst = std::max(worst, norm(surface.position(piece.parameter(weight)) - piece.flat(weight)));
    }
  return worst;
}

/// The distance of p from the nearest corner of a piece; that from the surface is no larger.
inline double distance_to_corners(const SurfaceLattice& lattice, const Vector& p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < lattice.size(); ++t)
    for (const Vector& s : lattice.corners(t)) least = std::min(least, norm(p - s));
  return least;
}

}  // namespace limitcheck::verify
