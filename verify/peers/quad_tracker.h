// SPDX-License-Identifier: MIT
// Where the vertices of a mesh refined by Catmull-Clark lie on the control mesh, for libraries that keep no
// record of it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "verify/subject/face_domain.h"
#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// Follows a mesh through steps that split each face of n corners into n quads. All it relies on is that old
/// vertices keep their numbers and new ones are appended: a new quad has one old vertex; the new vertices
/// beside it each have one more old neighbour, the other end of the edge that they divide; and these two
/// edges have one face between them. No geometry.
class QuadTracker {
 public:
  using Quad = std::array<std::uint32_t, 4>;
  explicit QuadTracker(const lc_mesh& control);

  /// One step.
  ///   vertex_count   after it
  ///   quads          after it, in any order, corners in any rotation
  /// O(quads). Throws SubjectError(LC_FAILED) if that is not a split of each face.
  void step(std::int64_t vertex_count, const std::vector<Quad>& quads);

  std::int64_t vertex_count() const { return vertex_count_; }
  /// Every face in triangles around its first corner, and the control face of each.
  std::vector<std::array<std::uint32_t, 3>> triangles() const;
  std::vector<std::int32_t> triangle_face() const;
  /// One place for each vertex, the first in the order of faces.
  std::vector<Place> places() const;

 private:
  using Steps = std::array<std::uint32_t, 2>;  // (i, j) of (u, v) in units of 1 / denominator
  struct Face {
    std::int32_t control, part;
    std::uint32_t denominator;
    std::vector<std::uint32_t> corners;
    std::vector<Steps> at;  // of a control face that is no quad: of each corner on its own part
  };
  std::int64_t vertex_count_;
  std::vector<Face> faces_;
};

}  // namespace limitcheck::verify
