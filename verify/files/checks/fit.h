// SPDX-License-Identifier: MIT
// Moving a tessellation to where its control mesh is: scale, offset and rotation that a program put in.
#pragma once

#include <string>
#include <vector>

#include "verify/projection/closest_point.h"

namespace limitcheck::verify {

enum class Fit {
  kNone,
  kScale,      // one scale for all axes and an offset
  kSimilarity  // and a rotation
};

/// x -> scale * rotation * x + offset
struct Similarity {
  double scale = 1;
  std::array<Vector, 3> rotation{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  // rows
  Vector offset{};
  double residual = 0;  // rms distance of the points it was fitted to, afterwards

  Vector operator()(const Vector& x) const {
    Vector y = offset;
    for (int i = 0; i < 3; ++i) y[i] += scale * dot(rotation[i], x);
    return y;
  }
  Vector turned(const Vector& direction) const {
    return {dot(rotation[0], direction), dot(rotation[1], direction), dot(rotation[2], direction)};
  }
};

/// The map that brings the points nearest to the surface in the sense of least squares.
///   start    the bounding boxes of points and surface, in each of the 24 orientations along the axes (y up,
///            z up ...; one for kScale); the best of them by closest points
///   rounds   closest points, then Umeyama's similarity between pairs; at the end Gauss and Newton's steps on
///            the distances along the normals, which converge quadratically
///   points   three or more, finite; at most 4096 of them, evenly chosen, are used
Similarity fit(const ClosestPoint& surface, const std::vector<Vector>& points, Fit kind);

/// "scale 2.5, turned by 90 degrees about (1, 0, 0), offset (1, 2, 3)"
std::string to_string(const Similarity& map);

}  // namespace limitcheck::verify
