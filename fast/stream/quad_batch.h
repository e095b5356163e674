// SPDX-License-Identifier: MIT
// Gathers the control points of a batch of quads into the lanes of a kernel's input.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>

#include "fast/mesh/adjacency.h"
#include "fast/stream/quad_layout.h"
#include "fast/stream/quad_rings.h"
#include "fast/stream/transpose.h"

namespace limitcheck::fast::row_stream {

namespace detail {

/// `count` contiguous numbers of each lane to one vector per number. The lanes that remain repeat the last.
template <class T>
void put_numbers(const T* const* from, int count, int lanes, T* out) {
  if (lanes % 4 == 0) {
    for (int lane = 0; lane < lanes; lane += 4)
      to_lanes<4, T>(from + lane, nullptr, count, lanes, out + lane);
  } else {
    for (int lane = 0; lane < lanes; ++lane) to_lanes<1, T>(from + lane, nullptr, count, lanes, out + lane);
  }
}

/// A block of one corner. corner[lane]: the half-edge that leaves the corner along the quad.
/// Returns whether some ring is open.
template <class T>
bool put_corner(const QuadAdjacency& adjacency, const BasicQuadRings<T>& rings, const std::int32_t* corner,
                int depth, int lanes, T* block, int& period) {
  using Block = QuadCornerBlock;
  const T* from[kMaxLanes];
  std::int32_t vertex[kMaxLanes] = {};
  bool open = false;
  for (int lane = 0; lane < lanes; ++lane) {
    vertex[lane] = adjacency.origin(corner[lane]);
    from[lane] = rings.head(vertex[lane]);
  }
  put_numbers(from, Block::kHead, lanes, block);

  const int width = quad_window_width(depth);
  period = rings.ring(vertex[0]).entries;
  for (int lane = 0; lane < lanes; ++lane) {
    const auto ring = rings.ring(vertex[lane]);
    open = open || ring.open;
    if (ring.entries != period) period = 0;
  }
  if (open || period > width) period = 0;
  T* out = block + Block::kWindow * lanes;
  if (period > 0) {
    for (int lane = 0; lane < lanes; ++lane) {
      const std::int32_t first = 2 * rings.slot(corner[lane]) - 2;
      from[lane] = rings.numbers(vertex[lane]) + 3 * (first < 0 ? first + period : first);
    }
    put_numbers(from, 3 * period, lanes, out);
    return false;
  }

  T window[kMaxLanes][3 * quad_window_width(kMaxDepth) + 4];
  for (int lane = 0; lane < lanes; ++lane) {
    const auto ring = rings.ring(vertex[lane]);
    const T* numbers = rings.numbers(vertex[lane]);
    const std::int32_t first = 2 * rings.slot(corner[lane]) - 2 - 2 * depth;
    from[lane] = window[lane];
    if (ring.open) {
      // Nothing beyond the ends of the ring is ever used; but it has to be finite.
      const T* centre = rings.head(vertex[lane]) + Block::kCentre;
      for (int t = 0; t < width; ++t) {
        const std::int32_t k = first + t;
        std::memcpy(window[lane] + 3 * t, k < 0 || k >= ring.entries ? centre : numbers + 3 * k,
                    3 * sizeof(T));
      }
      block[Block::kEnds * lanes + lane] = static_cast<T>(-first);
      block[(Block::kEnds + 1) * lanes + lane] = static_cast<T>(ring.entries - 1 - first);
    } else {
      std::int32_t k = first % ring.entries;
      if (k < 0) k += ring.entries;
      for (int t = 0; t < width;) {  // a ring is there twice
        const int run = std::min(width - t, ring.entries);
        std::memcpy(window[lane] + 3 * t, numbers + 3 * k, 3 * static_cast<std::size_t>(run) * sizeof(T));
        t += run;
      }
      block[Block::kEnds * lanes + lane] = block[(Block::kEnds + 1) * lanes + lane] = T(-1);
    }
  }
  put_numbers(from, 3 * width, lanes, out);
  return open;
}

/// Flags of one side, whose half-edges these are.
template <class T>
void put_side(const QuadAdjacency& adjacency, const BasicQuadRings<T>& rings, const std::int32_t* half_edge,
              int side, int lanes, QuadBatch<T>& batch) {
  T* sharp = batch.input + (quad_sharp_offset(batch.depth) + side) * lanes;
  T* polynomial = batch.input + (quad_polynomial_offset(batch.depth) + side) * lanes;
  bool any_sharp = false, any = false, all = true;
  for (int lane = 0; lane < lanes; ++lane) {
    const std::int32_t h = half_edge[lane];
    const bool is_sharp = adjacency.twin(h) < 0;
    const bool is = rings.regular(adjacency.origin(h)) && rings.regular(adjacency.target(h));
    sharp[lane] = T(is_sharp ? 1 : 0);
    polynomial[lane] = T(is ? 1 : 0);
    any_sharp = any_sharp || is_sharp, any = any || is, all = all && is;
  }
  batch.sharp |= static_cast<unsigned>(any_sharp) << side;
  batch.some_polynomial |= static_cast<unsigned>(any) << side;
  batch.all_polynomial |= static_cast<unsigned>(all) << side;
}

}  // namespace detail

/// Fills quad_input_size(depth) * lanes numbers, aligned to 64 bytes for the vector kernels, from 1 to `lanes`
/// quads for QuadStream; the lanes that remain repeat the last.
template <class T>
QuadBatch<T> gather_quads(const QuadAdjacency& adjacency, const BasicQuadRings<T>& rings,
                          std::span<const std::int32_t> faces, int depth, int lanes, T* input) {
  QuadBatch<T> batch{input, depth, {}};
  for (int k = 0; k < 4; ++k) {
    std::int32_t corner[kMaxLanes];
    for (int lane = 0; lane < lanes; ++lane)
      corner[lane] = 4 * faces[std::min(static_cast<std::size_t>(lane), faces.size() - 1)] + k;
    const bool open = detail::put_corner(adjacency, rings, corner, depth, lanes,
                                         input + k * quad_block_size(depth) * lanes, batch.period[k]);
    batch.open |= static_cast<unsigned>(open) << k;
    detail::put_side(adjacency, rings, corner, k, lanes, batch);
  }
  return batch;
}

/// The same for sides alone, each from the origin to the target of a half-edge: they lie where A B does.
template <class T>
QuadBatch<T> gather_sides(const QuadAdjacency& adjacency, const BasicQuadRings<T>& rings,
                          std::span<const std::int32_t> half_edges, int depth, int lanes, T* input) {
  QuadBatch<T> batch{input, depth, {}};
  std::int32_t corner[2][kMaxLanes];
  for (int lane = 0; lane < lanes; ++lane) {
    corner[0][lane] = half_edges[std::min(static_cast<std::size_t>(lane), half_edges.size() - 1)];
    corner[1][lane] = QuadAdjacency::next(corner[0][lane]);
  }
  for (int k = 0; k < 2; ++k) {
    const bool open = detail::put_corner(adjacency, rings, corner[k], depth, lanes,
                                         input + k * quad_block_size(depth) * lanes, batch.period[k]);
    batch.open |= static_cast<unsigned>(open) << k;
  }
  detail::put_side(adjacency, rings, corner[0], kAB, lanes, batch);
  return batch;
}

/// The same for regular quads and QuadPatch: kPatchSize * lanes numbers.
template <class T>
QuadBatch<T> gather_patches(const QuadAdjacency& adjacency, const BasicQuadRings<T>& rings,
                            std::span<const std::int32_t> faces, int depth, int lanes, T* input) {
  // Of the ring of each corner, where a run of entries begins, its length, and the points of the patch they are
  // (4 r + k): all around A, those beyond C, and the last one beyond B and D.
  struct Run {
    int corner, first, count;
    int at[8];
  };
  constexpr Run runs[] = {
      {0, 0, 8, {6, 10, 9, 8, 4, 0, 1, 2}}, {2, 3, 5, {7, 11, 15, 14, 13}}, {1, 5, 1, {3}}, {3, 5, 1, {12}}};
  std::int32_t face[kMaxLanes];
  for (int lane = 0; lane < lanes; ++lane)
    face[lane] = faces[std::min(static_cast<std::size_t>(lane), faces.size() - 1)];
  const T* from[kMaxLanes];
  alignas(64) T entries[24 * kMaxLanes];
  const auto put = [&](const T* source, int point) {
    std::copy_n(source, 3 * lanes, input + 3 * point * lanes);
  };
  for (const Run& run : runs) {
    for (int lane = 0; lane < lanes; ++lane) {
      const std::int32_t h = 4 * face[lane] + run.corner;
      const int k = (2 * rings.slot(h) + run.first) % 8;
      from[lane] = rings.numbers(adjacency.origin(h)) + 3 * k;
    }
    detail::put_numbers(from, 3 * run.count, lanes, entries);
    for (int k = 0; k < run.count; ++k) put(entries + 3 * k * lanes, run.at[k]);
  }
  for (int corner = 0; corner < 4; ++corner) {
    for (int lane = 0; lane < lanes; ++lane)
      from[lane] = rings.head(adjacency.origin(4 * face[lane] + corner)) + QuadCornerBlock::kLimit;
    detail::put_numbers(from, 6, lanes, input + (kPatchLimits + 6 * corner) * lanes);
  }
  for (int lane = 0; lane < lanes; ++lane)
    from[lane] = rings.head(adjacency.origin(4 * face[lane])) + QuadCornerBlock::kCentre;
  detail::put_numbers(from, 3, lanes, entries);
  put(entries, 5);
  return {input, depth, {}};
}

}  // namespace limitcheck::fast::row_stream
