// SPDX-License-Identifier: MIT
// The half-edges of a control mesh in flat arrays, built in O(n).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "data/control_mesh.h"

namespace limitcheck::fast {

/// Half-edge adjacency of an oriented 2-manifold mesh of faces with K = 3 or 4 corners, with or without
/// boundary, of any valence.
///
/// Half-edge h = K f + k runs from corner k to corner (k + 1) % K of face f, with the face on its left.
///
///              r1                  Around a vertex v, counter-clockwise:
///             /  \                   h0 = outgoing(v)          v -> r0
///      prev  / f  \ next             h1 = rotate(h0)           v -> r1
///           /      \                 ...
///          v ------> r0            Interior: after valence(v) steps h0 again.
///              h0                  Boundary: h0 has no twin (the edge v -> r0 is the first boundary edge),
///                                  every face is met, then comes -1.
///
/// Time and space O(faces + vertices) for any input and valence (bench/frame_bench). Space: 3 K ints per face
/// and 2 per vertex.
template <int K>
class BasicAdjacency {
 public:
  /// Throws data::ArgumentError with what data::validate says: a face that has not K corners, index out of range,
  /// vertex repeated in a face, edge with more than two faces or with two faces of opposite orientation,
  /// vertex with two fans (bow-tie), interior vertex of valence below 3, more than 2^31 / K faces.
  /// [claims D9, D13] A vertex without faces is allowed: valence 0, outgoing -1. The mesh itself is not kept.
  explicit BasicAdjacency(const data::ControlMesh& mesh);

  /// Makes boundary edges of some that have two faces. `cuts` has one entry per half-edge, not 0 where to
  /// cut; both half-edges of an edge must be marked. A vertex with two such edges, or with one and on the
  /// boundary, becomes one vertex for each of its fans: the first keeps its number, the others come after all
  /// there are. A vertex at the end of a single cut stays one, on the boundary, with the edge's other end as
  /// its first neighbour and as its last.
  ///   returns   for each vertex the one it was before
  std::vector<std::int32_t> cut(std::span<const std::uint8_t> cuts);

  int face_count() const { return static_cast<int>(origin_.size() / K); }
  int vertex_count() const { return static_cast<int>(outgoing_.size()); }

  static std::int32_t next(std::int32_t h) { return h % K == K - 1 ? h - (K - 1) : h + 1; }
  static std::int32_t prev(std::int32_t h) { return h % K == 0 ? h + (K - 1) : h - 1; }
  static std::int32_t face(std::int32_t h) { return h / K; }

  /// The half-edge of the same edge in the neighbouring face; -1 on the boundary.
  std::int32_t twin(std::int32_t h) const { return twin_[h]; }
  /// The vertex a half-edge starts from, and the one it ends at.
  std::int32_t origin(std::int32_t h) const { return origin_[h]; }
  std::int32_t target(std::int32_t h) const { return origin(next(h)); }
  /// Vertex at corner k of a face.
  std::int32_t corner(std::int32_t f, int k) const { return origin(K * f + k); }
  /// The face across edge k of a face; -1 if there is none.
  std::int32_t neighbour(std::int32_t f, int k) const {
    const std::int32_t h = twin(K * f + k);
    return h < 0 ? -1 : h / K;
  }

  /// The canonical outgoing half-edge of a vertex: the one without twin on the boundary, else the one of
  /// smallest index; -1 if the vertex has no face.
  std::int32_t outgoing(std::int32_t v) const { return outgoing_[v]; }
  /// The next outgoing half-edge counter-clockwise; -1 after the last face of a boundary vertex, whose last
  /// ring point r_K is origin(prev(h)).
  std::int32_t rotate(std::int32_t h) const { return twin(prev(h)); }
  /// All outgoing half-edges of a vertex counter-clockwise, the canonical one first.
  std::span<const std::int32_t> fan(std::int32_t v) const {
    return {fan_.data() + first_[v], fan_.data() + first_[v + 1]};
  }
  /// Calls visit(vertex) for every neighbour of v counter-clockwise, that of the canonical half-edge first.
  template <class Visit>
  void for_each_neighbour(std::int32_t v, Visit&& visit) const {
    for (const std::int32_t h : fan(v)) visit(target(h));
    if (on_boundary(v)) visit(origin(prev(fan(v).back())));
  }
  /// Number of neighbouring vertices (faces on the inside, faces + 1 on the boundary; 0 without faces).
  int valence(std::int32_t v) const { return static_cast<int>(fan(v).size()) + (on_boundary(v) ? 1 : 0); }
  bool on_boundary(std::int32_t v) const { return outgoing(v) >= 0 && twin(outgoing(v)) < 0; }
  /// Largest valence of the mesh, 0 without faces.
  int max_valence() const { return max_valence_; }

 private:
  void read_faces(const data::ControlMesh& mesh);
  void sort_by_origin();
  void link(const data::ControlMesh& mesh);
  void split(const std::vector<std::vector<std::int32_t>>& added);

  std::vector<std::int32_t> origin_;    // per half-edge
  std::vector<std::int32_t> twin_;      // per half-edge
  std::vector<std::int32_t> fan_;       // half-edges by origin, counter-clockwise
  std::vector<std::int32_t> first_;     // per vertex and one more: into fan_
  std::vector<std::int32_t> outgoing_;  // per vertex
  int max_valence_ = 0;
};

/// Of triangles, which Loop's scheme is about, and of quads.
using Adjacency = BasicAdjacency<3>;
using QuadAdjacency = BasicAdjacency<4>;  ///< of quads

extern template class BasicAdjacency<3>;
extern template class BasicAdjacency<4>;

}  // namespace limitcheck::fast
