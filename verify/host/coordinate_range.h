// SPDX-License-Identifier: MIT
// How large and how small a mesh may be for its surface to be computed and judged.
#pragma once

#include <string>

#include "data/control_mesh.h"

namespace limitcheck::verify {

/// Empty if the largest coordinate is 0 or within 2^-100 and 2^100, 2^-240 and 2^240 with double_precision;
/// else a sentence that says so. Beyond, fourth powers of lengths (the square of a cross product of tangents)
/// overflow or vanish even if the tangents are scaled to their range first, which is no fault of a subject.
///   mesh  finite positions
std::string out_of_range(const data::ControlMesh& mesh, bool double_precision);

/// Throws data::ArgumentError with that sentence, after the mesh's name.
void require_range(const std::string& name, const data::ControlMesh& mesh, bool double_precision);

}  // namespace limitcheck::verify
