// SPDX-License-Identifier: MIT
// How deep an audit tessellates each face of a mesh, and whether this machine can hold what comes of it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "data/control_mesh.h"

namespace limitcheck::cli {

/// --depths: "uniform", "random", "random:SEED", "view", "file:FILE".
struct Depths {
  std::string kind;
  std::optional<std::uint64_t> seed;
};

/// Throws std::invalid_argument for anything else.
Depths parse_depths(const std::string& text);

/// A depth for every face, or none at all if it is `deepest` for each.
std::vector<std::int32_t> face_depths(const Depths& depths, const data::ControlMesh& mesh, int deepest);

/// Throws std::invalid_argument if the points of this mesh (of the faces in `face_depth`; if it is empty all
/// at `deepest`) take more memory than the machine has: hours of swapping would end without a report.
void refuse_too_many_points(const std::string& name, const data::ControlMesh& mesh,
                            std::span<const std::int32_t> face_depth, int deepest);

}  // namespace limitcheck::cli
