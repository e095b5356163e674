// SPDX-License-Identifier: MIT
// Where the vertices of a refined mesh lie on the control mesh, for libraries that keep no record of it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// Follows a mesh through steps that split each triangle in four. All it relies on is that old vertices keep
/// their numbers and new ones are appended: a new vertex has exactly two old neighbours, the ends of the edge
/// it divides, and the old vertices that the corners of a new triangle come from are the corners of its
/// parent. No geometry.
class LatticeTracker {
 public:
  explicit LatticeTracker(const lc_mesh& control);

  /// One step.
  ///   vertex_count   after it
  ///   triangles      after it, in any order, corners in any rotation
  /// O(triangles). Throws SubjectError(LC_FAILED) if that is not a split of each triangle in four.
  void step(std::int64_t vertex_count, std::vector<std::array<std::uint32_t, 3>> triangles);

  std::int64_t vertex_count() const { return vertex_count_; }
  /// As given to the last step, and the control face of each.
  const std::vector<std::array<std::uint32_t, 3>>& triangles() const { return triangles_; }
  const std::vector<std::int32_t>& triangle_face() const { return face_; }
  /// One place for each vertex, the first in the order of triangles.
  std::vector<lc_provenance> provenance() const;

 private:
  using Place = std::array<std::uint32_t, 2>;  // (i, j) of (l1, l2), in units of 1 / denominator_
  std::int64_t vertex_count_;
  std::uint32_t denominator_ = 1;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<std::int32_t> face_;
  std::vector<std::array<Place, 3>> places_;  // of the corners of each triangle, on face_
};

}  // namespace limitcheck::verify
