// SPDX-License-Identifier: MIT
// Gathers the control points of a batch of grids into the lanes of a kernel's input.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "fast/mesh/adjacency.h"
#include "fast/plan/pairing.h"
#include "fast/stream/gather/rings.h"
#include "fast/stream/kernel/layout.h"
#include "fast/stream/kernel/output_targets.h"

namespace limitcheck::fast::row_stream {

/// out[k * lanes + lane] = from[lane][k] - origin[(k % 3) * lanes + lane], k < count; origin may be null. Four numbers
/// are readable from any pointer; the vectors of out and origin are aligned.
template <class T>
void to_lanes(const T* const* from, int count, const T* origin, int lanes, T* out) {
  if constexpr (std::is_same_v<T, float>) {
    if (lanes % 4 == 0) return float_lanes(from, count, origin, lanes, out);
  }
  for (int lane = 0; lane < lanes; ++lane) {
    for (int k = 0; k < count; ++k)
      out[k * lanes + lane] = origin ? from[lane][k] - origin[k % 3 * lanes + lane] : from[lane][k];
  }
}

/// At which corner of a grid its rows and columns begin: A, or C half a turn on. The points and their bits
/// are the same, in the opposite order.
enum class Order : std::uint8_t { kFromA = 0, kFromC = 2 };

namespace detail {

// The half-edges that leave at a corner of the grids of a batch, and where the window of depth 0 begins, counted in the
// ring from the point to which they lead.
struct Corners {
  std::array<std::int32_t, kMaxLanes> half_edge;
  int first;
};

// Corner blocks, with windows of `width` entries. With an origin of its own a grid or edge wants differences from the
// corner; they are exact or nearly so.
template <class N>
void put_corners(const BasicLoopRings<N>& rings, const Corners& corners, int width, int depth, int lanes,
                 typename N::Scalar* out) {
  using T = typename N::Scalar;
  const T *head[kMaxLanes] = {}, *window[kMaxLanes] = {};
  const int first = corners.first - depth;
  for (int lane = 0; lane < lanes; ++lane) {
    const auto& at = rings.corner(corners.half_edge[lane]);
    head[lane] = rings.numbers() + 3 * static_cast<std::ptrdiff_t>(at.head);
    window[lane] = rings.numbers() + 3 * (static_cast<std::ptrdiff_t>(at.entry) + first);
  }
  to_lanes<T>(head, CornerBlock::kWindow, nullptr, lanes, out);
  const T* const origin =
      rings.placement().has_local_origin(depth) ? out + CornerBlock::kCentre * lanes : nullptr;
  out += CornerBlock::kWindow * lanes;
  if (rings.reaches(depth)) return to_lanes<T>(window, 3 * width, origin, lanes, out);
  const Adjacency& adjacency = rings.adjacency();
  for (int lane = 0; lane < lanes; ++lane) {  // round a closed ring, often more than once
    const std::int32_t v = adjacency.origin(corners.half_edge[lane]);
    const T* const ring = head[lane] + 3 * (BasicLoopRings<N>::kHeadPoints + BasicLoopRings<N>::kReach);
    const int n = adjacency.valence(v), start = static_cast<int>((window[lane] - ring) / 3) % n + n;
    for (int k = 0; k < 3 * width; ++k) {
      const T& x = adjacency.on_boundary(v) ? window[lane][k] : ring[3 * ((start + k / 3) % n) + k % 3];
      out[k * lanes + lane] = origin ? x - origin[k % 3 * lanes + lane] : x;
    }
  }
}

// Where a singleton without neighbour has no fourth corner: the ghost across its diagonal, and nothing around
// it that matters.
template <class N>
void put_ghost(const BasicLoopRings<N>& rings, std::int32_t ac, int corner, int depth, int lanes,
               typename N::Scalar* out) {
  using T = typename N::Scalar;
  const T* const p = rings.numbers() + 3 * (static_cast<std::ptrdiff_t>(rings.corner(ac).entry) - 1);
  for (int k = 0; k < 2; ++k) out[k * lanes] = T(0);
  for (int k = CornerBlock::kCentre; k < CornerBlock::kWindow + 3 * window_width(corner, depth); ++k)
    out[k * lanes] = k >= CornerBlock::kWindow && rings.placement().has_local_origin(depth)
                         ? T(0)
                         : p[(k - CornerBlock::kCentre) % 3];
}

}  // namespace detail

/// Fills input_size(depth) * lanes numbers, aligned to 64 bytes for the vector kernels, from 1 to `lanes`
/// grids; the lanes that remain repeat the last grid. A singleton without neighbour gets ghosts for its dummy
/// partner.
template <class N>
void gather(const BasicLoopRings<N>& rings, std::span<const Grid> grids, int depth, int lanes,
            typename N::Scalar* input, Order order = Order::kFromA) {
  detail::Corners corners[4] = {{{}, -2}, {{}, -1}, {{}, -1}, {{}, -1}};
  bool ghost[kMaxLanes];
  for (int lane = 0; lane < lanes; ++lane) {
    const Grid& grid = grids[std::min(static_cast<std::size_t>(lane), grids.size() - 1)];
    // A singleton without neighbour may be cut along any edge.
    const std::int32_t ac = 3 * grid.face0 + std::max(grid.edge0, 0), da = Adjacency::prev(ac),
                       ca = grid.singleton() ? rings.adjacency().twin(ac) : 3 * grid.face1 + grid.edge1;
    ghost[lane] = ca < 0;
    corners[kA].half_edge[lane] = ac;
    corners[kB].half_edge[lane] = ca < 0 ? da : Adjacency::prev(ca);
    corners[kC].half_edge[lane] = Adjacency::next(ac);
    corners[kD].half_edge[lane] = da;
  }
  const auto block = [&](int corner) {
    return input + (corner ^ static_cast<int>(order)) * corner_block_size(depth) * lanes;
  };
  for (const int k : {kA, kB, kC, kD})
    detail::put_corners(rings, corners[k], window_width(k, depth), depth, lanes, block(k));
  for (int lane = 0; lane < lanes; ++lane) {
    if (ghost[lane])
      detail::put_ghost(rings, corners[kA].half_edge[lane], kB, depth, lanes, block(kB) + lane);
  }
}

/// The same for control edges, each from the origin to the target of a half-edge: edge_input_size(depth) *
/// lanes numbers.
template <class N>
void gather_edges(const BasicLoopRings<N>& rings, std::span<const std::int32_t> half_edges, int depth,
                  int lanes, typename N::Scalar* input) {
  detail::Corners p{{}, -1}, q{{}, 0};  // Q's ring: from the left neighbour, which comes before P
  for (int lane = 0; lane < lanes; ++lane) {
    const std::int32_t h = half_edges[std::min(static_cast<std::size_t>(lane), half_edges.size() - 1)];
    p.half_edge[lane] = h, q.half_edge[lane] = Adjacency::next(h);
  }
  const int width = edge_window_width(depth);
  detail::put_corners(rings, p, width, depth, lanes, input);
  detail::put_corners(rings, q, width, depth, lanes, input + edge_block_size(depth) * lanes);
}

}  // namespace limitcheck::fast::row_stream
