// SPDX-License-Identifier: MIT
// From a mesh on which something fails to a small one on which the same fails.
#pragma once

#include <functional>

#include "verify/audit/audit_case.h"
#include "verify/audit/result.h"

namespace limitcheck::verify {

struct Shrunk {
  AuditMesh mesh;    // valid (data/validate.h); named as the original
  int depth = 0;     // the least at which it fails, if the faces had no depths of their own
  int attempts = 0;  // how often `fails` was asked
};

/// Delta debugging: lowers the depth, then takes away faces far from `face` (balls of face rings, then chunks
/// of faces, then single ones), collapses edges and drops sharp edges and vertices, as long as what remains
/// is a valid mesh on which `fails` says true. Positions stay; vertices that no face names any more go, the
/// others keep their order.
///   face      where the failure was seen, or -1: faces are tried in file order
///   fails     of a mesh and a depth; called one after the other; true for what is given
///   seconds   no new attempt after so many
Shrunk shrink(const AuditMesh& mesh, int depth, std::int64_t face,
              const std::function<bool(const AuditMesh&, int)>& fails, double seconds);

/// The same for one check of one subject: fails if the row is_bad in an audit at this level.
Shrunk shrink(const AuditSubject& subject, const AuditMesh& mesh, int depth, int threads,
              const Result& finding, double seconds);

}  // namespace limitcheck::verify
