// SPDX-License-Identifier: MIT
// Tessellations to files: PLY, OBJ, GLB, always with normals.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "fast/frame/sink.h"

namespace limitcheck::verify {

struct ColourClass {
  std::string name;  // "depth_3", "fan": one word
  std::array<std::uint8_t, 3> rgb{};
};

/// One class per triangle; no classes: no colours.
struct Colouring {
  std::vector<ColourClass> classes;
  std::vector<std::uint8_t> of_triangle;
};

/// Blue (0) to yellow (10) by the depth of the face each triangle belongs to; `depth` has one entry per face.
Colouring colour_by_depth(const fast::IndexedMesh<float>& mesh, std::span<const std::int32_t> depth);
/// Strip of a pair, strip of a singleton, fan, stitched ring.
Colouring colour_by_kind(const fast::IndexedMesh<float>& mesh);

/// Throws data::InputError FILE_UNKNOWN_FORMAT, which names the three extensions.
void check_extension(const std::filesystem::path& file);

/// Writes positions, unit normals and triangles; shared vertices stay shared, so that the file is as
/// watertight as the mesh.
///   PLY   binary little endian, floats bit for bit; colours on the faces
///   OBJ   shortest decimals that read back as the same float; a `usemtl` per class, colours in a .mtl beside
///   GLB   floats bit for bit; one primitive and one material per class, all on the same vertices
/// Each file appears whole or not at all (AtomicFile). Throws data::InputError FILE_CANNOT_WRITE, or
/// FILE_UNSUPPORTED if a GLB would exceed the 4 GiB its header can express.
void write_tessellation(const std::filesystem::path& file, const fast::IndexedMesh<float>& mesh,
                        const Colouring& colouring = {});

}  // namespace limitcheck::verify
