// SPDX-License-Identifier: MIT
// Recognises a tessellation that is not one of the limit surface.
#pragma once

#include <string>
#include <vector>

#include "verify/files/checks/file_evidence.h"

namespace limitcheck::verify {

/// Returns sentences with figures, none if nothing is recognised. Compares a sample of the points with what
/// other schemes, and that of the control mesh without its last step to the limit, make of the same control
/// mesh, at every number of steps with about as many vertices; and the distance with that of the refined
/// control points. Schemes of triangles are tried on the control mesh with its faces cut as fans from their
/// first corner.
std::vector<std::string> diagnose(const FileEvidence& evidence);

}  // namespace limitcheck::verify
