// SPDX-License-Identifier: MIT
// Which subdivision scheme a mesh is meant for.
#pragma once

#include <string_view>

#include "data/control_mesh.h"

namespace limitcheck::data {

/// Which rule of subdivision.
enum class Scheme { kLoop, kCatmullClark };

/// "loop", "catmull-clark": the words of the command line and of reports.
constexpr std::string_view name_of(Scheme scheme) {
  return scheme == Scheme::kLoop ? "loop" : "catmull-clark";
}

/// The scheme of a mesh where none is asked for: Loop's if all its faces are triangles, else Catmull-Clark's.
inline Scheme natural_scheme(const ControlMesh& mesh) {
  return mesh.faces.are_triangles() ? Scheme::kLoop : Scheme::kCatmullClark;
}

}  // namespace limitcheck::data
