// SPDX-License-Identifier: MIT
// Recognises a tessellation that is not one of Loop's limit surface.
#pragma once

#include <string>
#include <vector>

#include "verify/files/file_evidence.h"

namespace limitcheck::verify {

/// Returns sentences with figures, none if nothing is recognised. Compares a sample of the points with what
/// other schemes, and Loop's without its last step to the limit, make of the same control mesh, at every
/// number of steps with about as many vertices; and the distance with that of Loop's refined control points.
std::vector<std::string> diagnose(const FileEvidence& evidence);

}  // namespace limitcheck::verify
