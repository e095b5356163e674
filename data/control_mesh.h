// SPDX-License-Identifier: MIT
// The control mesh: the one thing that reference/ and fast/ share.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "data/channel.h"
#include "data/faces.h"
#include "data/sharpness.h"

namespace limitcheck::data {

/// A mesh of polygons: the input of subdivision, and nothing computed from it.
///   positions   one (x, y, z) per vertex, finite
///   faces       vertex indices 0..positions.size()-1, counter-clockwise seen from outside
///   sharpness   sharp edges and vertices; empty for a surface that is smooth but for its boundary
///   holes       faces that are not shown, but shape those around them; ascending
///   channels    values by corner, such as texture coordinates; each has a name of its own
/// The container does not check any of this; `validate` (data/validate.h) and `fault_of` (data/channel.h) do.
struct ControlMesh {
  std::vector<std::array<double, 3>> positions;
  Faces faces;
  Sharpness sharpness = {};
  std::vector<std::int32_t> holes = {};
  std::vector<Channel> channels = {};

  friend bool operator==(const ControlMesh&, const ControlMesh&) = default;
};

/// The faces of a mesh that has triangles only: the way in for everything that is Loop's alone. Refers to the
/// mesh.
///   throws   ArgumentError if a face is no triangle
inline Triangles triangles_of(const ControlMesh& mesh) {
  return Triangles(mesh.faces);
}
Triangles triangles_of(const ControlMesh&& mesh) = delete;  // it would refer to what is gone

}  // namespace limitcheck::data
