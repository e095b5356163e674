// SPDX-License-Identifier: MIT
// Sharp edges and vertices with sharpnesses that are exact: floats as the binary fractions they are, or
// 23/10.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "data/sharpness.h"
#include "reference/point/parameter.h"

namespace limitcheck::reference {

/// data::Sharpness with exact numbers.
struct SharpTags {
  /// An edge between two vertices.
  struct Edge {
    std::int32_t a, b;
    Parameter sharpness;  ///< 10 and more is infinite
  };
  /// A vertex by its number.
  struct Vertex {
    std::int32_t vertex;
    Parameter sharpness;
  };
  /// In a mesh that was cut along seams: an edge that a vertex has beyond them.
  struct Beyond {
    std::int32_t vertex;
    Parameter sharpness;
    bool holds;  ///< whether the vertex's own rule counts it
  };
  std::vector<Edge> edges;
  std::vector<Vertex> vertices;
  std::vector<Beyond> beyond;
  data::Boundary boundary = data::Boundary::kEdge;
  data::Creasing creasing = data::Creasing::kUniform;
  data::TriangleRule triangles = data::TriangleRule::kCatmark;

  SharpTags() = default;
  SharpTags(const data::Sharpness& given)  // NOLINT: the same thing
      : boundary(given.boundary), creasing(given.creasing), triangles(given.triangles) {
    const auto exact = [](float s) { return Parameter(std::min(s, data::kInfiniteSharpness)); };
    for (const auto& e : given.edges) edges.push_back({e.a, e.b, exact(e.sharpness)});
    for (const auto& v : given.vertices) vertices.push_back({v.vertex, exact(v.sharpness)});
  }

  bool empty() const {
    return edges.empty() && vertices.empty() && beyond.empty() && boundary == data::Boundary::kEdge &&
           triangles == data::TriangleRule::kCatmark;
  }
};

/// What a vertex does that has no semi-sharp tags left, in a mesh that is cut along its sharp edges.
enum class VertexState : std::uint8_t {
  kOrdinary,  ///< the rule of its sector: smooth inside, a B-spline curve on the boundary
  kHeld,      ///< it stays where it is: a corner, or inside the tip of a cone
  kDart  ///< one sharp edge ends there: an open sector whose two ends are the same edge, and the smooth rule
};

/// Of a vertex; later ones, and all where there are none, are ordinary.
inline VertexState state_of(std::span<const VertexState> states, std::int32_t v) {
  const auto at = static_cast<std::size_t>(v);
  return at < states.size() ? states[at] : VertexState::kOrdinary;
}

}  // namespace limitcheck::reference
