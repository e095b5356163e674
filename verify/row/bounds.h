// SPDX-License-Identifier: MIT
// The tolerances of the checks, and where they come from.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// The unit roundoff u of a precision: half an ulp of 1.
inline double unit_roundoff(lc_precision precision) {
  return precision == LC_FLOAT32 ? 0x1p-24 : 0x1p-53;
}

/// The spacing of the numbers of a precision at a magnitude >= 0.
inline double ulp_at(double magnitude, lc_precision precision) {
  const bool single = precision == LC_FLOAT32;
  const int least = single ? -126 : -1022;  // exponent of the smallest number that is not subnormal
  const int exponent = magnitude > 0 ? std::max(std::ilogb(magnitude), least) : least;
  return std::ldexp(1.0, exponent - (single ? 23 : 52));
}

/// What errors of positions are fractions of: the diagonal of the bounding box of the control mesh; of a mesh
/// whose points are all one, their largest coordinate; of a mesh that is the origin, 1.
inline double unit_of_length(double diagonal, double magnitude) {
  return diagonal > 0 ? diagonal : magnitude > 0 ? magnitude : 1;
}

/// Of sums of so many terms: the vertex of valence 32 of Loop's scheme, of 16 of Catmull-Clark's.
inline constexpr std::int64_t kOrdinaryTerms = 33;

/// How many roundings of size u M a step may add to each coordinate (M = largest coordinate), where its longest
/// sum has so many terms.
///
/// A new point is a sum of products w_k p_k with weights that add up to 1, none below 0. Rounding a weight and
/// its product makes at most 2 u w_k M, of all of them 2 u M. Each of the terms - 1 additions rounds a partial
/// sum, which is no larger than M, and so makes at most u M, in whatever order: together (terms + 1) u M, to the
/// first order in u. An order and numbers are easily found that reach terms * u M (row_test.cpp).
///
/// An ordinary stencil has 3 to 7 terms, which is eight roundings. Of longer sums up to kOrdinaryTerms errors do
/// not all go one way at each of the steps: measured, eight are enough for them, too.
inline std::int64_t roundings(std::int64_t terms) {
  return terms <= kOrdinaryTerms ? 8 : terms + 1;
}

/// How far a position may be from the exact one, in fractions of the bounding-box diagonal.
///
/// Every point of a subdivision is a convex combination of the level before: errors are not amplified, each
/// level and the limit mask add their own roundings, at depth + 2 steps, in three coordinates:
///     sqrt(3) * roundings (depth + 2) u M.
/// With eight roundings, at depth 5 on a bumpy sphere (M = 0.3 diagonals) this is 1.7e-6 in float; the good
/// subjects reach 1e-7, the smallest fault in a mask that anybody would make is 1e-4. In double the reference
/// itself, judged against 50 digits, is the limit: never less than 1e-14.
///   terms   of the longest sum of the place: ReferenceSurface::terms_at()
inline double position_bound(lc_precision precision, int depth, double magnitude, double diagonal,
                             std::int64_t terms = kOrdinaryTerms) {
  const double rounding = std::sqrt(3.0) * static_cast<double>(roundings(terms)) * (depth + 2) *
                          unit_roundoff(precision) * magnitude / diagonal;
  return precision == LC_FLOAT32 ? rounding : std::max(rounding, 1e-14);
}

/// How far the derivatives of a channel by both parameters together may be from the exact ones, in its diagonals.
///
/// A limit's derivative by a parameter of the control face is 2^steps times a sum of points after so many steps, whose
/// weights add up to 0 and, without their signs, to 2 at most: 1 for a cubic B-spline amid its faces, 8/6 for Loop's
/// regular vertex, 2 for the difference of two values. So an error of p in points is one of 2^steps 2 p in it, and of
/// sqrt(2) times that in both. The rest of 2^steps 4 p is for the roundings of the sum. Measured, `naive` and the
/// reference reach a tenth of it; a derivative of the wrong side of a seam is off by 1e-2 and more.
///   position   position_bound() of the channel
inline double channel_derivative_bound(double position, int steps) {
  return std::ldexp(position, steps + 2);
}

/// How far a normal may be from the exact one, in degrees.
///
/// Normals come from differences of points 2^-depth apart, so rounding grows by 2 with each level. The float
/// engine that takes them from the last level's differences is off by at most 8.4e-4 rad at depth 5 on 4000
/// faces: 1e-3 rad up to depth 5, doubling beyond. In double the same would be 2e-12; 1e-9 rad leaves room
/// for coarse evaluation at vertices of high valence and is still far below anything but rounding.
inline double normal_bound(lc_precision precision, int depth) {
  const double radians = precision == LC_FLOAT32 ? 1e-3 : 1e-9;
  return std::ldexp(radians, std::max(0, depth - 5)) * 57.295779513082320877;
}

/// What rounding the points that the tangents are made of does to a normal, in degrees: no engine of this
/// precision can do better where the tangents are short or nearly parallel, however it gets them.
///
/// A point has an error of the order of u M (M: largest coordinate). With two roundings for each coordinate
/// and the weights of the regular tangent mask, 8/6 in sum, a tangent is off by e = sqrt(3) * 2 * 8/6 u M at
/// worst, less than 5 u M, per unit of l1 or l2. The error e of both tangents t1, t2 turns their product by
///     asin(e (|t1| + |t2|) / |t1 x t2|),
/// anywhere from an e that reaches the shorter height of their parallelogram on. A point is ill-conditioned
/// from where this exceeds normal_bound, which holds elsewhere and has room for what differences over the
/// last level's steps lose on ordinary meshes. What they lose on needles beyond that is the engine's loss: it
/// can be avoided, by an origin nearby, and is reported.
///   condition  (|t1| + |t2|) / |t1 x t2|
inline double conditioned_normal_bound(lc_precision precision, double magnitude, double condition) {
  const double sine = 5 * unit_roundoff(precision) * magnitude * condition;
  return sine < 1 ? std::asin(sine) * 57.295779513082320877 : 180;
}

/// How far the length of a unit normal may be from 1: the rounding of three components, of a square root and
/// of a division, and the float engine's reciprocal square root with one Newton step.
inline double length_bound(lc_precision precision) {
  return 8 * unit_roundoff(precision);
}

}  // namespace limitcheck::verify
