// SPDX-License-Identifier: MIT
// A triangle with the rings of its corners: all that repeated subdivision of one face needs.
#pragma once

#include <array>
#include <boost/container/small_vector.hpp>
#include <span>

#include "reference/loop/vertex_limit.h"
#include "reference/mesh/topology.h"

namespace limitcheck::reference {

/// A corner with its ring, counter-clockwise, boundary neighbours first and last (masks.h). The face lies
/// between ring entries `ring_index` and `ring_index` + 1 (cyclically when interior).
template <class N>
struct RingedCorner {
  Vec3<N> point;
  boost::container::small_vector<Vec3<N>, 6> ring;
  int ring_index = 0;
  bool on_boundary = false;
  VertexState state = VertexState::kOrdinary;

  int size() const { return static_cast<int>(ring.size()); }
  /// Neighbour i steps counter-clockwise from the face's first edge; i may be negative.
  const Vec3<N>& neighbour(int i) const {
    const int at = ring_index + i;
    return ring[on_boundary ? at : (at + size()) % size()];
  }
  std::span<const Vec3<N>> span() const { return {ring.data(), ring.size()}; }
  bool is_regular() const {
    return is_regular_vertex(ring.size() - (on_boundary ? 1 : 0), on_boundary, state);
  }
};

template <class N>
struct RingedFace {
  std::array<RingedCorner<N>, 3> corner;
  std::array<bool, 3> edge_on_boundary{};  ///< edge k from corner k to k + 1
  Weights weights = Weights::kLoop;

  /// The face of a mesh with its neighbourhood.
  static RingedFace gather(const Topology& topology, const std::vector<Vec3<N>>& positions, std::size_t face,
                           Weights weights = Weights::kLoop, std::span<const VertexState> states = {}) {
    RingedFace result;
    result.weights = weights;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t v = topology.faces()[face][k];
      const Sector sector = topology.sector(v);
      auto& c = result.corner[k];
      c.point = positions[v];
      c.state = state_of(states, v);
      c.on_boundary = !sector.closed;
      c.ring_index = topology.ring_index(face, k);
      for (const std::int32_t r : sector.neighbours) c.ring.push_back(positions[r]);
      result.edge_on_boundary[k] = topology.edges()[topology.edge(face, k)].on_boundary();
    }
    return result;
  }

  bool is_regular() const {
    return corner[0].is_regular() && corner[1].is_regular() && corner[2].is_regular();
  }
};

/// A face's corners after one step, from which its four sub-faces are put together. Sub-face k < 3 sits at
/// corner k, (c_k, e_k, e_{k-1}); sub-face 3 is the middle one, (e_0, e_1, e_2); e_k is the edge point of
/// edge k.
template <class N>
class SubdividedFace {
 public:
  explicit SubdividedFace(const RingedFace<N>& face) : weights_(face.weights) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& from = face.corner[k];
      auto& to = vertex_[k];
      to.ring_index = from.ring_index;
      to.on_boundary = from.on_boundary;
      to.state = from.state;
      const std::size_t n = from.ring.size();
      to.point = vertex_point<N>(from.point, from.span(), from.on_boundary, from.state, weights_);
      to.ring.resize(n);
      for (std::size_t i = 0; i < n; ++i)
        to.ring[i] = from.on_boundary && (i == 0 || i + 1 == n)
                         ? boundary_edge_point(from.point, from.ring[i])
                         : interior_edge_point(from.point, from.ring[i], from.ring[i == 0 ? n - 1 : i - 1],
                                               from.ring[i + 1 == n ? 0 : i + 1]);
    }
    edge_on_boundary_ = face.edge_on_boundary;
    for (std::size_t k = 0; k < 3; ++k) make_edge_corner(k);
  }

  RingedFace<N> subface(int which) const {
    RingedFace<N> result;
    result.weights = weights_;
    if (which == 3) {
      for (std::size_t k = 0; k < 3; ++k) result.corner[k] = edge_corner(k, 1);
      return result;  // its edges are inside
    }
    const std::size_t k = which, before = (k + 2) % 3;
    result.corner[0] = vertex_[k];
    result.corner[1] = edge_corner(k, 2);
    result.corner[2] = edge_corner(before, 0);
    result.edge_on_boundary = {edge_on_boundary_[k], false, edge_on_boundary_[before]};
    return result;
  }

 private:
  /// Ring of e_k from c_{k+1} on: c_{k+1}, e_{k+1}, e_{k-1}, c_k, then beyond the edge the edge points next
  /// to c_k and to c_{k+1}; on the boundary the first four are all.
  ///
  ///            .                  ring index  0: sub-face k+1   (e_k, c_{k+1}, e_{k+1})
  ///       e_{k-1} -- e_{k+1}                  1: the middle     (e_k, e_{k+1}, e_{k-1})
  ///       /   \     /   \                     2: sub-face k     (e_k, e_{k-1}, c_k)
  ///     c_k --- e_k --- c_{k+1}
  void make_edge_corner(std::size_t k) {
    const std::size_t after = (k + 1) % 3;
    const RingedCorner<N>&a = vertex_[k], &b = vertex_[after];
    auto& e = edge_[k];
    e.point = a.neighbour(0);
    e.on_boundary = edge_on_boundary_[k];
    e.ring = {b.point, b.neighbour(0), a.neighbour(1), a.point};
    if (!e.on_boundary) {
      e.ring.push_back(a.neighbour(-1));
      e.ring.push_back(b.neighbour(2));
    }
  }
  RingedCorner<N> edge_corner(std::size_t k, int ring_index) const {
    RingedCorner<N> result = edge_[k];
    result.ring_index = ring_index;
    return result;
  }

  std::array<RingedCorner<N>, 3> vertex_, edge_;
  std::array<bool, 3> edge_on_boundary_;
  Weights weights_;
};

}  // namespace limitcheck::reference
