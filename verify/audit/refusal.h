// SPDX-License-Identifier: MIT
// Meshes on which Loop subdivision is not defined: a subject must refuse them.
#pragma once

#include <string>
#include <vector>

#include "verify/audit/audit_case.h"
#include "verify/audit/result.h"

namespace limitcheck::verify {

struct BrokenMesh {
  const char* what;  // "an edge with three faces"
  data::ControlMesh mesh;
};

/// One for each way of being no oriented manifold, one without faces, one without vertices, one with an index
/// out of range and one with a coordinate that is no number.
const std::vector<BrokenMesh>& broken_meshes();

/// Held: refused, in whatever words, or nothing made of no faces. A finding: accepted. Crash or timeout.
struct Refusal {
  Status status = Status::kHeld;
  std::string message;
};

/// What a subject made of each of broken_meshes().
std::vector<Refusal> ask_for_refusals(const AuditSubject& subject, int threads);

/// Hands `mesh` to the subject as it is. Never throws for what the subject does.
Refusal ask_for_refusal(const AuditSubject& subject, const data::ControlMesh& mesh, int threads);

}  // namespace limitcheck::verify
