// SPDX-License-Identifier: MIT
// Gathers the control points of a batch of pairs into the lanes of a kernel's input.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "fast/adjacency.h"
#include "fast/pairing.h"
#include "fast/row_stream/layout.h"
#include "fast/row_stream/rings.h"

namespace limitcheck::fast::row_stream {

/// Fills input_size(depth) * lanes numbers, aligned to 64 bytes for the vector kernels, from 1 to `lanes`
/// pairs; the lanes that remain repeat the last pair. A singleton without neighbour gets ghosts for its dummy
/// partner.
template <class N>
void gather(const Adjacency& adjacency, const BasicRings<N>& rings, std::span<const Pair> pairs, int depth,
            int lanes, typename N::Scalar* input);

/// The same for control edges, each from the origin to the target of a half-edge: edge_input_size(depth) *
/// lanes.
template <class N>
void gather_edges(const Adjacency& adjacency, const BasicRings<N>& rings,
                  std::span<const std::int32_t> half_edges, int depth, int lanes, typename N::Scalar* input);

namespace detail {

// A corner's vertex, and the index in its ring of core entry 0 (the first of the pair's own points).
struct Place {
  std::int32_t vertex;
  std::int32_t core;
};

template <class N>
void put_corner(const BasicRings<N>& rings, Place place, int width, int depth, int lanes,
                typename N::Scalar* out) {
  using T = typename N::Scalar;
  const auto& head = rings.corner(place.vertex).head;
  for (std::size_t k = 0; k < head.size(); ++k) out[static_cast<int>(k) * lanes] = head[k];

  const auto ring = rings.ring(place.vertex);
  const std::int32_t* entries = rings.entries().data() + ring.first;
  std::int32_t at = place.core - 1 - depth;
  if (ring.period != BasicRings<N>::kOpen) {
    while (at < 0) at += ring.period;
  }
  // With an origin of its own a pair or edge wants differences from the corner; they are exact or nearly so.
  const ControlPoint<T> nothing{};
  const ControlPoint<T>& from =
      has_local_origin(depth) ? rings.points()[static_cast<std::size_t>(place.vertex)] : nothing;
  out += CornerBlock::kWindow * lanes;
  for (int t = width; t > 0; --t, out += 3 * lanes) {
    const ControlPoint<T>& p = rings.points()[static_cast<std::size_t>(entries[at])];
    for (int c = 0; c < 3; ++c)
      out[c * lanes] = p[static_cast<std::size_t>(c)] - from[static_cast<std::size_t>(c)];
    if (++at == ring.period) at = 0;
  }
}

// Where a singleton without neighbour has no fourth corner: the ghost across its diagonal, and nothing around
// it that matters.
template <class N>
void put_ghost(const BasicRings<N>& rings, Place a, int corner, int depth, int lanes,
               typename N::Scalar* out) {
  using T = typename N::Scalar;
  const auto ring = rings.ring(a.vertex);
  const std::int32_t ghost = rings.entries()[static_cast<std::size_t>(ring.first + a.core)];
  const ControlPoint<T>& p = rings.points()[static_cast<std::size_t>(ghost)];
  for (int k = 0; k < 2; ++k) out[k * lanes] = T(0);
  for (int k = CornerBlock::kCentre; k < CornerBlock::kWindow + 3 * window_width(corner, depth); ++k)
    out[k * lanes] = k >= CornerBlock::kWindow && has_local_origin(depth)
                         ? T(0)
                         : p[static_cast<std::size_t>((k - CornerBlock::kCentre) % 3)];
}

}  // namespace detail

template <class N>
void gather(const Adjacency& adjacency, const BasicRings<N>& rings, std::span<const Pair> pairs, int depth,
            int lanes, typename N::Scalar* input) {
  using detail::Place;
  for (int lane = 0; lane < lanes; ++lane) {
    const Pair& pair = pairs[std::min(static_cast<std::size_t>(lane), pairs.size() - 1)];
    // A singleton without neighbour may be cut along any edge.
    const std::int32_t ac = 3 * pair.face0 + (pair.edge0 < 0 ? 0 : pair.edge0);
    const std::int32_t cd = Adjacency::next(ac), da = Adjacency::prev(ac), ca = adjacency.twin(ac);
    const auto put = [&](int corner, Place place) {
      detail::put_corner(rings, place, window_width(corner, depth), depth, lanes,
                         input + corner * corner_block_size(depth) * lanes + lane);
    };
    const Place a{adjacency.origin(ac), rings.slot(ac) - 1};
    put(kA, a);
    put(kC, {adjacency.origin(cd), rings.slot(cd)});
    put(kD, {adjacency.origin(da), rings.slot(da)});
    if (ca < 0) {
      detail::put_ghost(rings, a, kB, depth, lanes, input + kB * corner_block_size(depth) * lanes + lane);
    } else {
      const std::int32_t bc = Adjacency::prev(ca);
      put(kB, {adjacency.origin(bc), rings.slot(bc)});
    }
  }
}

template <class N>
void gather_edges(const Adjacency& adjacency, const BasicRings<N>& rings,
                  std::span<const std::int32_t> half_edges, int depth, int lanes, typename N::Scalar* input) {
  const int width = edge_window_width(depth);
  for (int lane = 0; lane < lanes; ++lane) {
    const std::int32_t h = half_edges[std::min(static_cast<std::size_t>(lane), half_edges.size() - 1)];
    // From Q to the left neighbour, which comes before P in Q's ring.
    const std::int32_t after = Adjacency::next(h);
    detail::put_corner(rings, {adjacency.origin(h), rings.slot(h)}, width, depth, lanes, input + lane);
    detail::put_corner(rings, {adjacency.origin(after), rings.slot(after) + 1}, width, depth, lanes,
                       input + edge_block_size(depth) * lanes + lane);
  }
}

}  // namespace limitcheck::fast::row_stream
