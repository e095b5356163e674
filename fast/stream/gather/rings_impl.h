// SPDX-License-Identifier: MIT
// BasicLoopRings and BasicQuadRings for any number; rings.cpp instantiates them for float and double.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "data/error.h"
#include "fast/rules/limit.h"
#include "fast/rules/prepared_quads.h"
#include "fast/stream/gather/rings.h"

namespace limitcheck::fast::row_stream {

/// Where a closed ring, read from there on, is lexicographically smallest.
///   step   only every so many points are such a place
template <class W>
std::size_t canonical_start(const Vec3<W>* ring, std::size_t n, std::size_t step = 1) {
  std::size_t best = 0;
  bool unique = true;
  for (std::size_t k = step; k < n; k += step) {
    const bool less = ring[k].x < ring[best].x;
    unique = less | (unique & (ring[k].x != ring[best].x));
    best = less ? k : best;
  }
  if (unique) return best;
  best = 0;
  for (std::size_t k = step; k < n; k += step) {
    for (std::size_t t = 0; t < n; ++t) {
      const Vec3<W>&a = ring[(k + t) % n], &b = ring[(best + t) % n];
      if (a == b) continue;
      if (a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z) best = k;
      break;
    }
  }
  return best;
}

template <class N>
BasicLoopRings<N>::BasicLoopRings(const Adjacency& adjacency, PlacedPoints<T> points, VertexKinds kinds)
    : adjacency_(&adjacency), kinds_(kinds), weights_(adjacency.max_valence()) {
  lay_out();
  find_regular_edges();
  move_points(std::move(points));
}

template <class N>
void BasicLoopRings<N>::move_points(PlacedPoints<T> points) {
  const Adjacency& adjacency = *adjacency_;
  if (points.points.size() != static_cast<std::size_t>(adjacency.vertex_count())) {
    throw data::ArgumentError("rings: " + std::to_string(points.points.size()) + " points for " +
                              std::to_string(adjacency.vertex_count()) + " vertices");
  }
  placement_ = points.placement;
  local_ = LocalOrigins::of<3>(points, [&](std::int32_t h) {
    return adjacency.twin(h) < 0 ? -1 : Adjacency::face(adjacency.twin(h));
  });
  degenerate_normals_ = 0;
  const auto most = static_cast<std::size_t>(adjacency.max_valence());
  Scratch scratch{
      std::move(points.points), std::vector<std::int32_t>(most), std::vector<Vec3<Wide>>(2 * most), {}};
  for (std::int32_t v = 0; v < adjacency.vertex_count(); ++v) {
    std::copy_n(scratch.placed[v].data(), 3, head_of(v) + CornerBlock::kCentre);
    if (adjacency.outgoing(v) >= 0) make_vertex(v, kinds_[v], scratch);
  }
}

// Where the numbers of each vertex go, and the weights of the valences there are.
template <class N>
void BasicLoopRings<N>::lay_out() {
  const Adjacency& adjacency = *adjacency_;
  heads_.resize(static_cast<std::size_t>(adjacency.vertex_count()));
  corners_.resize(3 * static_cast<std::size_t>(adjacency.face_count()));
  std::int32_t points = 0;
  for (std::int32_t v = 0; v < adjacency.vertex_count(); ++v) {
    heads_[v] = points;
    points += kHeadPoints;
    const int n = adjacency.valence(v);
    if (n == 0) continue;
    const bool open = adjacency.on_boundary(v);
    points += n + 2 * (open ? kOpenReach : kReach);
    weights_.make(static_cast<std::size_t>(n), open);
  }
  numbers_.resize(3 * static_cast<std::size_t>(points) + 1);  // a fourth number is written, see make_vertex
}

template <class N>
void BasicLoopRings<N>::find_regular_edges() {
  const Adjacency& adjacency = *adjacency_;
  std::vector<std::uint8_t> vertices(heads_.size());
  for (std::int32_t v = 0; v < adjacency.vertex_count(); ++v)
    vertices[v] = adjacency.valence(v) == 6 && !adjacency.on_boundary(v) && kinds_[v] == VertexKind::kPlain;
  regular_.resize(corners_.size());
  for (std::int32_t first = 0; first < static_cast<std::int32_t>(corners_.size()); first += 3) {
    const auto at = [&](std::int32_t h) { return vertices[adjacency.origin(h)]; };
    if ((at(first) & at(first + 1) & at(first + 2)) == 0) continue;
    for (std::int32_t h = first; h < first + 3; ++h) regular_[h] = at(Adjacency::prev(adjacency.twin(h)));
  }
}

template <class N>
void BasicLoopRings<N>::make_vertex(std::int32_t v, VertexKind kind, Scratch& scratch) {
  const Adjacency& adjacency = *adjacency_;
  // Neighbours counter-clockwise from the canonical one on. A closed ring is read past its end.
  const std::span<const std::int32_t> fan = adjacency.fan(v);
  const bool open = adjacency.on_boundary(v), held = kind == VertexKind::kHeld;
  const std::size_t faces = fan.size(), n = faces + (open ? 1 : 0);
  const auto position = [&](std::int32_t at) {
    const auto& p = scratch.placed[at];
    return widen<T>(Vec3<T>{p[0], p[1], p[2]});
  };
  std::int32_t* vertex = scratch.vertices.data();
  Vec3<Wide>* points = scratch.points.data();
  for (std::size_t k = 0; k < faces; ++k) {
    vertex[k] = adjacency.target(fan[k]);
    points[k] = position(vertex[k]);
  }
  if (open) {
    vertex[faces] = adjacency.origin(Adjacency::prev(fan.back()));
    points[faces] = position(vertex[faces]);
  }
  std::size_t start = 0;
  if constexpr (std::is_floating_point_v<T>) {
    if (!open) start = canonical_start(points, n);
  }
  for (std::size_t k = 0; k < start; ++k) points[n + k] = points[k];
  const std::span<const Vec3<Wide>> around(points + start, n);

  const std::int32_t first = heads_[v] + kHeadPoints + (open ? kOpenReach : kReach);
  for (std::size_t k = 0; k < faces; ++k)
    corners_[fan[k]] = {heads_[v], first + static_cast<std::int32_t>(k < start ? k + n - start : k - start)};
  // Four numbers for three, of which the next point overwrites the last.
  T* const ring = numbers_.data() + 3 * static_cast<std::size_t>(first);
  const int before = open ? 0 : kReach, size = static_cast<int>(n);
  for (int k = -before, at = (static_cast<int>(start) - before % size + size) % size; k < size + before;
       ++k) {
    std::copy_n(scratch.placed[vertex[at]].data(), 4, ring + 3 * k);
    at = at + 1 == size ? 0 : at + 1;
  }
  const Vec3<Wide> centre = position(v);
  if (open) continue_ring(centre, held, around, ring, scratch);
  const auto& weights = weights_.of(n, open);
  const auto limit = limit_of_kind(centre, around, open, kind, weights, darts_);
  Vec3<Wide> normal;
  if constexpr (N::kLinear) {
    normal = {N::tangent(limit.du.x, limit.dv.x), N::tangent(limit.du.y, limit.dv.y),
              N::tangent(limit.du.z, limit.dv.z)};
  } else {
    constexpr double kFarthest = 4;  // in a mesh of size 1, see `place`
    bool degenerate = false;
    normal = vertex_normal<Wide>(limit, centre, around, open, degenerate, kFarthest, kind);
    if (degenerate) ++degenerate_normals_;
  }
  // What is held moves by nothing, and the sum of its differences halves or, at a closed ring, becomes 5/8.
  held ? put_head(v, Weight(0), Weight(open ? 4 : 5), limit, normal)
       : put_head(v, weights.k0, weights.k1, limit, normal);
}

// The open ring continued by kOpenReach entries at either end: index k of the ring is at [k + kOpenReach].
template <class N>
void BasicLoopRings<N>::continue_ring(const Vec3<Wide>& v, bool held, std::span<const Vec3<Wide>> r, T* ring,
                                      Scratch& scratch) {
  const int last = static_cast<int>(r.size()) - 1;
  auto& all = scratch.continued;
  all.resize(r.size() + 2 * kOpenReach);
  const auto at = [&](int k) -> Vec3<Wide>& { return all[k + kOpenReach]; };
  std::copy(r.begin(), r.end(), all.begin() + kOpenReach);
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
  // Half a turn about a vertex that is held: the far end is the near one's image.
  const Vec3<Wide> front = r.front(), back = r.back();
  const Vec3<Wide> beyond_front = held ? (v + v) - front : back, beyond_back = held ? (v + v) - back : front;
  for (int k = 1; k <= kOpenReach; ++k) {
    at(-k) = sum(k, front, beyond_front) - at(k);
    at(last + k) = sum(k, back, beyond_back) - at(last - k);
  }
  for (int k = -kOpenReach; k <= last + kOpenReach; ++k) {
    if (k >= 0 && k <= last) continue;
    const Vec3<T> ghost = narrow<T>(at(k));
    ring[3 * k] = ghost.x, ring[3 * k + 1] = ghost.y, ring[3 * k + 2] = ghost.z;
  }
}

template <class N>
void BasicLoopRings<N>::put_head(std::int32_t v, const Weight& k0, const Weight& k1,
                                 const VertexLimit<Wide>& limit, const Vec3<Wide>& normal) {
  T* const head = head_of(v);
  const auto put = [&](std::size_t at, const Vec3<Wide>& wide) {
    const Vec3<T> x = narrow<T>(wide);
    head[at] = x.x, head[at + 1] = x.y, head[at + 2] = x.z;
  };
  head[0] = static_cast<T>(k0);
  head[1] = static_cast<T>(k1);
  put(CornerBlock::kDifference, limit.difference);
  const Vec3<Wide> origin =
      widen<T>(Vec3<T>{placement_.centre[0], placement_.centre[1], placement_.centre[2]});
  put(CornerBlock::kLimit, NumberTraits<T>::widen(placement_.unit) * limit.position + origin);
  put(CornerBlock::kLimit + 3, normal);
  for (int c = 3; c < 6; ++c) head[CornerBlock::kLimit + c] = head[CornerBlock::kLimit + c] + T(0);  // no -0
}

namespace detail {

// k0 .. k4 of a QuadCornerBlock. A dart's centre does not come from sums.
template <class W>
std::array<typename NumberTraits<W>::Scalar, 5> sum_weights(const QuadStar<W>& star) {
  using T = NumberTraits<W>;
  using S = typename T::Scalar;
  const S zero(0), one(1), half = T::ratio(1, 2);
  if (star.kind != VertexKind::kPlain) return {zero, zero, zero, zero, zero};
  if (star.open) return {half, zero, one, zero, zero};
  const int n = star.faces;
  return {T::ratio(6, n * n), T::ratio(1, n * n), S(2) - T::ratio(6, n), half - T::ratio(1, n),
          one - T::ratio(1, n)};
}

}  // namespace detail

template <class T>
struct BasicQuadRings<T>::Scratch {
  std::vector<ControlPoint<T>> points;
  StarWeightTable<typename NumberTraits<Wide>::Scalar> weights;
  OwnQuadStar<Wide> own;
  SemiSharp semi_sharp;
};

template <class T>
BasicQuadRings<T>::BasicQuadRings(const QuadMesh& mesh, PlacedPoints<T> placed, int tangent)
    : placement_(placed.placement),
      local_(LocalOrigins::of<4>(placed, [&](std::int32_t h) { return mesh.across(h); })),
      tangent_(tangent) {
  if (placed.points.size() != static_cast<std::size_t>(mesh.adjacency.vertex_count()))
    throw data::ArgumentError("row streaming: not one point per vertex");
  lay_out(mesh.adjacency);
  Scratch scratch{std::move(placed.points), {}, {}, SemiSharp(mesh)};
  for (std::int32_t v = 0; v < mesh.adjacency.vertex_count(); ++v)
    if (mesh.adjacency.outgoing(v) >= 0) make_vertex(mesh, v, scratch);
  find_kinds(mesh);
}

template <class T>
void BasicQuadRings<T>::lay_out(const QuadAdjacency& adjacency) {
  rings_.resize(static_cast<std::size_t>(adjacency.vertex_count()));
  heads_.resize(rings_.size());
  corners_.resize(4 * static_cast<std::size_t>(adjacency.face_count()));
  std::int32_t numbers = 0;
  for (std::int32_t v = 0; v < adjacency.vertex_count(); ++v) {
    const auto faces = static_cast<std::int32_t>(adjacency.fan(v).size());
    const bool open = adjacency.on_boundary(v);
    rings_[v] = {numbers, 2 * faces + (open ? 1 : 0)};
    numbers += 3 * (open ? 2 * faces + 1 : 4 * faces);
  }
  numbers_.resize(static_cast<std::size_t>(numbers) + 4);  // the last one is read four numbers at a time
}

template <class T>
void BasicQuadRings<T>::make_vertex(const QuadMesh& mesh, std::int32_t v, Scratch& scratch) {
  const std::span<const std::int32_t> fan = mesh.adjacency.fan(v);
  const Ring at = rings_[v];
  using Point = Vec3<Wide>;
  OwnQuadStar<Wide>& own = scratch.own;
  const auto point = [&](std::int32_t w) {
    const auto& p = scratch.points[w];
    return widen<T>(Vec3<T>{p[0], p[1], p[2]});
  };
  own.gather(mesh, v, point);
  QuadStar<Wide>& star = own.star;
  const std::span<const StarTags> steps = scratch.semi_sharp.steps(v);
  int start = 0;
  if constexpr (std::is_floating_point_v<T>) {
    if (!star.open)
      start = static_cast<int>(canonical_start(star.ring, static_cast<std::size_t>(star.size()), 2));
  }
  std::rotate(star.ring, star.ring + start, star.ring + star.size());
  for (int k = 0; k < star.faces; ++k) {
    const int slot = (k + star.faces - start / 2) % star.faces;
    const int e = slot > 0 ? 2 * slot - 2 : star.open ? -1 : 2 * star.faces - 2;
    corners_[fan[k]] = {
        v, e < 0 ? -1 : at.first + 3 * e, at.entries, star.open, false, false, !steps.empty()};
  }

  const Point c = star.centre;
  Point de{}, df{};
  if (star.open) {
    de = (star.edge(0) - c) + (star.edge(star.faces) - c);
  } else {
    for (int k = 0; k < star.faces; ++k) de = de + (star.edge(k) - c), df = df + (star.face(k) - c);
  }

  auto& head = heads_[v];
  const auto put = [](const Point& wide, T* to) {
    const Vec3<T> p = narrow<T>(wide);
    to[0] = p.x, to[1] = p.y, to[2] = p.z;
  };
  const auto weights = detail::sum_weights(star);
  for (std::size_t k = 0; k < weights.size(); ++k) head[k] = static_cast<T>(weights[k]);
  put(c, head.data() + QuadCornerBlock::kCentre);
  put(de, head.data() + QuadCornerBlock::kEdges);
  put(df, head.data() + QuadCornerBlock::kFaces);
  T* out = numbers_.data() + at.first;
  for (int copy = 0; copy < (star.open ? 1 : 2); ++copy)
    for (int k = 0; k < star.size(); ++k, out += 3) put(star.ring[k], out);

  if (!steps.empty()) {  // which know the edges by their numbers in the adjacency
    own.gather(mesh, v, point);
    for (const StarTags& tags : steps) own.subdivide(&tags);
  }
  const LimitFrame<Wide> limit = star_limit(star, scratch.weights.of(star.faces, star.open, star.kind));
  const Point origin = widen<T>(Vec3<T>{placement_.centre[0], placement_.centre[1], placement_.centre[2]});
  put(NumberTraits<T>::widen(placement_.unit) * limit.position + origin,
      head.data() + QuadCornerBlock::kLimit);
  if (star.kind == VertexKind::kDart) make_dart(v, own);
  T* const direction = head.data() + QuadCornerBlock::kLimit + 3;
  if constexpr (std::is_floating_point_v<T>) {
    bool degenerate = false;
    put(star_normal(limit, own, degenerate), direction);  // may subdivide the star
    if (degenerate) ++degenerate_normals_;
  } else {
    put(tangent_ == 0 ? limit.du : limit.dv, direction);
  }
  for (std::size_t k = QuadCornerBlock::kLimit + 3; k < QuadCornerBlock::kHead; ++k) head[k] = head[k] + T(0);
}

template <class T>
void BasicQuadRings<T>::make_dart(std::int32_t v, const OwnQuadStar<Wide>& own) {
  using S = typename NumberTraits<Wide>::Scalar;
  OwnQuadStar<Wide> star;
  star.copy(own);
  if (darts_.empty()) darts_.resize(rings_.size());
  darts_[v] = std::make_unique<DartMoves>();
  S scale(1);
  for (int level = 0; level < kMaxDepth; ++level) {
    const Vec3<Wide> before = star.star.centre;
    star.subdivide();
    scale = S(4) * scale;
    const Vec3<T> moved = narrow<T>(scale * (star.star.centre - before));
    (*darts_[v])[level] = {moved.x, moved.y, moved.z};
  }
}

template <class T>
void BasicQuadRings<T>::find_kinds(const QuadMesh& mesh) {
  const QuadAdjacency& adjacency = mesh.adjacency;
  kinds_.resize(static_cast<std::size_t>(adjacency.face_count()));
  const auto regular = [&](std::int32_t h) {
    return !corners_[h].open && !corners_[h].semi_sharp && corners_[h].entries == 8 &&
           mesh.kind(corners_[h].vertex) == VertexKind::kPlain;
  };
  for (std::int32_t f = 0; f < adjacency.face_count(); ++f) {
    bool all = true, open = false, semi_sharp = false;
    for (std::int32_t h = 4 * f; h < 4 * f + 4; ++h) {
      corners_[h].sharp = adjacency.twin(h) < 0;
      corners_[h].polynomial = regular(h) && regular(QuadAdjacency::next(h));
      all = all && regular(h);
      open = open || corners_[h].open;
      semi_sharp = semi_sharp || corners_[h].semi_sharp;
    }
    kinds_[f] = semi_sharp ? QuadClass::kSemiSharp
                : all      ? QuadClass::kRegular
                : open     ? QuadClass::kOpen
                           : QuadClass::kClosed;
  }
}

}  // namespace limitcheck::fast::row_stream
