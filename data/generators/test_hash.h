// SPDX-License-Identifier: MIT
// For the tests of this folder.
#pragma once

#include <bit>
#include <cstdint>

#include "data/control_mesh.h"

namespace limitcheck::data {

/// FNV-1a over the bits of all positions and indices, and over the faces' sizes unless all are triangles.
inline std::uint64_t hash(const ControlMesh& mesh) {
  std::uint64_t value = 0xcbf29ce484222325u;
  const auto add = [&](std::uint64_t word) {
    for (int i = 0; i < 8; ++i) value = (value ^ (word >> 8 * i & 0xff)) * 0x100000001b3u;
  };
  for (const auto& p : mesh.positions) {
    for (const double x : p) add(std::bit_cast<std::uint64_t>(x));
  }
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (!mesh.faces.are_triangles()) add(mesh.faces[f].size());
    for (const std::int32_t v : mesh.faces[f]) add(static_cast<std::uint32_t>(v));
  }
  return value;
}

}  // namespace limitcheck::data
