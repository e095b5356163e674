// SPDX-License-Identifier: MIT
#include "fast/row_stream/batch.h"

#include <algorithm>

#include "fast/row_stream/transpose.h"

namespace limitcheck::fast::row_stream {

namespace {

// A corner's vertex, and the index in its ring of core entry 0 (the first of the pair's own points).
struct Place {
  std::int32_t vertex;
  std::int32_t core;
};

// Corner blocks of `group` lanes, whose rings are walked side by side. With an origin of its own a pair or
// edge wants differences from the corner; they are exact or nearly so.
template <int group>
void put_group(const Rings& rings, const Place* places, int width, int depth, int lanes, float* out) {
  const float *head[group], *centre[group], *column[group];
  const std::int32_t* entries[group];
  std::int32_t at[group], period[group];
  const float* points = rings.points().data()->data();
  const auto point = [=](std::int32_t k) {
    return points + sizeof(Rings::Point) / sizeof(float) * static_cast<std::size_t>(k);
  };
  for (int lane = 0; lane < group; ++lane) {
    const Place place = places[lane];
    head[lane] = rings.corner(place.vertex).head.data();
    centre[lane] = point(place.vertex);
    const Rings::Ring ring = rings.ring(place.vertex);
    entries[lane] = rings.entries().data() + ring.first;
    period[lane] = ring.period;
    at[lane] = place.core - 1 - depth;
    if (ring.period != Rings::kOpen) {
      at[lane] %= ring.period;
      at[lane] += at[lane] < 0 ? ring.period : 0;
    }
  }
  to_lanes<group, float>(head, nullptr, CornerBlock::kWindow, lanes, out);
  out += CornerBlock::kWindow * lanes;
  for (int t = 0; t < width; ++t, out += 3 * lanes) {
    for (int lane = 0; lane < group; ++lane) {
      column[lane] = point(entries[lane][at[lane]]);
      const std::int32_t next = at[lane] + 1;
      at[lane] = next == period[lane] ? 0 : next;
    }
    to_lanes<group, float>(column, has_local_origin(depth) ? centre : nullptr, 3, lanes, out);
  }
}

void put_corners(const Rings& rings, const Place* places, int width, int depth, int lanes, float* out) {
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
void put_ghost(const Rings& rings, Place a, int corner, int depth, int lanes, float* out) {
  const Rings::Ring ring = rings.ring(a.vertex);
  const std::int32_t ghost = rings.entries()[static_cast<std::size_t>(ring.first + a.core)];
  const Rings::Point& p = rings.points()[static_cast<std::size_t>(ghost)];
  for (int k = 0; k < 2; ++k) out[k * lanes] = 0;
  for (int k = CornerBlock::kCentre; k < CornerBlock::kWindow + 3 * window_width(corner, depth); ++k)
    out[k * lanes] = k >= CornerBlock::kWindow && has_local_origin(depth)
                         ? 0
                         : p[static_cast<std::size_t>((k - CornerBlock::kCentre) % 3)];
}

}  // namespace

void gather(const Adjacency& adjacency, const Rings& rings, std::span<const Pair> pairs, int depth, int lanes,
            float* input) {
  Place places[4][kMaxLanes];
  bool ghost[kMaxLanes];
  for (int lane = 0; lane < lanes; ++lane) {
    const Pair& pair = pairs[std::min(static_cast<std::size_t>(lane), pairs.size() - 1)];
    // A singleton without neighbour may be cut along any edge.
    const std::int32_t ac = 3 * pair.face0 + (pair.edge0 < 0 ? 0 : pair.edge0);
    const std::int32_t cd = Adjacency::next(ac), da = Adjacency::prev(ac), ca = adjacency.twin(ac);
    places[kA][lane] = {adjacency.origin(ac), rings.slot(ac) - 1};
    places[kC][lane] = {adjacency.origin(cd), rings.slot(cd)};
    places[kD][lane] = {adjacency.origin(da), rings.slot(da)};
    ghost[lane] = ca < 0;
    const std::int32_t bc = ca < 0 ? da : Adjacency::prev(ca);
    places[kB][lane] = {adjacency.origin(bc), rings.slot(bc)};
  }
  const auto block = [&](int corner) { return input + corner * corner_block_size(depth) * lanes; };
  for (const int corner : {kA, kB, kC, kD})
    put_corners(rings, places[corner], window_width(corner, depth), depth, lanes, block(corner));
  for (int lane = 0; lane < lanes; ++lane) {
    if (ghost[lane]) put_ghost(rings, places[kA][lane], kB, depth, lanes, block(kB) + lane);
  }
}

void gather_edges(const Adjacency& adjacency, const Rings& rings, std::span<const std::int32_t> half_edges,
                  int depth, int lanes, float* input) {
  Place p[kMaxLanes], q[kMaxLanes];
  for (int lane = 0; lane < lanes; ++lane) {
    const std::int32_t h = half_edges[std::min(static_cast<std::size_t>(lane), half_edges.size() - 1)];
    // from Q to the left neighbour, which comes before P in Q's ring
    const std::int32_t after = Adjacency::next(h);
    p[lane] = {adjacency.origin(h), rings.slot(h)};
    q[lane] = {adjacency.origin(after), rings.slot(after) + 1};
  }
  put_corners(rings, p, edge_window_width(depth), depth, lanes, input);
  put_corners(rings, q, edge_window_width(depth), depth, lanes, input + edge_block_size(depth) * lanes);
}

}  // namespace limitcheck::fast::row_stream
