// SPDX-License-Identifier: MIT
// The part of validation that has to do with sharp edges and vertices, and holes. Private to validate.cpp.
#pragma once

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "data/validate.h"

namespace limitcheck::data {

/// Tags of no edge or vertex, below 0, or of which two disagree; and holes that are no faces.
///   edges   of the mesh, the smaller vertex first; those that have no tag may be left out
///   first   the number of the first vertex and face in messages
std::vector<MeshFinding> tag_findings(const ControlMesh& mesh,
                                      const std::set<std::pair<std::int32_t, std::int32_t>>& edges,
                                      std::int64_t first);

}  // namespace limitcheck::data
