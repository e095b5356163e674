// SPDX-License-Identifier: MIT
// How a vertex is subdivided in a mesh whose infinitely sharp edges are cut.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace limitcheck::fast {

/// A vertex with its ring of n faces as BasicAdjacency has it: e_0 .. e_{n-1} the neighbours along edges, and
/// e_n at an open one.
enum class VertexKind : std::uint8_t {
  kPlain,  // inside: the smooth rule; on a boundary or cut: the curve rule, from its first and last neighbour
  kHeld,   // it stays where it is
  kDart    // a cut ends here: on the boundary, n faces, first and last neighbour the same point. The vertex
           // follows the smooth rule of valence n, e_0 counted once; e_0 itself is the end of a curve. Limit
           // and tangents are not those of a smooth vertex.
};

/// The kind of each vertex, or nothing: all are plain. It refers to the list.
class VertexKinds {
 public:
  VertexKinds() = default;
  VertexKinds(std::span<const VertexKind> kinds) : kinds_(kinds) {}  // NOLINT: converts
  VertexKind operator[](std::int32_t v) const {
    return kinds_.empty() ? VertexKind::kPlain : kinds_[static_cast<std::size_t>(v)];
  }

 private:
  std::span<const VertexKind> kinds_;
};

}  // namespace limitcheck::fast
