// SPDX-License-Identifier: MIT
// One function per format; use write_tessellation.
#pragma once

#include <filesystem>

#include "verify/mesh_output/mesh_output.h"

namespace limitcheck::verify {

void write_ply(const std::filesystem::path& file, const fast::IndexedMesh<float>& mesh,
               const Colouring& colouring);
void write_obj(const std::filesystem::path& file, const fast::IndexedMesh<float>& mesh,
               const Colouring& colouring);
void write_glb(const std::filesystem::path& file, const fast::IndexedMesh<float>& mesh,
               const Colouring& colouring);

/// The triangles of each class in their order; one list of all without classes.
std::vector<std::vector<std::uint32_t>> triangles_by_class(const fast::IndexedMesh<float>& mesh,
                                                           const Colouring& colouring);

}  // namespace limitcheck::verify
