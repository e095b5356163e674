// SPDX-License-Identifier: MIT
// BasicRings for any number; rings.cpp instantiates it for float and double.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "fast/row_stream/rings.h"

namespace limitcheck::fast::row_stream {

/// Where a closed ring, read from there on, is lexicographically smallest.
template <class W>
std::size_t canonical_start(std::span<const Vec3<W>> ring) {
  const std::size_t n = ring.size();
  std::size_t best = 0;
  for (std::size_t k = 1; k < n; ++k) {
    std::size_t i = k, j = best;
    for (std::size_t t = 0; t < n; ++t) {
      const Vec3<W>&a = ring[i], &b = ring[j];
      if (a != b) {
        if (a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z) best = k;
        break;
      }
      if (++i == n) i = 0;
      if (++j == n) j = 0;
    }
  }
  return best;
}

template <class N>
BasicRings<N>::BasicRings(const Adjacency& adjacency, PlacedPoints<T> points)
    : points_(std::move(points.points)), placement_(points.placement) {
  if (points_.size() != static_cast<std::size_t>(adjacency.vertex_count())) {
    throw std::invalid_argument("rings: " + std::to_string(points_.size()) + " points for " +
                                std::to_string(adjacency.vertex_count()) + " vertices");
  }
  lay_out(adjacency);
  Scratch scratch;
  for (std::int32_t v = 0; v < adjacency.vertex_count(); ++v) {
    if (adjacency.outgoing(v) >= 0) make_vertex(adjacency, v, scratch);
  }
}

// Where each vertex' entries and ghosts go, and the weights of the valences there are.
template <class N>
void BasicRings<N>::lay_out(const Adjacency& adjacency) {
  const auto vertices = static_cast<std::size_t>(adjacency.vertex_count());
  rings_.resize(vertices);
  corners_.resize(vertices);
  slot_.resize(3 * static_cast<std::size_t>(adjacency.face_count()));
  closed_.resize(static_cast<std::size_t>(adjacency.max_valence()) + 1);
  open_.resize(closed_.size());
  std::int32_t entries = 0, ghosts = 0;
  for (std::int32_t v = 0; v < adjacency.vertex_count(); ++v) {
    Ring& ring = rings_[static_cast<std::size_t>(v)];
    const int n = adjacency.valence(v);
    ring = {0, 1};
    if (n == 0) continue;
    const bool open = adjacency.on_boundary(v);
    ring = {entries + (open ? kReach : 0), open ? kOpen : n};
    entries += n + (open ? 2 * kReach : 0);
    ghosts += open ? 2 * kReach : 0;
    auto& weights = (open ? open_ : closed_)[static_cast<std::size_t>(n)];
    if (weights.sine.empty() && n > 0)
      weights = open ? RingWeights<Weight>::open(n) : RingWeights<Weight>::closed(n);
  }
  entries_.resize(static_cast<std::size_t>(entries));
  points_.reserve(vertices + static_cast<std::size_t>(ghosts));
}

template <class N>
void BasicRings<N>::make_vertex(const Adjacency& adjacency, std::int32_t v, Scratch& scratch) {
  const bool open = walk(adjacency, v, scratch);
  const std::size_t n = scratch.ring.size(), faces = scratch.half_edges.size();
  std::size_t start = 0;
  if constexpr (std::is_floating_point_v<T>) {
    if (!open) start = canonical_start<Wide>(scratch.points);
  }
  const Ring ring = rings_[static_cast<std::size_t>(v)];
  std::int32_t* entries = entries_.data() + ring.first;
  if (start != 0)
    std::rotate(scratch.points.begin(), scratch.points.begin() + static_cast<std::ptrdiff_t>(start),
                scratch.points.end());
  for (std::size_t k = 0, from = start; k < n; ++k) {
    entries[k] = scratch.ring[from];
    if (k < faces) slot_[static_cast<std::size_t>(scratch.half_edges[from])] = static_cast<std::int32_t>(k);
    if (++from == n) from = 0;
  }

  const auto& p = points_[static_cast<std::size_t>(v)];
  const Vec3<Wide> centre = widen<T>(Vec3<T>{p[0], p[1], p[2]});
  if (open) continue_ring(centre, scratch, ring);
  const auto& weights = (open ? open_ : closed_)[n];
  const std::span<const Vec3<Wide>> around(scratch.points);
  const auto limit =
      open ? open_limit<Wide>(centre, around, weights) : closed_limit<Wide>(centre, around, weights);
  Vec3<Wide> normal;
  if constexpr (N::kLinear) {
    normal = {N::tangent(limit.along.x, limit.across.x), N::tangent(limit.along.y, limit.across.y),
              N::tangent(limit.along.z, limit.across.z)};
  } else {
    bool degenerate = false;
    normal = unit_normal<Wide>(limit, centre, around, !open, degenerate);
    degenerate_normals_ += degenerate ? 1 : 0;
  }
  put_corner(v, centre, weights, limit, normal);
}

// Neighbours counter-clockwise, and the half-edges to them; whether they are an open ring.
template <class N>
bool BasicRings<N>::walk(const Adjacency& adjacency, std::int32_t v, Scratch& scratch) const {
  scratch.ring.clear();
  scratch.half_edges.clear();
  scratch.points.clear();
  const auto add = [&](std::int32_t r) {
    const auto& p = points_[static_cast<std::size_t>(r)];
    scratch.ring.push_back(r);
    scratch.points.push_back(widen<T>(Vec3<T>{p[0], p[1], p[2]}));
  };
  const std::int32_t start = adjacency.outgoing(v);
  std::int32_t h = start;
  do {
    scratch.half_edges.push_back(h);
    add(adjacency.target(h));
    const std::int32_t last = Adjacency::prev(h);
    h = adjacency.twin(last);
    if (h < 0) add(adjacency.origin(last));
  } while (h >= 0 && h != start);
  return h < 0;
}

// The open ring continued by kReach entries at either end: index k of the ring is at [k + kReach].
template <class N>
void BasicRings<N>::continue_ring(const Vec3<Wide>& v, Scratch& scratch, Ring ring) {
  const auto& r = scratch.points;
  const int last = static_cast<int>(r.size()) - 1;
  auto& all = scratch.continued;
  all.resize(r.size() + 2 * kReach);
  const auto at = [&](int k) -> Vec3<Wide>& { return all[static_cast<std::size_t>(k + kReach)]; };
  std::copy(r.begin(), r.end(), all.begin() + kReach);
  const auto sum = [&](int k, const Vec3<Wide>& near, const Vec3<Wide>& far) {
    switch (k % 6) {
      case 0:
        return near + near;
      case 3:
        return far + far;
      case 1:
      case 5:
        return v + near;
      default:
        return v + far;
    }
  };
  for (int k = 1; k <= kReach; ++k) {
    at(-k) = sum(k, r.front(), r.back()) - at(k);
    at(last + k) = sum(k, r.back(), r.front()) - at(last - k);
  }
  for (int k = -kReach; k <= last + kReach; ++k) {
    if (k >= 0 && k <= last) continue;
    entries_[static_cast<std::size_t>(ring.first + k)] = static_cast<std::int32_t>(points_.size());
    const Vec3<T> ghost = narrow<T>(at(k));
    points_.push_back({ghost.x, ghost.y, ghost.z, T(0)});
  }
}

template <class N>
void BasicRings<N>::put_corner(std::int32_t v, const Vec3<Wide>& centre, const RingWeights<Weight>& weights,
                               const VertexLimit<Wide>& limit, const Vec3<Wide>& normal) {
  auto& head = corners_[static_cast<std::size_t>(v)].head;
  const auto put = [&](std::size_t at, const Vec3<Wide>& wide) {
    const Vec3<T> x = narrow<T>(wide);
    head[at] = x.x, head[at + 1] = x.y, head[at + 2] = x.z;
  };
  head[0] = static_cast<T>(weights.k0);
  head[1] = static_cast<T>(weights.k1);
  put(CornerBlock::kCentre, centre);
  put(CornerBlock::kDifference, limit.difference);
  const Vec3<Wide> origin =
      widen<T>(Vec3<T>{placement_.centre[0], placement_.centre[1], placement_.centre[2]});
  put(CornerBlock::kLimit, NumberTraits<T>::widen(placement_.unit) * limit.position + origin);
  put(CornerBlock::kLimit + 3, normal);
}

}  // namespace limitcheck::fast::row_stream
