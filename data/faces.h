// SPDX-License-Identifier: MIT
// Faces of any number of corners, and the view of faces that are all triangles.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "data/error.h"

namespace limitcheck::data {

/// The faces of a mesh, counter-clockwise seen from outside: `faces[f][k]` is the vertex at corner k of face
/// f. The corners of all faces are numbered through, one face after the other.
class Faces {
 public:
  Faces() = default;
  Faces(std::initializer_list<std::initializer_list<std::int32_t>> faces) {
    for (const auto& face : faces) push_back(face);
  }
  explicit Faces(std::span<const std::array<std::int32_t, 3>> triangles) {
    reserve(triangles.size());
    for (const auto& t : triangles) push_back(t);
  }
  /// Throws ArgumentError beyond 2^31 - 1 corners.
  void push_back(std::span<const std::int32_t> face);
  void push_back(std::initializer_list<std::int32_t> face) { push_back({face.begin(), face.size()}); }
  /// Room for so many triangles.
  void reserve(std::size_t faces) {
    corners_.reserve(3 * faces);
    ends_.reserve(faces);
  }
  void clear() { *this = {}; }

  std::size_t size() const { return ends_.size(); }
  bool empty() const { return ends_.empty(); }
  bool are_triangles() const { return triangles_ == ends_.size(); }
  std::span<const std::int32_t> operator[](std::size_t f) const {
    return {corners_.data() + first_corner(f), static_cast<std::size_t>(ends_[f]) - first_corner(f)};
  }
  std::span<std::int32_t> operator[](std::size_t f) {
    return {corners_.data() + first_corner(f), static_cast<std::size_t>(ends_[f]) - first_corner(f)};
  }
  /// The vertices at all corners.
  std::span<const std::int32_t> corners() const { return corners_; }
  /// The number of corner 0 of face f; of the face after the last, the number of all corners.
  std::size_t first_corner(std::size_t f) const {
    return f == 0 ? 0 : static_cast<std::size_t>(ends_[f - 1]);
  }

  friend bool operator==(const Faces&, const Faces&) = default;

 private:
  std::vector<std::int32_t> corners_, ends_;
  std::size_t triangles_ = 0;
};

/// Faces that are all triangles, each as three indices. Refers to the faces.
class Triangles {
 public:
  using Triangle = std::array<std::int32_t, 3>;

  /// Throws ArgumentError if one is not.
  explicit Triangles(const Faces& faces) : corners_(faces.corners()) {
    if (!faces.are_triangles()) throw ArgumentError("the mesh has faces that are not triangles");
  }

  std::size_t size() const { return corners_.size() / 3; }
  bool empty() const { return corners_.empty(); }
  /// Constant, so that nobody takes them for the mesh's own and changes a copy.
  const Triangle operator[](std::size_t f) const {
    return {corners_[3 * f], corners_[3 * f + 1], corners_[3 * f + 2]};
  }
  Triangle front() const { return (*this)[0]; }
  Triangle back() const { return (*this)[size() - 1]; }
  std::vector<Triangle> to_vector() const { return {begin(), end()}; }

  /// Goes through the triangles.
  struct Iterator {
    using iterator_category = std::forward_iterator_tag;
    using value_type = Triangle;
    using difference_type = std::ptrdiff_t;
    using pointer = void;
    using reference = Triangle;

    const std::int32_t* corner = nullptr;

    const Triangle operator*() const { return {corner[0], corner[1], corner[2]}; }
    Iterator& operator++() { return corner += 3, *this; }
    Iterator operator++(int) { return {std::exchange(corner, corner + 3)}; }
    friend bool operator==(Iterator, Iterator) = default;
  };
  Iterator begin() const { return {corners_.data()}; }
  Iterator end() const { return {corners_.data() + corners_.size()}; }

  friend bool operator==(const Triangles& a, const Triangles& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }
  friend bool operator==(const Triangles& a, const std::vector<Triangle>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  std::span<const std::int32_t> corners_;
};

}  // namespace limitcheck::data
