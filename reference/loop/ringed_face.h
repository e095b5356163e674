// SPDX-License-Identifier: MIT
// A triangle with the rings of its corners: all that repeated subdivision of one face needs.
#pragma once

#include <array>
#include <boost/container/small_vector.hpp>
#include <deque>
#include <functional>
#include <mutex>
#include <span>
#include <vector>

#include "reference/loop/vertex_limit.h"
#include "reference/mesh/topology.h"

namespace limitcheck::reference {

template <class Point>
class SteppedFan;

/// A corner with its ring, counter-clockwise, boundary neighbours first and last (masks.h). The face lies
/// between ring entries `ring_index` and `ring_index` + 1 (cyclically when interior).
///   Point   a Vec3, or the index of one
template <class Point>
struct RingedCorner {
  Point point{};
  boost::container::small_vector<Point, 6> ring;
  int ring_index = 0;
  bool on_boundary = false;
  VertexState state = VertexState::kOrdinary;
  const SteppedFan<Point>* fan =
      nullptr;  ///< then the ring is neighbours -1 to 2 alone, after so many steps of it
  int steps = 0, index_in_fan = 0;

  int size() const { return static_cast<int>(ring.size()); }
  /// Neighbour i steps counter-clockwise from the face's first edge; i may be negative.
  const Point& neighbour(int i) const {
    const int at = ring_index + i;
    return ring[on_boundary ? at : (at + size()) % size()];
  }
  std::span<const Point> span() const { return {ring.data(), ring.size()}; }
  bool is_regular() const {
    return is_regular_vertex(ring.size() - (on_boundary ? 1 : 0), on_boundary, state);
  }
};

/// An interior vertex of many faces without tags, and its ring, after each step: worked out once for all faces, where
/// each by itself would take as long as there are faces. Any number of threads may ask at once.
template <class N>
class SteppedFan<Vec3<N>> {
 public:
  static constexpr std::size_t kMany = 200;  ///< faces, for which this is worth its memory
  struct Step {
    Vec3<N> point;
    std::vector<Vec3<N>> ring;
    VertexLimit<N> limit;
  };

  SteppedFan(const Vec3<N>& point, std::vector<Vec3<N>> ring, Weights weights) : weights_(weights) {
    add(point, std::move(ring));
  }
  const Step& after(int steps) const {
    const std::scoped_lock lock(mutex_);
    while (steps_.size() <= static_cast<std::size_t>(steps)) {
      Vec3<N> point = steps_.back().point;
      std::vector<Vec3<N>> ring = steps_.back().ring;
      subdivide_ring(point, ring, false, weights_);
      add(point, std::move(ring));
    }
    return steps_[static_cast<std::size_t>(steps)];
  }
  /// The corner of the face between ring entries `index` and `index` + 1.
  RingedCorner<Vec3<N>> corner(int index, int steps) const {
    const Step& step = after(steps);
    const std::size_t n = step.ring.size(), at = static_cast<std::size_t>(index) + n;
    RingedCorner<Vec3<N>> result;
    result.point = step.point;
    for (std::size_t i = at - 1; i < at + 3; ++i) result.ring.push_back(step.ring[i % n]);
    result.ring_index = 1;
    result.fan = this, result.steps = steps, result.index_in_fan = index;
    return result;
  }

 private:
  void add(const Vec3<N>& point, std::vector<Vec3<N>> ring) const {
    steps_.push_back({point, std::move(ring), {}});
    Step& step = steps_.back();
    if constexpr (requires { NumberTraits<N>::kNormalThreshold; })  // fractions have no normals
      step.limit = vertex_limit<N>(step.point, step.ring, false, weights_);
  }

  Weights weights_;
  mutable std::mutex mutex_;
  mutable std::deque<Step> steps_;  // each stays where it is
};

template <class Point>
struct RingedFace {
  std::array<RingedCorner<Point>, 3> corner;
  std::array<bool, 3> edge_on_boundary{};  ///< edge k from corner k to k + 1

  bool is_regular() const {
    return corner[0].is_regular() && corner[1].is_regular() && corner[2].is_regular();
  }

  /// The twelve points of a regular face in the order of Appendix A. Two linear ghosts complete the ring of a
  /// boundary vertex; a held vertex of one face has four, the last two by reflection in it.   [D10]
  ///   ghost   ghost_point of three points
  template <class Ghost>
  std::array<Point, 12> patch(Ghost&& ghost) const {
    std::array<std::array<Point, 6>, 3> rings;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& c = corner[k];
      std::array<Point, 6> full;
      for (std::size_t i = 0; i < c.ring.size(); ++i) full[i] = c.ring[i];
      if (c.state == VertexState::kHeld) {
        full[2] = ghost(c.point, c.ring[1], c.ring[0]);
        full[3] = ghost(c.point, c.point, c.ring[0]);
        full[4] = ghost(c.point, c.point, c.ring[1]);
        full[5] = ghost(c.point, c.ring[0], c.ring[1]);
      } else if (c.on_boundary) {
        full[4] = ghost(c.point, c.ring[3], c.ring[2]);
        full[5] = ghost(c.point, c.ring[0], c.ring[1]);
      }
      for (std::size_t i = 0; i < 6; ++i) rings[k][i] = full[(i + c.ring_index) % 6];
    }
    const auto& [a, b, c] = rings;
    return {a[4], a[3], a[5], corner[0].point, a[2], b[3], a[0], a[1], c[4], b[4], b[5], c[3]};
  }
};

/// The face of a mesh of triangles with its neighbourhood; point(v) is that of a vertex.
///   states   of the vertices; later ones, and all where there are none, are ordinary
///   fan_of   of a vertex; nullptr: the corner has all of its ring
template <class Point, class PointOf>
RingedFace<Point> gather_triangle(const Topology& topology, std::size_t face, PointOf&& point,
                                  std::span<const VertexState> states = {},
                                  const std::function<const SteppedFan<Point>*(std::int32_t)>& fan_of = {}) {
  RingedFace<Point> result;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int32_t v = topology.faces()[face][k];
    const Sector sector = topology.sector(v);
    auto& c = result.corner[k];
    result.edge_on_boundary[k] = topology.edges()[topology.edge(face, k)].on_boundary();
    if constexpr (requires { &SteppedFan<Point>::corner; })
      if (const auto* fan = fan_of ? fan_of(v) : nullptr) {
        c = fan->corner(topology.ring_index(face, k), 0);
        continue;
      }
    c.point = point(v);
    c.state = state_of(states, v);
    c.on_boundary = !sector.closed;
    c.ring_index = topology.ring_index(face, k);
    for (const std::int32_t r : sector.neighbours) c.ring.push_back(point(r));
  }
  return result;
}
template <class N>
RingedFace<Vec3<N>> gather_triangle(
    const Topology& topology, const std::vector<Vec3<N>>& positions, std::size_t face,
    std::span<const VertexState> states = {},
    const std::function<const SteppedFan<Vec3<N>>*(std::int32_t)>& fan_of = {}) {
  return gather_triangle<Vec3<N>>(
      topology, face, [&](std::int32_t v) { return positions[static_cast<std::size_t>(v)]; }, states, fan_of);
}

/// A face's corners after one step, from which its four sub-faces are put together. Sub-face k < 3 sits at
/// corner k, (c_k, e_k, e_{k-1}); sub-face 3 is the middle one, (e_0, e_1, e_2); e_k is the edge point of
/// edge k.
template <class N>
class SubdividedFace {
 public:
  explicit SubdividedFace(const RingedFace<Vec3<N>>& face, Weights weights = Weights::kLoop) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& from = face.corner[k];
      auto& to = vertex_[k];
      if (from.fan != nullptr) {
        to = from.fan->corner(from.index_in_fan, from.steps + 1);
        continue;
      }
      to.ring_index = from.ring_index;
      to.on_boundary = from.on_boundary;
      to.state = from.state;
      const std::size_t n = from.ring.size();
      to.point = vertex_point<N>(from.point, from.span(), from.on_boundary, from.state, weights);
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

  RingedFace<Vec3<N>> subface(int which) const {
    RingedFace<Vec3<N>> result;
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
    const RingedCorner<Vec3<N>>&a = vertex_[k], &b = vertex_[after];
    auto& e = edge_[k];
    e.point = a.neighbour(0);
    e.on_boundary = edge_on_boundary_[k];
    e.ring = {b.point, b.neighbour(0), a.neighbour(1), a.point};
    if (!e.on_boundary) {
      e.ring.push_back(a.neighbour(-1));
      e.ring.push_back(b.neighbour(2));
    }
  }
  RingedCorner<Vec3<N>> edge_corner(std::size_t k, int ring_index) const {
    RingedCorner<Vec3<N>> result = edge_[k];
    result.ring_index = ring_index;
    return result;
  }

  std::array<RingedCorner<Vec3<N>>, 3> vertex_, edge_;
  std::array<bool, 3> edge_on_boundary_;
};

}  // namespace limitcheck::reference
