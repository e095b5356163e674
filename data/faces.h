// SPDX-License-Identifier: MIT
// Faces of any number of corners.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "data/error.h"

namespace limitcheck::data {

/// The faces of a mesh, counter-clockwise seen from outside: `faces[f][k]` is the vertex at corner k of face
/// f. The corners of all faces are numbered through, one face after the other.
class Faces {
 public:
  Faces() = default;
  explicit Faces(std::span<const std::array<std::int32_t, 3>> triangles) {
    corners_.reserve(3 * triangles.size());
    ends_.reserve(triangles.size());
    for (const auto& t : triangles) push_back(t);
  }
  /// Throws ArgumentError beyond 2^31 - 1 corners.
  void push_back(std::span<const std::int32_t> face) {
    if (face.size() > std::numeric_limits<std::int32_t>::max() - corners_.size())
      throw ArgumentError("the faces have more than 2^31 - 1 corners");
    corners_.insert(corners_.end(), face.begin(), face.end());
    ends_.push_back(static_cast<std::int32_t>(corners_.size()));
  }

  std::size_t size() const { return ends_.size(); }
  std::span<const std::int32_t> operator[](std::size_t f) const {
    return std::span(corners_).subspan(first_corner(f), ends_[f] - first_corner(f));
  }
  /// The vertices at all corners.
  std::span<const std::int32_t> corners() const { return corners_; }
  /// The number of corner 0 of face f.
  std::size_t first_corner(std::size_t f) const { return f == 0 ? 0 : ends_[f - 1]; }

 private:
  std::vector<std::int32_t> corners_, ends_;
};

}  // namespace limitcheck::data
