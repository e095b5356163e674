// SPDX-License-Identifier: MIT
// A part of a control mesh that is judged in place of the whole, for meshes too large to look at everywhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "data/control_mesh.h"

namespace limitcheck::verify {

/// Patches of faces of a control mesh (all faces around some vertices) and the faces on which their limit
/// surface depends (reference/mesh/support.h), so over the patches the part has the same surface as the whole.
/// The subject gets the whole, with every face outside the patches culled.
class MeshSample {
 public:
  /// At least `faces` faces (or all), around vertices drawn at random. `whole` is valid (data/validate.h).
  /// Time and memory O(vertices + faces of the whole).
  MeshSample(const data::ControlMesh& whole, std::size_t faces, std::uint64_t seed);

  /// As it was asked for: "FACES:SEED".
  const std::string& text() const { return text_; }

  /// The patches and their surroundings, a valid control mesh. Where the surroundings touch themselves in a
  /// vertex only, they are cut apart.
  const data::ControlMesh& part() const { return part_; }
  /// For each face of the part, the face of the whole.
  std::span<const std::int32_t> faces() const { return faces_; }
  /// For each face of the whole, the face of the part or -1.
  const std::vector<std::int32_t>& part_of() const { return part_of_; }

  /// Depths of the whole, with all faces outside the patches culled.
  std::vector<std::int32_t> cull(std::vector<std::int32_t> depth_of_whole) const;
  /// Depths of the part.
  std::vector<std::int32_t> depths_of_part(std::span<const std::int32_t> depth_of_whole) const;
  /// The part with the positions of another mesh of the same connectivity as the whole (a rounded one).
  data::ControlMesh part_with(const data::ControlMesh& positions) const;

 private:
  std::string text_;
  data::ControlMesh part_;
  std::vector<std::int32_t> faces_, part_of_;
  std::vector<std::int32_t> vertices_;  // for each vertex of the part, that of the whole
  std::vector<bool> in_patch_;          // for each face of the whole
};

}  // namespace limitcheck::verify
