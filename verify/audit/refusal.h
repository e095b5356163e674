// SPDX-License-Identifier: MIT
// Meshes on which Loop subdivision is not defined: a subject must refuse them.
#pragma once

#include <string>
#include <vector>

#include "verify/audit/audit.h"

namespace limitcheck::verify {

struct BrokenMesh {
  const char* what;  // "an edge with three faces"
  data::ControlMesh mesh;
};

/// One for each way of being no oriented manifold, and one without faces.
const std::vector<BrokenMesh>& broken_meshes();

/// Held: refused, in whatever words, or nothing made of no faces. A finding: accepted. Crash or timeout.
struct Refusal {
  Status status = Status::kHeld;
  std::string message;
};

/// Hands `mesh` to the subject as it is. Never throws for what the subject does.
Refusal ask_for_refusal(const AuditSubject& subject, const data::ControlMesh& mesh, int threads);

}  // namespace limitcheck::verify
