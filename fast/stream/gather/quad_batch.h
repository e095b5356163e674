// SPDX-License-Identifier: MIT
// Gathers the control points of a batch of quads into the lanes of a kernel's input.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "fast/mesh/adjacency.h"
#include "fast/stream/gather/batch.h"
#include "fast/stream/gather/quad_rings.h"
#include "fast/stream/kernel/layout.h"

namespace limitcheck::fast::row_stream {

namespace detail {

/// A block of one corner; corner[lane] is its place in the rings. Returns whether some ring is open.
template <class T>
bool put_corner(const BasicQuadRings<T>& rings, const typename BasicQuadRings<T>::Corner* const* corner,
                int depth, int lanes, T* block, int& period) {
  using Block = QuadCornerBlock;
  const T* from[kMaxLanes] = {};
  bool open = false;
  period = corner[0]->entries;
  for (int lane = 0; lane < lanes; ++lane) {
    from[lane] = rings.head(corner[lane]->vertex);
    open = open || corner[lane]->open;
    if (corner[lane]->entries != period) period = 0;
  }
  to_lanes<T>(from, Block::kHead, nullptr, lanes, block);

  const int width = quad_window_width(depth);
  if (open || period > width) period = 0;
  T* out = block + Block::kWindow * lanes;
  if (period > 0) {
    for (int lane = 0; lane < lanes; ++lane) from[lane] = rings.numbers() + corner[lane]->before;
    to_lanes<T>(from, 3 * period, nullptr, lanes, out);
    return false;
  }

  T window[kMaxLanes][3 * quad_window_width(kMaxDepth) + 4];
  for (int lane = 0; lane < lanes; ++lane) {
    const auto& at = *corner[lane];
    const std::int32_t ring = rings.ring(at.vertex).first;
    const T* numbers = rings.numbers() + ring;
    const std::int32_t before = at.before < 0 ? -2 : (at.before - ring) / 3, first = before - 2 * depth;
    from[lane] = window[lane];
    if (at.open) {
      // Nothing beyond the ends of the ring is ever used; but it has to be finite.
      const T* centre = rings.head(at.vertex) + Block::kCentre;
      for (int t = 0; t < width; ++t) {
        const std::int32_t k = first + t;
        std::copy_n(k < 0 || k >= at.entries ? centre : numbers + 3 * k, 3, window[lane] + 3 * t);
      }
      block[Block::kEnds * lanes + lane] = static_cast<T>(-first);
      block[(Block::kEnds + 1) * lanes + lane] = static_cast<T>(at.entries - 1 - first);
    } else {
      std::int32_t k = first % at.entries;
      if (k < 0) k += at.entries;
      for (int t = 0; t < width;) {  // a ring is there twice
        const int run = std::min(width - t, at.entries);
        std::copy_n(numbers + 3 * k, 3 * run, window[lane] + 3 * t);
        t += run;
      }
      block[Block::kEnds * lanes + lane] = block[(Block::kEnds + 1) * lanes + lane] = T(-1);
    }
  }
  to_lanes<T>(from, 3 * width, nullptr, lanes, out);
  return open;
}

/// How the centres of the corners that are darts move.
template <class T>
void put_darts(const BasicQuadRings<T>& rings, const typename BasicQuadRings<T>::Corner* const* corner, int k,
               int lanes, QuadBatch<T>& batch) {
  T* out = batch.input + (quad_dart_offset(batch.depth) + k * quad_dart_size(batch.depth)) * lanes;
  for (int lane = 0; lane < lanes; ++lane) {
    const auto* moves = rings.dart(corner[lane]->vertex);
    if (moves != nullptr) batch.darts |= 1u << k;
    out[lane] = T(moves != nullptr ? 1 : 0);
    for (int t = 0; t < 3 * batch.depth; ++t)
      out[(1 + t) * lanes + lane] = moves != nullptr ? (*moves)[t / 3][t % 3] : T(0);
  }
}

/// Flags of one side, which begins at these corners.
template <class T>
void put_side(const typename BasicQuadRings<T>::Corner* const* corner, int side, int lanes,
              QuadBatch<T>& batch) {
  unsigned sharp = 0, polynomial = 0, both = ~0u;
  for (int lane = 0; lane < lanes; ++lane) {
    sharp |= static_cast<unsigned>(corner[lane]->sharp);
    polynomial |= static_cast<unsigned>(corner[lane]->polynomial);
    both &= static_cast<unsigned>(corner[lane]->polynomial);
  }
  batch.sharp |= sharp << side;
  batch.some_polynomial |= polynomial << side;
  batch.all_polynomial |= (both & 1) << side;
  T* flags = batch.input + (quad_sharp_offset(batch.depth) + side) * lanes;
  for (int lane = 0; sharp != 0 && lane < lanes; ++lane) flags[lane] = T(corner[lane]->sharp ? 1 : 0);
  flags = batch.input + (quad_polynomial_offset(batch.depth) + side) * lanes;
  for (int lane = 0; polynomial != 0 && lane < lanes; ++lane)
    flags[lane] = T(corner[lane]->polynomial ? 1 : 0);
}

/// Corners and sides from A and A B on; half_edge(k, i): that of quad or side i of `size` which leaves at corner k.
template <class T, class HalfEdge>
QuadBatch<T> gather_corners(const BasicQuadRings<T>& rings, int count, const HalfEdge& half_edge,
                            std::size_t size, int depth, int lanes, T* input) {
  QuadBatch<T> batch{input, depth, {}};
  const typename BasicQuadRings<T>::Corner* corner[kMaxLanes] = {};
  for (int k = 0; k < count; ++k) {
    for (int lane = 0; lane < lanes; ++lane)
      corner[lane] = &rings.corner(half_edge(k, std::min(static_cast<std::size_t>(lane), size - 1)));
    const bool open =
        put_corner(rings, corner, depth, lanes, input + k * quad_block_size(depth) * lanes, batch.period[k]);
    batch.open |= static_cast<unsigned>(open) << k;
    if (open) put_darts(rings, corner, k, lanes, batch);
    put_side(corner, k, lanes, batch);
  }
  return batch;
}

}  // namespace detail

/// Fills quad_input_size(depth) * lanes numbers, aligned to 64 bytes for the vector kernels, from 1 to
/// `lanes` quads for QuadStream; the lanes that remain repeat the last.
template <class T>
QuadBatch<T> gather_quads(const BasicQuadRings<T>& rings, std::span<const std::int32_t> faces, int depth,
                          int lanes, T* input, Order order = Order::kFromA) {
  const auto half_edge = [&](int k, std::size_t i) {
    return 4 * faces[i] + (k + static_cast<int>(order)) % 4;
  };
  return detail::gather_corners(rings, 4, half_edge, faces.size(), depth, lanes, input);
}

/// The same for sides alone, each from the origin to the target of a half-edge: they lie where A B does.
template <class T>
QuadBatch<T> gather_sides(const BasicQuadRings<T>& rings, std::span<const std::int32_t> half_edges, int depth,
                          int lanes, T* input) {
  const auto half_edge = [&](int k, std::size_t i) {
    return k == 0 ? half_edges[i] : QuadAdjacency::next(half_edges[i]);
  };
  return detail::gather_corners(rings, 2, half_edge, half_edges.size(), depth, lanes, input);
}

/// The same for regular quads and QuadPatch: kPatchSize * lanes numbers.
template <class T>
QuadBatch<T> gather_patches(const BasicQuadRings<T>& rings, std::span<const std::int32_t> faces, int depth,
                            int lanes, T* input, Order order = Order::kFromA) {
  // Of the ring of each corner from e_{k-1} on, where a run of entries begins, its length, and the points of
  // the patch they are (4 r + k): all around A, those beyond C, and the last one beyond B and D.
  struct Run {
    int corner, first, count;
    int at[8];
  };
  constexpr Run runs[] = {
      {0, 0, 8, {1, 2, 6, 10, 9, 8, 4, 0}}, {2, 5, 5, {7, 11, 15, 14, 13}}, {1, 7, 1, {3}}, {3, 7, 1, {12}}};
  const auto half_edge = [&](int lane, int corner) {
    return 4 * faces[std::min(static_cast<std::size_t>(lane), faces.size() - 1)] +
           (corner + static_cast<int>(order)) % 4;
  };
  const T* from[kMaxLanes] = {};
  alignas(64) T entries[24 * kMaxLanes];
  const auto put = [&](const T* source, int point) {
    std::copy_n(source, 3 * lanes, input + 3 * point * lanes);
  };
  for (const Run& run : runs) {
    for (int lane = 0; lane < lanes; ++lane)
      from[lane] = rings.numbers() + rings.corner(half_edge(lane, run.corner)).before + 3 * run.first;
    to_lanes<T>(from, 3 * run.count, nullptr, lanes, entries);
    for (int k = 0; k < run.count; ++k) put(entries + 3 * k * lanes, run.at[k]);
  }
  for (int corner = 0; corner < 4; ++corner) {
    for (int lane = 0; lane < lanes; ++lane)
      from[lane] = rings.head(rings.corner(half_edge(lane, corner)).vertex) + QuadCornerBlock::kLimit;
    to_lanes<T>(from, 6, nullptr, lanes, input + (kPatchLimits + 6 * corner) * lanes);
  }
  for (int lane = 0; lane < lanes; ++lane)
    from[lane] = rings.head(rings.corner(half_edge(lane, 0)).vertex) + QuadCornerBlock::kCentre;
  to_lanes<T>(from, 3, nullptr, lanes, entries);
  put(entries, 5);
  return {input, depth, {}};
}

}  // namespace limitcheck::fast::row_stream
