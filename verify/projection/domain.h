// SPDX-License-Identifier: MIT
// The parameter domain of a whole control mesh: its faces as unit triangles, joined at the edges.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace limitcheck::verify {

/// A point of the domain: barycentric coordinates in one face, >= 0, sum 1.
struct FacePoint {
  std::int32_t face = -1;
  std::array<double, 3> l{};
};

/// Two faces unfold into a plane as two triangles of a regular lattice, in which the limit surface is C2
/// across their edge. So a straight walk goes on in the next face.
class Domain {
 public:
  /// The triangles of a valid control mesh (data/validate.h).
  explicit Domain(std::span<const std::array<std::int32_t, 3>> triangles);

  std::span<const std::array<std::int32_t, 3>> triangles() const { return triangles_; }

  /// The face across the edge opposite corner k, or -1 on the boundary.
  std::int32_t across(std::int32_t face, int k) const { return across_[face][k]; }

  /// All faces at a control vertex.
  std::span<const std::int32_t> faces_at(std::int32_t vertex) const {
    return {star_.data() + star_start_[vertex], star_start_[vertex + 1] - star_start_[vertex]};
  }

  /// The same point in another face, if it lies in that one too: on a common edge, or at a common corner;
  /// coordinates are compared with 0 exactly. False otherwise.
  bool express(const FacePoint& point, std::int32_t face, FacePoint& result) const;

  /// Goes from `from` by `step` (the sum of which is 0),
  /// across interior edges, up to its end or to the boundary.
  FacePoint walk(FacePoint from, std::array<double, 3> step) const;

 private:
  std::vector<std::array<std::int32_t, 3>> triangles_, across_;
  std::vector<std::size_t> star_start_;
  std::vector<std::int32_t> star_;
};

/// Coordinates >= 0 with sum 1 from ones that are so up to rounding.
std::array<double, 3> clamped(std::array<double, 3> l);

}  // namespace limitcheck::verify
