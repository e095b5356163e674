// SPDX-License-Identifier: MIT
// One step of a whole mesh of polygons, and the mesh of quads that evaluation starts from.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "data/error.h"
#include "data/faces.h"
#include "reference/catmull_clark/masks.h"
#include "reference/mesh/topology.h"

namespace limitcheck::reference::catmull_clark {

/// One step: the new vertex points in the order of the vertices, then the edge points, then the face points.
template <class N>
std::vector<Vec3<N>> refine_once(const Topology& topology, const std::vector<Vec3<N>>& positions) {
  const auto at = [&](std::int32_t v) -> const Vec3<N>& { return positions[static_cast<std::size_t>(v)]; };
  const std::size_t vertices = positions.size(), edges = topology.edges().size(),
                    faces = topology.faces().size();
  std::vector<Vec3<N>> refined(vertices + edges + faces);
  std::vector<Vec3<N>> around, near;
  const auto face = [&](std::int32_t f) -> Vec3<N>& {
    return refined[vertices + edges + static_cast<std::size_t>(f)];
  };
  for (std::size_t f = 0; f < faces; ++f) {
    around.clear();
    for (const std::int32_t v : topology.faces()[f]) around.push_back(at(v));
    face(static_cast<std::int32_t>(f)) = face_point<N>(around);
  }
  for (std::size_t e = 0; e < edges; ++e) {
    const Edge& edge = topology.edges()[e];
    refined[vertices + e] =
        edge.on_boundary() ? boundary_edge_point(at(edge.a), at(edge.b))
                           : edge_point(at(edge.a), at(edge.b), face(edge.left_face), face(edge.right_face));
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    const Sector sector = topology.sector(static_cast<std::int32_t>(v));
    if (sector.faces.empty()) {
      refined[v] = positions[v];
    } else if (!sector.closed) {
      refined[v] =
          boundary_vertex_point(positions[v], at(sector.neighbours.front()), at(sector.neighbours.back()));
    } else {
      around.clear(), near.clear();
      for (const std::int32_t e : sector.neighbours) around.push_back(at(e));
      for (const std::int32_t f : sector.faces) near.push_back(face(f));
      refined[v] = interior_vertex_point<N>(positions[v], around, near);
    }
  }
  return refined;
}

/// The quads of that step, one for each corner of each face, in order. That of corner k has the vertex, the
/// point of edge k, the face point and the point of edge k - 1. In a quad it begins where the directions of u
/// and v stay those of the quad; in another face at the vertex.
inline data::Faces refined_faces(const Topology& topology) {
  const auto edges = static_cast<std::int32_t>(topology.vertex_count());
  const auto faces = edges + static_cast<std::int32_t>(topology.edges().size());
  data::Faces refined;
  for (std::size_t f = 0; f < topology.faces().size(); ++f) {
    const auto corners = topology.faces()[f];
    const std::size_t n = corners.size();
    for (std::size_t k = 0; k < n; ++k) {
      const std::array<std::int32_t, 4> quad{corners[k], edges + topology.edge(f, k),
                                             faces + static_cast<std::int32_t>(f),
                                             edges + topology.edge(f, (k + n - 1) % n)};
      std::array<std::int32_t, 4> turned = quad;
      if (n == 4)
        for (std::size_t i = 0; i < 4; ++i) turned[(k + i) % 4] = quad[i];
      refined.push_back(turned);
    }
  }
  return refined;
}

/// A mesh of quads with the same limit surface: the mesh itself, or, if it has other faces, the mesh after
/// one step.
template <class N>
struct QuadMesh {
  Topology topology;
  std::vector<Vec3<N>> positions;
  data::Faces given;  ///< the faces before that step, empty if there was none

  QuadMesh(data::Faces faces, std::vector<Vec3<N>> points)
      : topology(points.size(), faces), positions(std::move(points)) {
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (faces[f].size() != 4) {
        positions = refine_once(topology, positions);
        Topology refined(positions.size(), refined_faces(topology));
        topology = std::move(refined);
        given = std::move(faces);
        return;
      }
  }

  std::size_t face_count() const { return given.size() > 0 ? given.size() : topology.faces().size(); }
};

/// Where a parameter of a given face lies in the mesh of quads.
template <class P>
struct QuadParameter {
  std::size_t quad;
  P u, v;
  bool halved;  ///< (u, v) = 2 (given - a corner): derivatives of order d have the factor 2^d
};

/// (u, v) on a face: on a quad itself; on another face on the sub-quad of `corner`, u from the corner along
/// its edge to the next, v along the edge before.
///   throws   data::ArgumentError: no such face or corner (a quad has the corner 0 only), u or v
///            outside 0 .. 1
template <class N, class P>
QuadParameter<P> locate(const QuadMesh<N>& mesh, int face, int corner, const P& u, const P& v) {
  const auto refuse = [](const std::string& why) { throw data::ArgumentError(why); };
  if (face < 0 || static_cast<std::size_t>(face) >= mesh.face_count())
    refuse("no face " + std::to_string(face));
  if (!(u >= 0) || !(u <= 1) || !(v >= 0) || !(v <= 1)) refuse("u, v must be in 0..1");
  const auto f = static_cast<std::size_t>(face);
  const std::size_t corners = mesh.given.size() > 0 ? mesh.given[f].size() : 4;
  if (corner < 0 || static_cast<std::size_t>(corner) >= (corners == 4 ? 1 : corners))
    refuse("face " + std::to_string(face) + " has no corner " + std::to_string(corner) +
           " with a domain of its own");
  if (mesh.given.size() == 0) return {f, u, v, false};
  const std::size_t first = mesh.given.first_corner(f);
  if (corners != 4) return {first + static_cast<std::size_t>(corner), u, v, false};
  const P half = P(1) / P(2);
  const bool right = u > half, up = v > half;
  return {first + (up ? (right ? 2U : 3U) : (right ? 1U : 0U)), right ? P(2 * u - 1) : P(2 * u),
          up ? P(2 * v - 1) : P(2 * v), true};
}

}  // namespace limitcheck::reference::catmull_clark
