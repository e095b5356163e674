// SPDX-License-Identifier: MIT
// From a mesh on which something fails to a small one on which the same fails.
#pragma once

#include <functional>
#include <limits>
#include <optional>

#include "verify/evidence/audit_case.h"
#include "verify/row/result.h"

namespace limitcheck::verify {

struct Shrunk {
  AuditMesh mesh;    // valid (data/validate.h); named as the original
  int depth = 0;     // the least at which it fails, if the faces had no depths of their own
  int attempts = 0;  // how often `fails` was asked
};

/// When to stop: no new attempt after so many seconds, or so many attempts.
struct ShrinkLimits {
  double seconds = std::numeric_limits<double>::infinity();
  int attempts = std::numeric_limits<int>::max();
};

/// Delta debugging: lowers the depth, then takes away faces far from `face` (balls of face rings, then chunks
/// of faces, then single ones), collapses edges and drops sharp edges and vertices, lowers the depths of
/// single faces, and rounds coordinates to few bits, as long as what remains is a valid mesh on which `fails`
/// says true. Vertices that no face names any more go, the others keep their order.
///   face      where the failure was seen, or -1: faces are tried in file order
///   fails     of a mesh and a depth; called one after the other; true for what is given
Shrunk shrink(const AuditMesh& mesh, int depth, std::int64_t face,
              const std::function<bool(const AuditMesh&, int)>& fails, const ShrinkLimits& limits);

/// A finding on a small mesh.
struct ShrunkFinding {
  Shrunk small;
  std::optional<Result> row;  // the same check on it; none if it is not found again
  bool relation = false;      // whether the check is one of relations.h, and needs Level::kThorough
};

/// The same for one check of one subject: fails if the row is_bad in an audit at the level it needs.
ShrunkFinding shrink(const AuditSubject& subject, const AuditMesh& mesh, int threads, const Result& finding,
                     const ShrinkLimits& limits);

}  // namespace limitcheck::verify
