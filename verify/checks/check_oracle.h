// SPDX-License-Identifier: MIT
// What certificates say about each other: checks of the oracle that need no oracle.
#pragma once

#include <functional>
#include <vector>

#include "reference/surface/certified.h"
#include "verify/evidence/audit_case.h"
#include "verify/row/result.h"
#include "verify/subject/face_domain.h"

namespace limitcheck::verify {

/// Certificates of one mesh: of the point at a place, to kOracleDigits digits.
using Certificates = std::function<reference::CertifiedPoint(const Place&)>;
/// Whoever certifies: reference::CertifiedEvaluator, or, in tests, one with a fault.
using Oracle = std::function<Certificates(const data::ControlMesh&, data::Scheme)>;

inline constexpr int kOracleDigits = 25;
inline constexpr int kOraclePoints = 4;  // of a mesh

Oracle the_oracle();

/// Three rows (verify/row/rows.cpp) over points drawn by the mesh alone, most of them near sharp edges and vertices,
/// asked from each of their faces, or from 16 of them; in units of what is allowed, so that 1 is the bound.
/// What an evaluator throws is an error of its row.
///   points   how many are drawn
std::vector<Result> check_oracle(const AuditMesh& mesh, int points = kOraclePoints,
                                 const Oracle& oracle = the_oracle());

/// The subject `oracle`, which is no tessellator: an audit of it has these rows in place of all others.
const lc_subject& oracle_subject();
inline bool is_oracle(const AuditSubject& audited) {
  return audited.subject == &oracle_subject();
}

}  // namespace limitcheck::verify
