// SPDX-License-Identifier: MIT
// Who is next to whom in a control mesh: the edges, and the faces around each vertex in order.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "data/faces.h"

namespace limitcheck::reference {

/// Vertex indices, counter-clockwise.
using Triangle = std::array<std::int32_t, 3>;

/// An edge from a to b. `left_face` runs from a to b, `right_face` from b to a; it is -1 on the boundary.
struct Edge {
  std::int32_t a, b, left_face, right_face;
  bool on_boundary() const { return right_face < 0; }
};

/// The faces around a vertex v that are reached one from the other across edges, counter-clockwise seen from
/// outside. A closed sector goes all the way round and has as many neighbours as faces. An open sector begins
/// and ends on the boundary and has one neighbour more than faces.
///
///      r_2     r_1              r_3   r_2   r_1
///        \  1  /                  \  2 | 1  /
///      2  \   /  0               3  \  |  /  0
///    r_3 -- v -- r_0            r_4 -- v -- r_0
///      3  /   \  5
///        /  4  \                  open: r_0 and r_4
///      r_4     r_5              are on the boundary
///         closed
struct Sector {
  std::span<const std::int32_t> neighbours;  ///< r_0, r_1, ..: the other ends of the edges at v
  std::span<const std::int32_t> edges;       ///< the edge to each neighbour
  std::span<const std::int32_t> faces;       ///< face i has the edges i and i + 1, modulo their number
  bool closed;
};

/// Edges and ordered sectors of a manifold mesh of polygons, possibly with boundary.               O(corners)
/// A vertex has one sector: closed inside, open on the boundary, closed and empty where it has no faces.
///   throws data::ArgumentError: index out of range, face of fewer than three corners or with a vertex twice,
///   edge with more than two faces, clashing orientations, vertex with two sectors (a bow tie), closed sector
///   of fewer than three faces. (data/validate.h reports the same faults with their lines.)
class Topology {
 public:
  Topology(std::size_t vertex_count, data::Faces faces);
  Topology(std::size_t vertex_count, std::span<const Triangle> triangles)
      : Topology(vertex_count, data::Faces(triangles)) {}

  std::size_t vertex_count() const { return ring_start_.size() - 1; }
  const data::Faces& faces() const { return faces_; }
  std::span<const Edge> edges() const { return edges_; }

  Sector sector(std::int32_t v) const {
    const std::size_t begin = ring_start_[v], count = ring_start_[v + 1] - begin;
    const bool closed = count == 0 || ring_faces_[begin + count - 1] >= 0;
    return {{ring_.data() + begin, count},
            {ring_edges_.data() + begin, count},
            {ring_faces_.data() + begin, closed ? count : count - 1},
            closed};
  }
  /// The neighbours of a vertex: those of its sector.
  std::span<const std::int32_t> ring(std::int32_t v) const { return sector(v).neighbours; }
  bool on_boundary(std::int32_t v) const { return !sector(v).closed; }

  /// The edge from corner k of a face to the next corner.
  std::int32_t edge(std::size_t face, std::size_t k) const { return edge_[faces_.first_corner(face) + k]; }
  /// Where a face comes in the sector of its corner k: the i for which `sector(v).faces[i]` is the face.
  std::int32_t ring_index(std::size_t face, std::size_t k) const {
    return ring_index_[faces_.first_corner(face) + k];
  }

 private:
  struct Sides;
  void join(Sides& sides, std::size_t vertex_count);
  void order_sectors(const Sides& sides, std::size_t vertex_count);

  data::Faces faces_;
  std::vector<Edge> edges_;
  std::vector<std::int32_t> edge_, ring_index_;  ///< of each corner
  std::vector<std::size_t> ring_start_;          ///< of each vertex, and where the last one's ends
  std::vector<std::int32_t> ring_, ring_edges_, ring_faces_;  ///< an open sector has a face -1 at its end
};

/// How many faces vertices have of whose faces only some are there, with the means of all (surface/near_part.h). None
/// in ordinary meshes.
using Valences = std::map<std::int32_t, int>;
/// How many faces a vertex has: `faces` of them are there.
inline int valence_of(const Valences& valences, std::int32_t v, std::size_t faces) {
  const auto found = valences.find(v);
  return found != valences.end() ? found->second : static_cast<int>(faces);
}

/// A face that is a triangle.
inline Triangle triangle_of(const Topology& topology, std::size_t face) {
  const auto corners = topology.faces()[face];
  return {corners[0], corners[1], corners[2]};
}

/// The vertex of a face that is not on one of its edges; -1 for no face, which is beyond the boundary.
inline std::int32_t opposite(const Topology& topology, const Edge& edge, std::int32_t face) {
  if (face < 0) return -1;
  for (const std::int32_t v : topology.faces()[face])
    if (v != edge.a && v != edge.b) return v;
  return -1;
}

}  // namespace limitcheck::reference
