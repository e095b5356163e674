// SPDX-License-Identifier: MIT
// Gathers the control points of a batch of grids into the lanes of a kernel's input.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <type_traits>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "fast/mesh/adjacency.h"
#include "fast/plan/pairing.h"
#include "fast/stream/gather/rings.h"
#include "fast/stream/kernel/layout.h"

namespace limitcheck::fast::row_stream {

/// out[k * lanes + lane] = from[lane][k] - origin[lane][k], k < count, lane < group; origin may be null. At
/// least four numbers must be readable behind each pointer; with group = 4, out is aligned to 16 bytes.
template <int group, class T>
void to_lanes(const T* const* from, const T* const* origin, int count, int lanes, T* out) {
#if defined(__SSE2__)
  if constexpr (group == 4 && std::is_same_v<T, float>) {
    for (int k = 0; k < count; k += 4) {
      const int first = k + 4 > count && count > 4 ? count - 4 : k;  // the last four may overlap
      __m128 v[4];
      for (int i = 0; i < 4; ++i) {
        v[i] = _mm_loadu_ps(from[i] + first);
        if (origin) v[i] = _mm_sub_ps(v[i], _mm_loadu_ps(origin[i] + first));
      }
      _MM_TRANSPOSE4_PS(v[0], v[1], v[2], v[3]);
      for (int i = 0; i < 4 && first + i < count; ++i) _mm_store_ps(out + (first + i) * lanes, v[i]);
    }
    return;
  }
#endif
  for (int lane = 0; lane < group; ++lane) {
    for (int k = 0; k < count; ++k)
      out[k * lanes + lane] = origin ? from[lane][k] - origin[lane][k] : from[lane][k];
  }
}

/// At which corner of a grid its rows and columns begin: A, or C half a turn on. The points and their bits
/// are the same, in the opposite order.
enum class Order : std::uint8_t { kFromA = 0, kFromC = 2 };

/// Fills input_size(depth) * lanes numbers, aligned to 64 bytes for the vector kernels, from 1 to `lanes`
/// grids; the lanes that remain repeat the last grid. A singleton without neighbour gets ghosts for its dummy
/// partner.
template <class N>
void gather(const Adjacency& adjacency, const BasicLoopRings<N>& rings, std::span<const Grid> grids,
            int depth, int lanes, typename N::Scalar* input, Order order = Order::kFromA);

/// The same for control edges, each from the origin to the target of a half-edge: edge_input_size(depth) *
/// lanes numbers.
template <class N>
void gather_edges(const Adjacency& adjacency, const BasicLoopRings<N>& rings,
                  std::span<const std::int32_t> half_edges, int depth, int lanes, typename N::Scalar* input);

namespace detail {

// A corner's vertex, and the index in its ring of core entry 0 (the first of the grid's own points).
struct CornerSlot {
  std::int32_t vertex;
  std::int32_t core;
};

// Corner blocks of `group` lanes, whose rings are walked side by side. With an origin of its own a grid or
// edge wants differences from the corner; they are exact or nearly so.
template <int group, class N>
void put_group(const BasicLoopRings<N>& rings, const CornerSlot* places, int width, int depth, int lanes,
               typename N::Scalar* out) {
  using T = typename N::Scalar;
  const T *head[group], *centre[group], *column[group];
  const std::int32_t* entries[group];
  std::int32_t at[group], period[group];
  const auto point = [points = rings.points().data()](std::int32_t k) { return points[k].data(); };
  for (int lane = 0; lane < group; ++lane) {
    const CornerSlot place = places[lane];
    head[lane] = rings.corner(place.vertex).head.data();
    centre[lane] = point(place.vertex);
    const auto ring = rings.ring(place.vertex);
    entries[lane] = rings.entries().data() + ring.first;
    period[lane] = ring.period;
    at[lane] = place.core - 1 - depth;
    if (ring.period != BasicLoopRings<N>::kOpen) {
      at[lane] %= ring.period;
      at[lane] += at[lane] < 0 ? ring.period : 0;
    }
  }
  to_lanes<group, T>(head, nullptr, CornerBlock::kWindow, lanes, out);
  out += CornerBlock::kWindow * lanes;
  for (int t = 0; t < width; ++t, out += 3 * lanes) {
    for (int lane = 0; lane < group; ++lane) {
      column[lane] = point(entries[lane][at[lane]]);
      const std::int32_t next = at[lane] + 1;
      at[lane] = next == period[lane] ? 0 : next;
    }
    to_lanes<group, T>(column, rings.placement().has_local_origin(depth) ? centre : nullptr, 3, lanes, out);
  }
}

template <class N>
void put_corners(const BasicLoopRings<N>& rings, const CornerSlot* places, int width, int depth, int lanes,
                 typename N::Scalar* out) {
  if (lanes % 4 == 0) {
    for (int lane = 0; lane < lanes; lane += 4)
      put_group<4>(rings, places + lane, width, depth, lanes, out + lane);
  } else {
    for (int lane = 0; lane < lanes; ++lane)
      put_group<1>(rings, places + lane, width, depth, lanes, out + lane);
  }
}

// Where a singleton without neighbour has no fourth corner: the ghost across its diagonal, and nothing around
// it that matters.
template <class N>
void put_ghost(const BasicLoopRings<N>& rings, CornerSlot a, int corner, int depth, int lanes,
               typename N::Scalar* out) {
  using T = typename N::Scalar;
  const auto ring = rings.ring(a.vertex);
  const std::int32_t ghost = rings.entries()[ring.first + a.core];
  const ControlPoint<T>& p = rings.points()[ghost];
  for (int k = 0; k < 2; ++k) out[k * lanes] = T(0);
  for (int k = CornerBlock::kCentre; k < CornerBlock::kWindow + 3 * window_width(corner, depth); ++k)
    out[k * lanes] = k >= CornerBlock::kWindow && rings.placement().has_local_origin(depth)
                         ? T(0)
                         : p[(k - CornerBlock::kCentre) % 3];
}

}  // namespace detail

template <class N>
void gather(const Adjacency& adjacency, const BasicLoopRings<N>& rings, std::span<const Grid> grids,
            int depth, int lanes, typename N::Scalar* input, Order order) {
  detail::CornerSlot places[4][kMaxLanes];
  bool ghost[kMaxLanes];
  for (int lane = 0; lane < lanes; ++lane) {
    const Grid& grid = grids[std::min(static_cast<std::size_t>(lane), grids.size() - 1)];
    // A singleton without neighbour may be cut along any edge.
    const std::int32_t ac = 3 * grid.face0 + (grid.edge0 < 0 ? 0 : grid.edge0);
    const std::int32_t cd = Adjacency::next(ac), da = Adjacency::prev(ac), ca = adjacency.twin(ac);
    places[kA][lane] = {adjacency.origin(ac), rings.slot(ac) - 1};
    places[kC][lane] = {adjacency.origin(cd), rings.slot(cd)};
    places[kD][lane] = {adjacency.origin(da), rings.slot(da)};
    ghost[lane] = ca < 0;
    const std::int32_t bc = ca < 0 ? da : Adjacency::prev(ca);
    places[kB][lane] = {adjacency.origin(bc), rings.slot(bc)};
  }
  const auto block = [&](int corner) {
    return input + (corner ^ static_cast<int>(order)) * corner_block_size(depth) * lanes;
  };
  for (const int corner : {kA, kB, kC, kD})
    detail::put_corners(rings, places[corner], window_width(corner, depth), depth, lanes, block(corner));
  for (int lane = 0; lane < lanes; ++lane) {
    if (ghost[lane]) detail::put_ghost(rings, places[kA][lane], kB, depth, lanes, block(kB) + lane);
  }
}

template <class N>
void gather_edges(const Adjacency& adjacency, const BasicLoopRings<N>& rings,
                  std::span<const std::int32_t> half_edges, int depth, int lanes, typename N::Scalar* input) {
  detail::CornerSlot p[kMaxLanes], q[kMaxLanes];
  for (int lane = 0; lane < lanes; ++lane) {
    const std::int32_t h = half_edges[std::min(static_cast<std::size_t>(lane), half_edges.size() - 1)];
    // From Q to the left neighbour, which comes before P in Q's ring.
    const std::int32_t after = Adjacency::next(h);
    p[lane] = {adjacency.origin(h), rings.slot(h)};
    q[lane] = {adjacency.origin(after), rings.slot(after) + 1};
  }
  const int width = edge_window_width(depth);
  detail::put_corners(rings, p, width, depth, lanes, input);
  detail::put_corners(rings, q, width, depth, lanes, input + edge_block_size(depth) * lanes);
}

}  // namespace limitcheck::fast::row_stream
