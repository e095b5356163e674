// SPDX-License-Identifier: MIT
#pragma once

#include "data/control_mesh.h"
#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// The mesh that the host handed over, for subjects of our own.
inline data::ControlMesh control_mesh(const lc_mesh& mesh) {
  data::ControlMesh result;
  for (std::int64_t v = 0; v < mesh.vertex_count; ++v) {
    const double* p = mesh.positions + 3 * v;
    result.positions.push_back({p[0], p[1], p[2]});
  }
  for (std::int64_t f = 0; f < mesh.triangle_count; ++f) {
    const std::int32_t* t = mesh.triangles + 3 * f;
    result.faces.push_back({t[0], t[1], t[2]});
  }
  return result;
}

}  // namespace limitcheck::verify
