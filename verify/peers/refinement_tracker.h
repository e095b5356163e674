// SPDX-License-Identifier: MIT
// Where the vertices of a refined mesh lie on the control mesh, for libraries that keep no record of it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "verify/subject/face_domain.h"
#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// Follows a mesh through steps of Loop's scheme, which split each triangle in four, or of Catmull and Clark's,
/// which split each face of n corners in n quads. All it relies on is that old vertices keep their numbers and
/// new ones are appended: a new vertex on an edge has exactly two old neighbours, the ends of the edge that it
/// divides; and two edges in a row, of which a new face has the middles, have one face between them. No
/// geometry.
class RefinementTracker {
 public:
  explicit RefinementTracker(const lc_mesh& control);

  /// One step to faces of N corners, 3 or 4.
  ///   vertex_count   after it
  ///   faces          after it, in any order, corners in any rotation
  /// O(faces). Throws SubjectError(LC_FAILED) if that is not a split of each face.
  template <std::size_t N>
  void step(std::int64_t vertex_count, const std::vector<std::array<std::uint32_t, N>>& faces);

  std::int64_t vertex_count() const { return vertex_count_; }
  /// Every face in triangles around its first corner, and the control face of each.
  std::vector<std::array<std::uint32_t, 3>> triangles() const;
  std::vector<std::int32_t> triangle_face() const;
  /// One place for each vertex, the first in the order of faces.
  std::vector<Place> places() const;

 private:
  using Steps = std::array<std::uint32_t, 2>;  // in units of 1 / denominator
  struct Face {
    std::int32_t control, part;
    std::uint32_t denominator;
    std::vector<std::uint32_t> corners;
    std::vector<Steps> at;  // of a control face that is cut into quads: of each corner on its own part
  };
  struct Parent {
    const Face& face;
    std::size_t corner;
  };
  class Step;

  bool quads_;
  std::int64_t vertex_count_;
  std::vector<Face> faces_;
};

}  // namespace limitcheck::verify
