// SPDX-License-Identifier: MIT
// One step of a whole mesh of polygons, and the mesh of quads that evaluation starts from.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "data/error.h"
#include "data/faces.h"
#include "reference/catmull_clark/masks.h"
#include "reference/catmull_clark/ringed_quad.h"
#include "reference/mesh/cut_mesh.h"
#include "reference/mesh/topology.h"

namespace limitcheck::reference::catmull_clark {

/// One step: the new vertex points in the order of the vertices, then the edge points, then the face points.
///   states   of the vertices of a mesh that is cut along its sharp edges
template <class N>
std::vector<Vec3<N>> points_after_step(const Topology& topology, const std::vector<Vec3<N>>& positions,
                                       std::span<const VertexState> states = {},
                                       const Valences& valences = {}) {
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
    const VertexState state = state_of(states, static_cast<std::int32_t>(v));
    if (sector.faces.empty() || state == VertexState::kHeld) {
      refined[v] = positions[v];
    } else if (!sector.closed && state == VertexState::kOrdinary) {
      refined[v] =
          boundary_vertex_point(positions[v], at(sector.neighbours.front()), at(sector.neighbours.back()));
    } else {
      around.clear(), near.clear();
      // A dart has its sharp edge at either end.
      for (const std::int32_t e : sector.neighbours.first(sector.faces.size())) around.push_back(at(e));
      for (const std::int32_t f : sector.faces) near.push_back(face(f));
      refined[v] = interior_vertex_point<N>(positions[v], around, near,
                                            valence_of(valences, static_cast<std::int32_t>(v), 0));
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

/// One step of a mesh with sharp edges and vertices.
///   triangles   the rule for edges inside that are smooth; only the first step meets triangles
template <class N>
TaggedMesh<N> refine_once(const TaggedMesh<N>& mesh, data::TriangleRule triangles) {
  const Topology& topology = mesh.topology;
  std::vector<Vec3<N>> refined = points_after_step(topology, mesh.positions);
  const std::size_t vertices = mesh.positions.size(), edges = topology.edges().size();
  if (triangles == data::TriangleRule::kSmooth)
    for (std::size_t e = 0; e < edges; ++e) {
      const Edge& edge = topology.edges()[e];
      if (edge.on_boundary()) continue;
      N weight(0);
      const Vec3<N>& a = mesh.positions[static_cast<std::size_t>(edge.a)];
      Vec3<N> faces{};
      for (const std::int32_t f : {edge.left_face, edge.right_face}) {
        const auto at = static_cast<std::size_t>(f);
        weight += topology.faces()[at].size() == 3 ? N(47) / N(200) : N(1) / N(8);
        faces += refined[vertices + edges + at] - a;
      }
      const Vec3<N> along = mesh.positions[static_cast<std::size_t>(edge.b)] - a;
      refined[vertices + e] = a + along * (N(1) / N(2) - weight) + faces * weight;
    }
  sharpen(topology, mesh.sharpness, mesh.positions, refined);
  Topology finer(refined.size(), refined_faces(topology));
  Sharpness sharpness = mesh.sharpness.refined(topology, finer);
  return {std::move(finer), std::move(refined), std::move(sharpness)};
}

/// A mesh of quads with the same limit surface: the mesh itself, or, if it has other faces, the mesh after
/// one step; cut along its sharp edges.
template <class N>
struct QuadMesh : CutMesh<N> {
  using CutMesh<N>::topology, CutMesh<N>::positions;
  data::Faces given;  ///< the faces before that step, empty if there was none

  /// Of a mesh without tags the valences may be given.
  QuadMesh(data::Faces faces, std::vector<Vec3<N>> points, const SharpTags& tags = {},
           const Valences& valences = {})
      : CutMesh<N>(std::move(points), faces) {
    bool only_quads = true;
    for (std::size_t f = 0; f < faces.size(); ++f) only_quads = only_quads && faces[f].size() == 4;
    if (!tags.empty()) {
      Sharpness sharpness(topology, tags);
      TaggedMesh<N> mesh{std::move(topology), std::move(positions), std::move(sharpness)};
      if (!only_quads) mesh = refine_once(mesh, tags.triangles);
      this->settle(std::move(mesh));
    } else if (!only_quads) {
      positions = points_after_step(topology, positions, {}, valences);
      Topology refined(positions.size(), refined_faces(topology));
      topology = std::move(refined);
    }
    if (!only_quads) given = std::move(faces);
  }
  explicit QuadMesh(TaggedMesh<N> mesh) : CutMesh<N>(std::move(mesh)) {}

  std::size_t face_count() const { return given.size() > 0 ? given.size() : topology.faces().size(); }
};

/// Goes on into the quarter of a quad that holds a point, and says which: that at corner 0 .. 3. The parameters become
/// those on it.
template <class P>
std::size_t descend(P& u, P& v) {
  const P half = P(1) / P(2);
  const bool right = u > half, up = v > half;
  u = 2 * u - (right ? 1 : 0);
  v = 2 * v - (up ? 1 : 0);
  return up ? (right ? 2 : 3) : (right ? 1 : 0);
}

/// A quad that needs steps before its surface can be said, and a point of it: the mesh of few faces in whose
/// face 0 the point is after these steps, with no semi-sharp tags left.
///   at      the parameters on the quad; becomes those on face 0
///   steps   receives how many there were
template <class N, class P>
QuadMesh<N> settled_around(const TaggedMesh<N>& mesh, std::size_t quad, P& u, P& v, long& steps) {
  TaggedMesh<N> near = mesh.around(quad);
  for (steps = 0; !near.is_settled(0); ++steps)
    near = refine_once(near, data::TriangleRule::kCatmark).around(descend(u, v));
  return QuadMesh<N>(std::move(near));
}

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
  P in_u = u, in_v = v;
  const std::size_t k = descend(in_u, in_v);
  return {first + k, in_u, in_v, true};
}

}  // namespace limitcheck::reference::catmull_clark
