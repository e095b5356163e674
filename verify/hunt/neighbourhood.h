// SPDX-License-Identifier: MIT
// What lies about the place of a finding, as far as it tells faults apart.
#pragma once

#include <string>

#include "verify/audit/audit_case.h"
#include "verify/audit/result.h"

namespace limitcheck::verify {

/// In words that are the same for all places that a program cannot tell apart but by its geometry: "regular
/// face", "boundary; 2 vertices of 7-12 faces, side by side; sharp edges; depths differ by 3". Empty if the
/// finding names no face.
std::string neighbourhood(const Result& finding, const AuditMesh& mesh);

/// By which findings are one: scheme, check, status, and the neighbourhood. Stable.
std::string signature(const Result& finding, const AuditMesh& mesh);

}  // namespace limitcheck::verify
