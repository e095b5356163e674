// SPDX-License-Identifier: MIT
#include "verify/audit/ask_earlier.h"

#include <utility>
#include <vector>

#include "verify/evidence/face_depths.h"

namespace limitcheck::verify {

void ask_earlier(Session& session, const AuditMesh& mesh, std::span<const std::int32_t> asked, int deepest,
                 int threads) {
  const bool each = session.capabilities().per_face_depth != 0;
  for (std::vector<std::int32_t>& depths : earlier_depths(mesh.depths, asked.size(), deepest, each)) {
    for (const std::int32_t f : mesh.mesh.holes) depths[f] = -1;
    if (mesh.sample) depths = mesh.sample->cull(std::move(depths));
    (void)session.tessellate(depths, threads);
  }
}

}  // namespace limitcheck::verify
