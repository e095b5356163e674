// SPDX-License-Identifier: MIT
#pragma once

#include <span>

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
  const std::int32_t* corner = mesh.corners;
  for (std::int64_t f = 0; f < mesh.face_count; ++f) {
    const auto size = static_cast<std::size_t>(mesh.face_sizes[f]);
    result.faces.push_back(std::span(corner, size));
    corner += size;
  }
  return result;
}

}  // namespace limitcheck::verify
