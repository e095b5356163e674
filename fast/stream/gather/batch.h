// SPDX-License-Identifier: MIT
// Gathers the control points of a batch of grids or quads into the lanes of a kernel's input.
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

/// out[k * lanes + lane] = from[lane][k], k < count. Four numbers are readable from any pointer; the vectors of out are
/// aligned.
template <class T>
void to_lanes(const T* const* from, int count, int lanes, T* out) {
  if constexpr (std::is_same_v<T, float>) {
    if (lanes % 4 == 0) return float_lanes(from, count, lanes, out);
  }
  for (int lane = 0; lane < lanes; ++lane)
    for (int k = 0; k < count; ++k) out[k * lanes + lane] = from[lane][k];
}

/// At which corner of a grid its rows and columns begin: A, or C half a turn on. The points and their bits
/// are the same, in the opposite order.
enum class Order : std::uint8_t { kFromA = 0, kFromC = 2 };

/// The control edges of a grid, by Part: half-edges along A B, B C, C D, D A; from C, along C D, D A, A B, B C; last
/// the diagonal A C, which quads have not. -1: there is no such edge to show.
struct GridEdges {
  GridEdges(const Adjacency& adjacency, const Grid& grid, Order order = Order::kFromA)
      : from_a(order == Order::kFromA) {
    const std::int32_t ac = 3 * grid.face0 + std::max(grid.edge0, 0), cd = Adjacency::next(ac),
                       da = Adjacency::prev(ac);
    const std::int32_t ca = grid.singleton() ? -1 : adjacency.twin(ac);
    const std::int32_t ab = ca < 0 ? -1 : Adjacency::next(ca), bc = ca < 0 ? -1 : Adjacency::prev(ca);
    of = {from_a ? ab : cd, from_a ? bc : da, from_a ? cd : ab, from_a ? da : bc, ac};
  }
  GridEdges(std::int32_t quad, Order order = Order::kFromA) : from_a(order == Order::kFromA) {
    for (int k = 0; k < 4; ++k) of[k] = 4 * quad + (k + static_cast<int>(order)) % 4;
    of[kAC] = -1;
  }
  bool from_a;
  std::array<std::int32_t, kInside> of;
};

/// Which edges of a grid are to be polynomials at a depth, see kPatchWindow: bit k for Part k.
template <class N>
unsigned regular_edges(const BasicLoopRings<N>& rings, const Grid& grid, int depth,
                       Order order = Order::kFromA) {
  if (depth < kLocalFrom) return 0;
  const GridEdges edges(rings.adjacency(), grid, order);
  unsigned regular = 0;
  for (int k = 0; k < kInside; ++k)
    if (edges.of[k] >= 0 && rings.is_regular(edges.of[k])) regular |= 1U << k;
  return regular;
}
inline constexpr unsigned kAllEdges = (1U << kInside) - 1;

/// Grids that go together best have the same rank: first regular ones, then those without a regular edge. More ranks would
/// make purer batches of grids that lie farther apart in memory.
inline constexpr std::size_t kRegularityRanks = 3;
inline std::size_t regularity_rank(unsigned regular) {
  return regular == kAllEdges ? 0 : regular == 0 ? 1 : 2;
}

/// The depth from which some part of a grid has an origin of its own.
inline int local_from(const LocalOrigins& local, const Grid& grid) {
  return std::min(local.first<3>(grid.face0), local.first<3>(grid.singleton() ? grid.face0 : grid.face1));
}

namespace detail {

// The half-edges that leave at a corner of the grids of a batch, and where the window of depth 0 begins, counted in the
// ring from the point to which they lead.
struct Corners {
  std::array<std::int32_t, kMaxLanes> half_edge;
  int first;
};

// Corner blocks, with windows of `width` entries.
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
  to_lanes<T>(head, CornerBlock::kWindow, lanes, out);
  out += CornerBlock::kWindow * lanes;
  if (rings.reaches(depth)) return to_lanes<T>(window, 3 * width, lanes, out);
  const Adjacency& adjacency = rings.adjacency();
  for (int lane = 0; lane < lanes; ++lane) {  // round a closed ring, often more than once
    const std::int32_t v = adjacency.origin(corners.half_edge[lane]);
    const T* const ring = head[lane] + 3 * (BasicLoopRings<N>::kHeadPoints + BasicLoopRings<N>::kReach);
    const int n = adjacency.valence(v), start = static_cast<int>((window[lane] - ring) / 3) % n + n;
    for (int k = 0; k < 3 * width; ++k)
      out[k * lanes + lane] =
          adjacency.on_boundary(v) ? window[lane][k] : ring[3 * ((start + k / 3) % n) + k % 3];
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
    out[k * lanes] = p[(k - CornerBlock::kCentre) % 3];
}

// Which parts have origins of their own: first(lane) says from which depth on any of them, own(lane, part) whether one
// of `count` has. Returns whether any has.
template <class T, class First, class Own>
bool put_parts(const LocalOrigins& local, int depth, int lanes, int count, T* out, const First& first,
               const Own& own) {
  if (local.none(depth)) return false;
  if (local.all(depth)) {
    std::fill_n(out, count * lanes, T(1));
    return true;
  }
  bool some = false;
  for (int lane = 0; lane < lanes; ++lane) some = some || depth >= first(lane);
  for (int lane = 0; some && lane < lanes; ++lane)
    for (int part = 0; part < count; ++part) out[part * lanes + lane] = T(own(lane, part) ? 1 : 0);
  return some;
}

// Tells the kernel which of `count` edges are regular in which lanes: bit k of regular[lane] for edge k.
template <class T>
void put_regular(const unsigned* regular, int count, int lanes, T* out, BatchPlacement<T>& placement) {
  placement.all_regular = ~0U;
  for (int lane = 0; lane < lanes; ++lane)
    placement.some_regular |= regular[lane], placement.all_regular &= regular[lane];
  for (int k = 0; k < count; ++k)
    for (int lane = 0; (placement.some_regular >> k & 1) != 0 && lane < lanes; ++lane)
      out[k * lanes + lane] = T(static_cast<int>(regular[lane] >> k & 1));
}

}  // namespace detail

/// Whether regular edges are to be polynomials, from kLocalFrom on.
enum class Edges : std::uint8_t { kAllStreamed, kRegularByPolynomials };

/// Fills input_size(depth) * lanes numbers, aligned to 64 bytes for the vector kernels, from 1 to `lanes`
/// grids; the lanes that remain repeat the last grid. A singleton without neighbour gets ghosts for its dummy
/// partner. Returns how the kernel is to take them.
template <class N>
BatchPlacement<typename N::Scalar> gather(const BasicLoopRings<N>& rings, std::span<const Grid> grids,
                                          int depth, int lanes, typename N::Scalar* input,
                                          Order order = Order::kFromA, Edges edges = Edges::kAllStreamed) {
  detail::Corners corners[4] = {{{}, -2}, {{}, -1}, {{}, -1}, {{}, -1}};
  bool ghost[kMaxLanes];
  const auto grid_of = [&](int lane) -> const Grid& {
    return grids[std::min(static_cast<std::size_t>(lane), grids.size() - 1)];
  };
  for (int lane = 0; lane < lanes; ++lane) {
    const Grid& grid = grid_of(lane);
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
  const LocalOrigins& local = rings.local();
  const auto own = [&](int lane, int part) {
    const Grid& grid = grid_of(lane);
    const auto face = [&](std::int32_t f) { return f >= 0 && depth >= local.of_face<3>(f); };
    if (part == kInside) return face(grid.face0) || face(grid.face1);
    const std::int32_t h = GridEdges(rings.adjacency(), grid, order).of[part];
    return h >= 0 && depth >= local.of_edge<3>(h);
  };
  BatchPlacement<typename N::Scalar> placement{
      rings.placement(), detail::put_parts(
                             local, depth, lanes, kParts, input + parts_offset(depth) * lanes,
                             [&](int lane) { return local_from(local, grid_of(lane)); }, own)};
  if (edges == Edges::kRegularByPolynomials && depth >= kLocalFrom) {
    unsigned regular[kMaxLanes];
    for (int lane = 0; lane < lanes; ++lane)
      regular[lane] = regular_edges(rings, grid_of(lane), depth, order);
    detail::put_regular(regular, kInside, lanes, input + regular_offset(depth) * lanes, placement);
  }
  return placement;
}

/// The same for a TrianglePatch, whatever the depth: of pairs with regular corners.
template <class N>
BatchPlacement<typename N::Scalar> gather_regular(const BasicLoopRings<N>& rings, std::span<const Grid> grids,
                                                  int lanes, typename N::Scalar* input,
                                                  Order order = Order::kFromA) {
  return gather(rings, grids, kPatchWindow, lanes, input, order);
}

/// The same for control edges, each from the origin to the target of a half-edge: edge_input_size(depth) *
/// lanes numbers.
template <class N>
BatchPlacement<typename N::Scalar> gather_edges(const BasicLoopRings<N>& rings,
                                                std::span<const std::int32_t> half_edges, int depth,
                                                int lanes, typename N::Scalar* input,
                                                Edges edges = Edges::kAllStreamed) {
  detail::Corners p{{}, -1}, q{{}, 0};  // Q's ring: from the left neighbour, which comes before P
  const auto half_edge = [&](int lane) {
    return half_edges[std::min(static_cast<std::size_t>(lane), half_edges.size() - 1)];
  };
  for (int lane = 0; lane < lanes; ++lane)
    p.half_edge[lane] = half_edge(lane), q.half_edge[lane] = Adjacency::next(half_edge(lane));
  const int width = edge_window_width(depth);
  detail::put_corners(rings, p, width, depth, lanes, input);
  detail::put_corners(rings, q, width, depth, lanes, input + edge_block_size(depth) * lanes);
  const auto from = [&](int lane) { return rings.local().template of_edge<3>(half_edge(lane)); };
  typename N::Scalar* const flags = input + edge_part_offset(depth) * lanes;
  BatchPlacement<typename N::Scalar> placement{
      rings.placement(), detail::put_parts(rings.local(), depth, lanes, 1, flags, from,
                                           [&](int lane, int) { return depth >= from(lane); })};
  if (edges == Edges::kRegularByPolynomials && depth >= kLocalFrom) {
    unsigned regular[kMaxLanes];
    for (int lane = 0; lane < lanes; ++lane) regular[lane] = rings.is_regular(half_edge(lane)) ? 1 : 0;
    detail::put_regular(regular, 1, lanes, flags + lanes, placement);
  }
  return placement;
}

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
  to_lanes<T>(from, Block::kHead, lanes, block);

  const int width = quad_window_width(depth);
  if (open || period > width) period = 0;
  T* out = block + Block::kWindow * lanes;
  if (period > 0) {
    for (int lane = 0; lane < lanes; ++lane) from[lane] = rings.numbers() + corner[lane]->before;
    to_lanes<T>(from, 3 * period, lanes, out);
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
  to_lanes<T>(from, 3 * width, lanes, out);
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
  const auto at = [&](int lane, int k) {
    return half_edge(k, std::min(static_cast<std::size_t>(lane), size - 1));
  };
  for (int k = 0; k < count; ++k) {
    for (int lane = 0; lane < lanes; ++lane) corner[lane] = &rings.corner(at(lane, k));
    const bool open =
        put_corner(rings, corner, depth, lanes, input + k * quad_block_size(depth) * lanes, batch.period[k]);
    batch.open |= static_cast<unsigned>(open) << k;
    if (open) put_darts(rings, corner, k, lanes, batch);
    put_side(corner, k, lanes, batch);
  }
  const LocalOrigins& local = rings.local();
  batch.local = put_parts(
      local, depth, lanes, kParts, input + quad_parts_offset(depth) * lanes,
      [&](int lane) { return local.first<4>(at(lane, 0) / 4); },
      [&](int lane, int part) {
        if (part == kInside) return depth >= local.of_face<4>(at(lane, 0) / 4);
        return part < count && depth >= local.of_edge<4>(at(lane, part));
      });
  return batch;
}

}  // namespace detail

/// The same batch with origins of their own for all of its parts, or for none, whatever its rings say.
template <class T>
QuadBatch<T> with_origins(QuadBatch<T> batch, bool local, int lanes) {
  batch.local = local;
  if (local) std::fill_n(batch.input + quad_parts_offset(batch.depth) * lanes, kParts * lanes, T(1));
  return batch;
}

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
    to_lanes<T>(from, 3 * run.count, lanes, entries);
    for (int k = 0; k < run.count; ++k) put(entries + 3 * k * lanes, run.at[k]);
  }
  for (int corner = 0; corner < 4; ++corner) {
    for (int lane = 0; lane < lanes; ++lane)
      from[lane] = rings.head(rings.corner(half_edge(lane, corner)).vertex) + QuadCornerBlock::kLimit;
    to_lanes<T>(from, 6, lanes, input + (kPatchLimits + 6 * corner) * lanes);
  }
  for (int lane = 0; lane < lanes; ++lane)
    from[lane] = rings.head(rings.corner(half_edge(lane, 0)).vertex) + QuadCornerBlock::kCentre;
  to_lanes<T>(from, 3, lanes, entries);
  put(entries, 5);
  return {input, depth, {}};
}

}  // namespace limitcheck::fast::row_stream
