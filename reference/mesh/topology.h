// SPDX-License-Identifier: MIT
// Who is next to whom in a control mesh: ordered vertex rings and edges.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace limitcheck::reference {

/// Vertex indices, counter-clockwise.
using Triangle = std::array<std::int32_t, 3>;

/// An edge from a to b; `left` is opposite in the face that
/// runs a -> b, `right` in the other face, -1 on the boundary.
struct Edge {
  std::int32_t a, b, left, right;
  bool on_boundary() const { return right < 0; }
};

/// Ordered neighbourhoods of a manifold triangle mesh, possibly with boundary.                         O(n)
///   throws std::invalid_argument: index out of range, edge with more than two faces, clashing orientations,
///   bow-tie vertex, interior vertex with fewer than three faces. (data/validate.h gives the friendlier
///   story.)
class Topology {
 public:
  Topology(std::size_t vertex_count, std::span<const Triangle> triangles);

  std::size_t vertex_count() const { return ring_start_.size() - 1; }
  std::span<const Triangle> triangles() const { return triangles_; }
  std::span<const Edge> edges() const { return edges_; }

  /// Neighbours counter-clockwise from outside: v_1..v_n of an interior vertex; r_0..r_K of a boundary
  /// vertex, the first and the last being its boundary neighbours.
  std::span<const std::int32_t> ring(std::int32_t v) const { return slice(ring_, v); }
  /// The edge to each of them.
  std::span<const std::int32_t> spokes(std::int32_t v) const { return slice(spokes_, v); }
  /// The face between neighbour i and the next; the last entry of a boundary vertex is -1.
  std::span<const std::int32_t> faces(std::int32_t v) const { return slice(faces_, v); }
  bool on_boundary(std::int32_t v) const { return boundary_[static_cast<std::size_t>(v)] != 0; }

  /// The edge from corner k to corner k + 1 of a face.
  std::int32_t edge(std::size_t face, int k) const { return face_edges_[face][static_cast<std::size_t>(k)]; }
  /// Position of corner k + 1 in the ring of corner k: the face is sector `sector` of that vertex.
  std::int32_t sector(std::size_t face, int k) const { return sectors_[face][static_cast<std::size_t>(k)]; }

 private:
  std::span<const std::int32_t> slice(const std::vector<std::int32_t>& all, std::int32_t v) const {
    const auto begin = ring_start_[static_cast<std::size_t>(v)];
    return {all.data() + begin, ring_start_[static_cast<std::size_t>(v) + 1] - begin};
  }

  std::vector<Triangle> triangles_;
  std::vector<Edge> edges_;
  std::vector<std::array<std::int32_t, 3>> face_edges_, sectors_;
  std::vector<std::size_t> ring_start_;
  std::vector<std::int32_t> ring_, spokes_, faces_;
  std::vector<char> boundary_;
};

}  // namespace limitcheck::reference
