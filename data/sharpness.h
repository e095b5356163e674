// SPDX-License-Identifier: MIT
// Which edges and vertices of a control mesh are sharp, and the choices that go with it.
#pragma once

#include <cstdint>
#include <vector>

namespace limitcheck::data {

/// A sharpness of this and more is infinite: the edge stays sharp at every level.
inline constexpr float kInfiniteSharpness = 10;

/// An edge with a sharpness of 0 and more: the number of steps in which it is treated as sharp, the fraction
/// blends. Taken as the exact number that the float is.
struct SharpEdge {
  std::int32_t a, b;
  float sharpness;
  friend bool operator==(const SharpEdge&, const SharpEdge&) = default;
};
/// A vertex that is held where it is for so many steps.
struct SharpVertex {
  std::int32_t vertex;
  float sharpness;
  friend bool operator==(const SharpVertex&, const SharpVertex&) = default;
};

/// What happens on the boundary, whose edges are always sharp.
enum class Boundary : std::uint8_t {
  kEdge,          ///< its vertices are those of a crease
  kEdgeAndCorner  ///< and the vertices of one face only are held
};
/// How sharpness falls from step to step.
enum class Creasing : std::uint8_t {
  kUniform,  ///< by 1
  kChaikin   ///< by 1 after a mean with the neighbours along the crease
};
/// The weights of the edges of triangles in Catmull-Clark's first step.
enum class TriangleRule : std::uint8_t {
  kCatmark,  ///< those of any face
  kSmooth    ///< 47/100 for the face point
};

/// All of it; what a default constructed one says holds for a mesh without any of this.
struct Sharpness {
  std::vector<SharpEdge> edges;
  std::vector<SharpVertex> vertices;
  Boundary boundary = Boundary::kEdge;
  Creasing creasing = Creasing::kUniform;
  TriangleRule triangles = TriangleRule::kCatmark;

  /// Whether the surface is that of the mesh without tags. (The way of creasing says nothing without
  /// creases.)
  bool empty() const {
    return edges.empty() && vertices.empty() && boundary == Boundary::kEdge &&
           triangles == TriangleRule::kCatmark;
  }
  friend bool operator==(const Sharpness&, const Sharpness&) = default;
};

}  // namespace limitcheck::data
