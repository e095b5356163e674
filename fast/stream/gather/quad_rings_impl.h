// SPDX-License-Identifier: MIT
// BasicQuadRings for any number; quad_rings_instances.cpp has those of float and double.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "data/error.h"
#include "fast/rules/prepared_quads.h"
#include "fast/stream/gather/quad_rings.h"
#include "fast/stream/gather/rings_impl.h"

namespace limitcheck::fast::row_stream {

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
    : placement_(placed.placement), tangent_(tangent) {
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
  star.resize(own.star.faces, own.star.open, own.star.kind);
  star.star.centre = own.star.centre;
  std::copy_n(own.star.ring, own.star.size(), star.star.ring);
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
