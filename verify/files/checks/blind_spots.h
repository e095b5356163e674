// SPDX-License-Identifier: MIT
// Which faults a tessellation is too coarse to show.
#pragma once

#include <string>

#include "verify/files/checks/file_evidence.h"

namespace limitcheck::verify {

/// Where no vertex lies inside a control face, as in tessellations of depth 0 and 1: a sentence that says so,
/// and how wrong the limit weights may be without a vertex leaving the tolerance. Else empty.
///   A limit point is (1 - b) v + b r, v the vertex and r the mean of its ring. If b is b (1 + x), the point
///   moves by x b |r - v| = x |limit - v|; so x is not seen if x times the largest |limit - v| of the file's
///   depth is within the tolerance.
/// The evidence has its places.
std::string blind_spots(const FileEvidence& e);

}  // namespace limitcheck::verify
