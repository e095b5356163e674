// SPDX-License-Identifier: MIT
// A quad with the rings of its corners: all that repeated subdivision of one face needs.
#pragma once

#include <array>
#include <boost/container/small_vector.hpp>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reference/catmull_clark/masks.h"
#include "reference/mesh/sharp_tags.h"
#include "reference/mesh/topology.h"

namespace limitcheck::reference::catmull_clark {

/// Whether a bicubic patch describes the surface at a vertex of so many faces.
inline bool is_regular_vertex(int faces, bool on_boundary, VertexState state) {
  if (state == VertexState::kHeld) return on_boundary && faces == 1;
  return state == VertexState::kOrdinary && faces == (on_boundary ? 2 : 4);
}

/// A corner of a quad with its ring (masks.h). The quad lies between the ring's edges `sector` and `sector` +
/// 1, cyclically inside.
///   Point   a Vec3, or the index of one
template <class Point>
struct RingedCorner {
  Point point{};
  boost::container::small_vector<Point, 5> edges, faces;
  int sector = 0;
  bool on_boundary = false;
  VertexState state = VertexState::kOrdinary;

  int valence() const { return static_cast<int>(edges.size()); }
  int face_count() const { return static_cast<int>(faces.size()); }
  /// Neighbour i steps counter-clockwise from the quad's next corner: 0 is that corner, 1 the one before; i
  /// may be negative.
  const Point& edge(int i) const { return edges[slot(i, valence())]; }
  /// The far corner of the face after neighbour i: 0 is the corner opposite in the quad.
  const Point& face(int i) const { return faces[slot(i, face_count())]; }
  std::span<const Point> edge_span() const { return {edges.data(), edges.size()}; }
  std::span<const Point> face_span() const { return {faces.data(), faces.size()}; }
  bool is_regular() const { return is_regular_vertex(face_count(), on_boundary, state); }

 private:
  std::size_t slot(int i, int count) const {
    const int at = sector + i;
    return static_cast<std::size_t>(on_boundary ? at : (at % count + count) % count);
  }
};

/// One step of a corner and its ring: edges become edge points, faces face points.
template <class N>
RingedCorner<Vec3<N>> subdivide(const RingedCorner<Vec3<N>>& from) {
  RingedCorner<Vec3<N>> to;
  to.sector = from.sector;
  to.on_boundary = from.on_boundary;
  to.state = from.state;
  const std::size_t n = from.edges.size(), count = from.faces.size();
  to.faces.resize(count);
  to.edges.resize(n);
  for (std::size_t i = 0; i < count; ++i)
    to.faces[i] = face_point(from.point, from.edges[i], from.faces[i], from.edges[(i + 1) % n]);
  for (std::size_t i = 0; i < n; ++i)
    to.edges[i] = from.on_boundary && (i == 0 || i + 1 == n)
                      ? boundary_edge_point(from.point, from.edges[i])
                      : edge_point(from.point, from.edges[i], to.faces[(i + count - 1) % count], to.faces[i]);
  if (from.state == VertexState::kHeld)
    to.point = from.point;
  else if (from.on_boundary && from.state == VertexState::kOrdinary)
    to.point = boundary_vertex_point(from.point, from.edges.front(), from.edges.back());
  else  // a dart has its sharp edge at either end
    to.point = interior_vertex_point<N>(from.point, from.edge_span().first(count), to.face_span());
  return to;
}

/// Corners counter-clockwise: (u, v) = (0, 0), (1, 0), (1, 1), (0, 1).
template <class Point>
struct RingedQuad {
  std::array<RingedCorner<Point>, 4> corner;
  std::array<bool, 4> edge_on_boundary{};  ///< edge k from corner k to k + 1

  bool is_regular() const {
    return corner[0].is_regular() && corner[1].is_regular() && corner[2].is_regular() &&
           corner[3].is_regular();
  }

  /// The sixteen points of a regular quad. A boundary vertex of two faces is completed by linear ghosts
  /// beyond the boundary: ghost(on, inside) is twice the point on it minus the point inside. So is a held one
  /// of a single face, beyond either edge.
  template <class Ghost>
  std::array<Point, 16> patch(Ghost&& ghost) const {
    // Where neighbours 2 and 3 and far corners 1, 2, 3 of corner k lie in the patch.
    static constexpr std::array<std::size_t, 4> self{5, 6, 10, 9};
    static constexpr std::array<std::array<std::size_t, 5>, 4> around{
        {{4, 1, 8, 0, 2}, {2, 7, 1, 3, 11}, {11, 14, 7, 15, 13}, {13, 8, 14, 12, 4}}};
    std::array<Point, 16> p{};
    for (std::size_t k = 0; k < 4; ++k) p[self[k]] = corner[k].point;
    for (std::size_t k = 0; k < 4; ++k) {
      const RingedCorner<Point>& c = corner[k];
      const auto& [edge2, edge3, face1, face2, face3] = around[k];
      if (!c.on_boundary) {
        p[edge2] = c.edge(2), p[edge3] = c.edge(3);
        p[face1] = c.face(1), p[face2] = c.face(2), p[face3] = c.face(3);
      } else if (c.state == VertexState::kHeld) {
        p[edge2] = ghost(c.point, c.edge(0)), p[edge3] = ghost(c.point, c.edge(1));
        p[face1] = ghost(c.edge(1), c.face(0)), p[face3] = ghost(c.edge(0), c.face(0));
        p[face2] = ghost(p[edge3], p[face3]);
      } else if (c.sector == 0) {  // the boundary runs from neighbour 0 over the corner to neighbour 2
        p[edge2] = c.edge(2), p[face1] = c.face(1);
        p[edge3] = ghost(c.point, c.edge(1));
        p[face2] = ghost(c.edge(2), c.face(1));
        p[face3] = ghost(c.edge(0), c.face(0));
      } else {  // from neighbour -1 over the corner to neighbour 1
        p[edge3] = c.edge(-1), p[face3] = c.face(-1);
        p[edge2] = ghost(c.point, c.edge(0));
        p[face1] = ghost(c.edge(1), c.face(0));
        p[face2] = ghost(c.edge(-1), c.face(-1));
      }
    }
    return p;
  }
};

/// The corner of a quad that is opposite v.
inline std::int32_t opposite(const Topology& topology, std::int32_t face, std::int32_t v) {
  const auto quad = topology.faces()[static_cast<std::size_t>(face)];
  return quad[0] == v ? quad[2] : quad[1] == v ? quad[3] : quad[2] == v ? quad[0] : quad[1];
}

/// A vertex of a mesh of quads with its ring; point(v) is that of a vertex.
///   states   of the vertices; later ones, and all where there are none, are ordinary
template <class Point, class PointOf>
RingedCorner<Point> gather_vertex(const Topology& topology, std::int32_t v, PointOf&& point,
                                  std::span<const VertexState> states = {}) {
  const Sector sector = topology.sector(v);
  RingedCorner<Point> c;
  c.state = state_of(states, v);
  c.point = point(v);
  c.on_boundary = !sector.closed;
  for (const std::int32_t e : sector.neighbours) c.edges.push_back(point(e));
  for (const std::int32_t f : sector.faces) c.faces.push_back(point(opposite(topology, f, v)));
  return c;
}

/// Corner k of a face of a mesh of quads.
template <class Point, class PointOf>
RingedCorner<Point> gather_corner(const Topology& topology, std::size_t face, std::size_t k, PointOf&& point,
                                  std::span<const VertexState> states = {}) {
  RingedCorner<Point> corner = gather_vertex<Point>(topology, topology.faces()[face][k], point, states);
  corner.sector = topology.ring_index(face, k);
  return corner;
}

/// The face of a mesh of quads with its neighbourhood.
template <class Point, class PointOf>
RingedQuad<Point> gather(const Topology& topology, std::size_t face, PointOf&& point,
                         std::span<const VertexState> states = {}) {
  RingedQuad<Point> result;
  for (std::size_t k = 0; k < 4; ++k) {
    result.corner[k] = gather_corner<Point>(topology, face, k, point, states);
    const auto edge = static_cast<std::size_t>(topology.edge(face, k));
    result.edge_on_boundary[k] = topology.edges()[edge].on_boundary();
  }
  return result;
}

/// 2 on - inside.
template <class N>
Vec3<N> ghost_point(const Vec3<N>& on, const Vec3<N>& inside) {
  return on + (on - inside);
}

/// A quad's corners after one step, from which its four sub-quads are put together. Sub-quad k sits at corner
/// k and keeps the directions of u and v: its corner k is the vertex, k + 1 the point of edge k, k + 2 the
/// face point, k - 1 the point of edge k - 1.
template <class N>
class SubdividedQuad {
 public:
  explicit SubdividedQuad(const RingedQuad<Vec3<N>>& quad) : edge_on_boundary_(quad.edge_on_boundary) {
    for (std::size_t k = 0; k < 4; ++k) vertex_[k] = subdivide(quad.corner[k]);
    for (std::size_t k = 0; k < 4; ++k) make_edge_corner(k);
    face_.point = vertex_[0].face(0);
    for (std::size_t k = 0; k < 4; ++k) {
      face_.edges.push_back(edge_[(k + 3) % 4].point);
      face_.faces.push_back(vertex_[k].point);
    }
  }

  RingedQuad<Vec3<N>> subquad(int which) const {
    const auto k = static_cast<std::size_t>(which), next = (k + 1) % 4, across = (k + 2) % 4,
               before = (k + 3) % 4;
    RingedQuad<Vec3<N>> result;
    result.corner[k] = vertex_[k];
    result.corner[next] = edge_[k];
    result.corner[next].sector = 1;
    result.corner[across] = face_;
    result.corner[across].sector = which;
    result.corner[before] = edge_[before];
    result.corner[before].sector = 0;
    result.edge_on_boundary[k] = edge_on_boundary_[k];
    result.edge_on_boundary[before] = edge_on_boundary_[before];
    return result;
  }

 private:
  /// The point of edge k: ahead lies corner k + 1, to the left the face point, behind corner k; on the other
  /// side of the edge the face point of the neighbour, if there is one.
  void make_edge_corner(std::size_t k) {
    const std::size_t next = (k + 1) % 4, before = (k + 3) % 4;
    const RingedCorner<Vec3<N>>&a = vertex_[k], &b = vertex_[next];
    RingedCorner<Vec3<N>>& e = edge_[k];
    e.point = a.edge(0);
    e.on_boundary = edge_on_boundary_[k];
    e.edges = {b.point, a.face(0), a.point};
    e.faces = {vertex_[next].edge(0), vertex_[before].edge(0)};
    if (e.on_boundary) return;
    e.edges.push_back(a.face(-1));
    e.faces.push_back(a.edge(-1));
    e.faces.push_back(b.edge(2));
  }

  std::array<RingedCorner<Vec3<N>>, 4> vertex_, edge_;
  RingedCorner<Vec3<N>> face_;
  std::array<bool, 4> edge_on_boundary_;
};

}  // namespace limitcheck::reference::catmull_clark
