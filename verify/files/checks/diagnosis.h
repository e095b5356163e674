// SPDX-License-Identifier: MIT
// Recognises a tessellation that is not one of the limit surface; and which faults one is too coarse to show.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "verify/files/checks/file_evidence.h"
#include "verify/row/bounds.h"

namespace limitcheck::verify {

struct Diagnosis {
  std::vector<std::string> sentences;  // with figures; none if nothing is recognised
  std::optional<Recognised> recognised;
  std::vector<Result> rows;  // `file-recognised`, if something is: which vertices are not those
};

/// Compares the points with what other schemes, and that of the control mesh without its last step to the
/// limit, make of the same control mesh, at every number of steps with about as many vertices: a sample, by
/// majority (recognise/recognise.h), and all with what that recognises, by rounding(); and the
/// distance from the surface with that of the refined control points. Schemes of triangles are tried on the
/// control mesh with its faces cut as fans from their first corner.
Diagnosis diagnose(const FileEvidence& evidence);

/// How the coordinates of a file were written, read off themselves.
struct Written {
  lc_precision precision = LC_FLOAT64;  // float, if all are floats but for the digits that are missing
  double last = 0;  // half of the last digit: of so many decimals, or of so many digits of the largest
};
///   share        of the coordinates that may be otherwise: those of points that are wrong
///   few_digits   believe fewer than six digits and decimals; round numbers look as if they were written so
Written written(const std::vector<Vector>& points, double share = 0, bool few_digits = false);

/// How far rounding may bring the points of a file from what a right program makes in so many steps, in the unit
/// of the coordinates: position_bound (verify/row/bounds.h), and what writing leaves out in three coordinates.
///   magnitude   largest coordinate of the control mesh
double rounding(const Written& how, int steps, double magnitude);

/// Where no vertex lies inside a control face, as in tessellations of depth 0 and 1: a sentence that says so,
/// and how wrong the limit weights may be without a vertex leaving the tolerance. Else empty.
///   A limit point is (1 - b) v + b r, v the vertex and r the mean of its ring. If b is b (1 + x), the point
///   moves by x b |r - v| = x |limit - v|; so x is not seen if x times the largest |limit - v| of the file's
///   depth is within the tolerance.
/// The evidence has its places.
std::string blind_spots(const FileEvidence& e);

}  // namespace limitcheck::verify
