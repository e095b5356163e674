// SPDX-License-Identifier: MIT
// Requests before the one that is judged.
#pragma once

#include <cstdint>
#include <span>

#include "verify/evidence/audit_case.h"
#include "verify/host/host.h"

namespace limitcheck::verify {

/// Asks for what `mesh.depths` asks for beforehand (face_depths.h), and throws the answers away. Throws as
/// Session::tessellate does.
///   asked    one depth for each face of the request to come
///   deepest  that a face has
void ask_earlier(Session& session, const AuditMesh& mesh, std::span<const std::int32_t> asked, int deepest,
                 int threads);

}  // namespace limitcheck::verify
