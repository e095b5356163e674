// SPDX-License-Identifier: MIT
#include "fast/row_stream/batch.h"

#include <algorithm>

namespace limitcheck::fast::row_stream {

namespace {

// A corner's vertex, and the index in its ring of core entry 0 (the first of the pair's own points).
struct Place {
  std::int32_t vertex;
  std::int32_t core;
};

void put_corner(const Rings& rings, Place place, int width, int depth, int lanes, float* out) {
  const auto& head = rings.corner(place.vertex).head;
  for (std::size_t k = 0; k < head.size(); ++k) out[static_cast<int>(k) * lanes] = head[k];

  const Rings::Ring ring = rings.ring(place.vertex);
  const std::int32_t* entries = rings.entries().data() + ring.first;
  std::int32_t at = place.core - 1 - depth;
  if (ring.period != Rings::kOpen) {
    while (at < 0) at += ring.period;
  }
  // With an origin of its own a pair or edge wants differences from the corner; they are exact or nearly so.
  constexpr Rings::Point kNothing{};
  const Rings::Point& from =
      has_local_origin(depth) ? rings.points()[static_cast<std::size_t>(place.vertex)] : kNothing;
  out += CornerBlock::kWindow * lanes;
  for (int t = width; t > 0; --t, out += 3 * lanes) {
    const Rings::Point& p = rings.points()[static_cast<std::size_t>(entries[at])];
    for (int c = 0; c < 3; ++c)
      out[c * lanes] = p[static_cast<std::size_t>(c)] - from[static_cast<std::size_t>(c)];
    if (++at == ring.period) at = 0;
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
  for (int lane = 0; lane < lanes; ++lane) {
    const Pair& pair = pairs[std::min(static_cast<std::size_t>(lane), pairs.size() - 1)];
    // A singleton without neighbour may be cut along any edge.
    const std::int32_t ac = 3 * pair.face0 + (pair.edge0 < 0 ? 0 : pair.edge0);
    const std::int32_t cd = Adjacency::next(ac), da = Adjacency::prev(ac), ca = adjacency.twin(ac);
    const auto out = [&](int corner) { return input + corner * corner_block_size(depth) * lanes + lane; };

    const Place a{adjacency.origin(ac), rings.slot(ac) - 1};
    put_corner(rings, a, window_width(kA, depth), depth, lanes, out(kA));
    put_corner(rings, {adjacency.origin(cd), rings.slot(cd)}, window_width(kC, depth), depth, lanes, out(kC));
    put_corner(rings, {adjacency.origin(da), rings.slot(da)}, window_width(kD, depth), depth, lanes, out(kD));
    if (ca < 0) {
      put_ghost(rings, a, kB, depth, lanes, out(kB));
    } else {
      const std::int32_t bc = Adjacency::prev(ca);
      put_corner(rings, {adjacency.origin(bc), rings.slot(bc)}, window_width(kB, depth), depth, lanes,
                 out(kB));
    }
  }
}

void gather_edges(const Adjacency& adjacency, const Rings& rings, std::span<const std::int32_t> half_edges,
                  int depth, int lanes, float* input) {
  for (int lane = 0; lane < lanes; ++lane) {
    const std::int32_t h = half_edges[std::min(static_cast<std::size_t>(lane), half_edges.size() - 1)];
    const std::int32_t after =
        Adjacency::next(h);  // from Q to the left neighbour, which comes before P in Q's ring
    const int width = edge_window_width(depth);
    put_corner(rings, {adjacency.origin(h), rings.slot(h)}, width, depth, lanes, input + lane);
    put_corner(rings, {adjacency.origin(after), rings.slot(after) + 1}, width, depth, lanes,
               input + edge_block_size(depth) * lanes + lane);
  }
}

}  // namespace limitcheck::fast::row_stream
