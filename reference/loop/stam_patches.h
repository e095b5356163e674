// SPDX-License-Identifier: MIT
// A mesh after one step of subdivision, and its regular patches: the part of Stam's evaluator that needs no
// eigenvectors.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "reference/loop/patch.h"
#include "reference/loop/refine.h"
#include "reference/loop/triangles.h"

namespace limitcheck::reference::detail {

inline bool is_regular(const Sector& sector, VertexState state) {
  return is_regular_vertex(sector.faces.size(), !sector.closed, state);
}

template <class N>
class RefinedPatches {
 public:
  /// The twelve control points of a patch in Stam's order.
  using Patch = std::array<std::int32_t, 12>;

  /// Keeps a reference to the topology and to the states of its vertices.
  RefinedPatches(const Topology& topology, const std::vector<Vec3<N>>& control,
                 const std::vector<VertexState>& states, Weights weights)
      : topology_(topology), states_(states) {
    refine(control, weights);
    make_patches();
  }

  /// Of the refined mesh: vertex points in the order of the vertices, edge points, ghosts.
  const Vec3<N>& point(std::int32_t id) const { return points_[id]; }
  std::int32_t edge_point(std::int32_t edge) const {
    return static_cast<std::int32_t>(topology_.vertex_count()) + edge;
  }

  /// Sub-face 0..2 at a corner, 3 the middle; unset at extraordinary corners.
  const Patch& patch(std::size_t f, int subface) const { return patches_[4 * f + subface]; }

 private:
  /// Points after one step: vertex points, edge points, then two ghosts per boundary edge, over its halves at
  /// a and b; and for each held vertex of one face the two points opposite its edges.
  void refine(const std::vector<Vec3<N>>& control, Weights weights) {
    points_ = refine_once(topology_, control, weights, states_);
    reflected_of_.assign(states_.size(), -1);
    for (std::size_t id = 0; id < states_.size(); ++id) {
      const Sector sector = topology_.sector(static_cast<std::int32_t>(id));
      if (states_[id] != VertexState::kHeld || sector.closed || sector.faces.size() != 1) continue;
      reflected_of_[id] = static_cast<std::int32_t>(points_.size());
      for (const std::int32_t e : sector.edges)
        points_.push_back(ghost_point(points_[id], points_[id], point(edge_point(e))));
    }
    ghost_of_.assign(topology_.edges().size(), -1);
    for (std::size_t f = 0; f < topology_.faces().size(); ++f)
      for (int k = 0; k < 3; ++k) {
        const std::int32_t e = topology_.edge(f, k);
        if (!topology_.edges()[e].on_boundary()) continue;
        ghost_of_[e] = static_cast<std::int32_t>(points_.size());
        const Triangle t = triangle_of(topology_, f);
        const auto a = t[k], b = t[(k + 1) % 3];
        points_.push_back(
            ghost_point(point(a), point(edge_point(e)), point(edge_point(topology_.edge(f, (k + 2) % 3)))));
        points_.push_back(
            ghost_point(point(edge_point(e)), point(b), point(edge_point(topology_.edge(f, (k + 1) % 3)))));
      }
  }

  /// Six neighbours of a vertex point after one step, from corner k's first neighbour in face f; regular
  /// vertices only.
  std::array<std::int32_t, 6> vertex_ring(std::size_t f, int k) const {
    const std::int32_t v = topology_.faces()[f][k];
    const Sector sector = topology_.sector(v);
    std::array<std::int32_t, 6> ring;
    for (std::size_t i = 0; i < sector.edges.size(); ++i) ring[i] = edge_point(sector.edges[i]);
    if (!sector.closed) {
      const std::size_t last = sector.edges.size() - 1;
      ring[last + 1] = ghost(v, sector.edges[last]);
      if (last == 1)
        for (int i = 0; i < 2; ++i) ring[3 + i] = reflected_of_[v] + i;
      ring[5] = ghost(v, sector.edges[0]);
    }
    std::rotate(ring.begin(), ring.begin() + topology_.ring_index(f, k), ring.end());
    return ring;
  }
  std::int32_t ghost(std::int32_t v, std::int32_t e) const {
    return ghost_of_[e] + (topology_.edges()[e].a == v ? 0 : 1);
  }
  /// Six neighbours of the edge point of side k, from corner k + 1 on, as in ringed_face.h.
  std::array<std::int32_t, 6> edge_ring(std::size_t f, int k) const {
    const Triangle t = triangle_of(topology_, f);
    const auto a = t[k], b = t[(k + 1) % 3];
    const std::int32_t e = topology_.edge(f, k);
    std::array<std::int32_t, 6> ring{
        b, edge_point(topology_.edge(f, (k + 1) % 3)), edge_point(topology_.edge(f, (k + 2) % 3)), a, 0, 0};
    if (topology_.edges()[e].on_boundary()) {
      ring[4] = ghost(a, e);
      ring[5] = ghost(b, e);
    } else {
      const auto beside = [&](std::int32_t v, int at) {
        const auto edges = topology_.sector(v).edges;
        const auto n = static_cast<int>(edges.size());
        return edge_point(edges[(at + n) % n]);
      };
      ring[4] = beside(a, topology_.ring_index(f, k) - 1);
      ring[5] = beside(b, topology_.ring_index(f, (k + 1) % 3) + 2);
    }
    return ring;
  }

  void make_patches() {
    patches_.resize(4 * topology_.faces().size());
    const auto assemble = [](const std::array<std::int32_t, 6>& a, const std::array<std::int32_t, 6>& b,
                             int b_from, const std::array<std::int32_t, 6>& c, int c_from) {
      const auto at = [](const std::array<std::int32_t, 6>& ring, int i) { return ring[i % 6]; };
      // Rings of points 4, 7, 8: (7 8 5 2 1 3), (8 4 3 6 10 11), (4 7 11 12 9 5).
      return Patch{a[4],
                   a[3],
                   a[5],
                   at(c, c_from),
                   a[2],
                   at(b, b_from + 3),
                   a[0],
                   a[1],
                   at(c, c_from + 4),
                   at(b, b_from + 4),
                   at(b, b_from + 5),
                   at(c, c_from + 3)};
    };
    for (std::size_t f = 0; f < topology_.faces().size(); ++f) {
      const std::array<std::array<std::int32_t, 6>, 3> edges{edge_ring(f, 0), edge_ring(f, 1),
                                                             edge_ring(f, 2)};
      for (int k = 0; k < 3; ++k)
        if (is_regular(topology_.sector(topology_.faces()[f][k]), state_of(states_, topology_.faces()[f][k])))
          patches_[4 * f + k] = assemble(vertex_ring(f, k), edges[k], 2, edges[(k + 2) % 3], 0);
      std::array<std::int32_t, 6> first = edges[0];
      std::rotate(first.begin(), first.begin() + 1, first.end());
      patches_[4 * f + 3] = assemble(first, edges[1], 1, edges[2], 1);
    }
  }

  const Topology& topology_;
  const std::vector<VertexState>& states_;
  std::vector<Vec3<N>> points_;
  std::vector<std::int32_t> ghost_of_, reflected_of_;
  std::vector<Patch> patches_;  ///< four per face
};

}  // namespace limitcheck::reference::detail
