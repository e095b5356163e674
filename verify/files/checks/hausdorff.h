// SPDX-License-Identifier: MIT
// The two-sided Hausdorff distance between a tessellation and the limit surface, between proved bounds: the triangles are
// laid over the domain, and a piece of the surface and what lies over it are no farther from one another than a bound.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "verify/files/checks/file_evidence.h"

namespace limitcheck::verify {

/// A distance that lies between two numbers, in the mesh's unit.
struct Bracket {
  double at_least = 0, at_most = 0;
  FacePoint where;  // on the surface, where at_least was found
};

struct Hausdorff {
  Bracket from_triangles;       // max over the triangles of the distance to the surface, holes included
  Bracket from_surface;         // max over the surface, but for holes, of the distance to the triangles
  std::int64_t loose = 0;       // triangles that reach over several control faces, or cover none
  double one_polygon_each = 0;  // at most so far is the surface from one polygon per control face
};

/// By how much of the largest distance found an upper bound may lie above it.
inline constexpr double kTightness = .02;
/// The triangles are laid over the domain by their placed corners and cut along the pieces of the surface
/// lattice. On a part that lies in one triangle T and one flat piece P, the distance from the part of P to T
/// is largest at one of its corners, because the distance to a convex set is a convex function; likewise from
/// the part of T to P; and the surface deviates from P by no more than piece_bounds.h proves. Parts of the
/// surface that no triangle covers are bounded by the distance at their middle and their size (of a triangle
/// taken out of a plane the bracket is 0.996 to 1.075 times the radius of its inscribed circle, which is the
/// distance). The lower bounds are exact distances at the most promising corners; pieces whose upper bound is
/// beyond the largest of them by more than kTightness are split, at most five times, or fourteen towards an
/// extraordinary vertex. There the upper bound stays too large: a triangle laid over the domain is shifted
/// along the surface against the piece it is compared with. Triangles over several faces are bounded by the
/// distances of their corners and their size, split three times. Rounding, 1e-15 of the mesh, is not accounted
/// for. Throws Interrupted.
Hausdorff hausdorff(const FileEvidence& evidence);

/// The row `file-hausdorff`; `bound` in diagonals, none: one polygon per control face (Loop's scheme: one triangle), and
/// the tolerance of positions.
std::vector<Result> check_file_hausdorff(const FileEvidence& evidence, std::optional<double> bound);

}  // namespace limitcheck::verify
