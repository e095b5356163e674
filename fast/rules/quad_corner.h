// SPDX-License-Identifier: MIT
// The corner of a quad with its whole ring, from level to level; limits of the points between corners.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "fast/rules/prepared_quads.h"

namespace limitcheck::fast {

/// A control vertex as a corner of one quad, which lies between edge(sector) and edge(sector + 1).
template <class N, class Vertex>
struct QuadCorner {
  QuadStar<N> star;
  int sector = 0;
  std::span<const StarTags> tags;  // of the steps to come
  const Vertex* limit = nullptr;
  bool by_sums = false;  // closed, smooth from the start: the centre comes from the sums below
  WideVec3<N> centre{};  // before it was rounded
  StarSums<typename NumberTraits<N>::Wide> sums{};

  bool has_left() const { return star.has_face(sector + 1); }   // a face beyond edge(sector + 1)
  bool has_right() const { return star.has_face(sector - 1); }  // a face beyond edge(sector)
  const Vec3<N>& along() const { return star.edge(sector); }
  const Vec3<N>& opposite() const { return star.face(sector); }
  /// The next edges of the ring, if there are such faces.
  const Vec3<N>& beyond_left() const { return star.edge(sector + 2); }
  const Vec3<N>& beyond_right() const { return star.edge(sector - 1); }
};

/// Fills a corner from the mesh: half-edge h leaves it with the quad to its left.
///   storage   room for 2 n + 1 points, n = the number of faces there
template <class N, class Surface>
QuadCorner<N, typename Surface::Vertex> gather_corner(const PreparedQuads<N, Surface>& mesh, std::int32_t h,
                                                      Vec3<N>* storage) {
  const QuadAdjacency& adjacency = mesh.mesh().adjacency;
  const std::int32_t v = adjacency.origin(h);
  const auto fan = adjacency.fan(v);
  QuadCorner<N, typename Surface::Vertex> corner;
  corner.star = {mesh.position(v), storage, static_cast<int>(fan.size()), adjacency.on_boundary(v),
                 mesh.mesh().kind(v)};
  corner.sector = mesh.slot(h);
  corner.limit = &mesh.limit(v);
  corner.tags = mesh.semi_sharp().steps(v);
  corner.by_sums = !corner.star.open && corner.star.kind == VertexKind::kPlain && corner.tags.empty();
  corner.centre = widen<N>(corner.star.centre);
  corner.sums = {mesh.sums(v).edges, mesh.sums(v).faces};
  for (const std::int32_t k : fan) {
    *storage++ = mesh.position(adjacency.target(k));
    *storage++ = mesh.position(adjacency.target(QuadAdjacency::next(k)));
  }
  if (corner.star.open) *storage = mesh.position(adjacency.origin(QuadAdjacency::prev(fan.back())));
  return corner;
}

/// One step into another corner, which keeps its memory. Smooth vertices: with De, Df the sums of e_i - c and
/// f_i - c, c' = c + 3/(2n^2) De + 1/(4n^2) Df, De' = (1/2 - 3/(2n)) De + (1/8 - 1/(4n)) Df and
/// Df' = (1/2 - 3/(2n)) De + (1/4 - 1/(4n)) Df.
template <class N, class Vertex>
void subdivide_corner(const QuadCorner<N, Vertex>& old, QuadCorner<N, Vertex>& out) {
  Vec3<N>* const storage = out.star.ring;
  out = old;
  out.star.ring = storage;
  const StarTags* tags = old.tags.empty() ? nullptr : old.tags.data();
  subdivide_ring(old.star, tags, out.star);
  if (!old.tags.empty()) out.tags = old.tags.subspan(1);
  if (!old.by_sums) {
    out.star.centre = subdivide_centre(old.star, tags, out.star);
    return;
  }
  using T = NumberTraits<typename NumberTraits<N>::Wide>;
  const int n = old.star.faces;
  const auto& [edges, faces] = old.sums;
  const WideVec3<N> shrunk = T::ratio(n - 3, 2 * n) * edges;
  out.centre = old.centre + (T::ratio(3, 2 * n * n) * edges + T::ratio(1, 4 * n * n) * faces);
  out.sums.edges = shrunk + T::ratio(n - 2, 8 * n) * faces;
  out.sums.faces = shrunk + T::ratio(n - 1, 4 * n) * faces;
  out.star.centre = narrow<N>(out.centre);
}

namespace detail {

/// The normal that takes the place of one that is lost, for a star of these points: closed, or open if there
/// is an odd number. Linear numbers have no sizes, and no need of it.
template <class N, class Surface, std::size_t kPoints>
WideVec3<N> substitute_normal_of(const Vec3<N>& v, const std::array<const Vec3<N>*, kPoints>& ring) {
  if constexpr (requires { Surface::kLinear; }) {
    return {};
  } else {
    OwnQuadStar<typename NumberTraits<N>::Wide> own;
    own.resize(static_cast<int>(kPoints / 2), kPoints % 2 == 1, VertexKind::kPlain);
    own.star.centre = widen<N>(v);
    for (std::size_t i = 0; i < kPoints; ++i) own.star.ring[i] = widen<N>(*ring[i]);
    return substitute_star_normal(own, kParallel<N>);
  }
}

}  // namespace detail

/// Limit vertices of regular points from their neighbours.
template <class N, class Surface>
typename Surface::Vertex quad_vertex_limit(const Vec3<N>& v, const QuadNeighbours<N>& r,
                                           std::int64_t& zero_normals) {
  return Surface::vertex(
      regular_quad_limit(v, r),
      [&] {
        return detail::substitute_normal_of<N, Surface>(
            v, std::array<const Vec3<N>*, 8>{&r.e, &r.ne, &r.n, &r.nw, &r.w, &r.sw, &r.s, &r.se});
      },
      zero_normals);
}

/// On a boundary, ring e, ne, n, nw, w counter-clockwise.
template <class N, class Surface>
typename Surface::Vertex quad_boundary_limit(const Vec3<N>& v, const Vec3<N>& e, const Vec3<N>& ne,
                                             const Vec3<N>& n, const Vec3<N>& nw, const Vec3<N>& w,
                                             std::int64_t& zero_normals) {
  return Surface::vertex(
      regular_quad_boundary_limit(v, e, ne, n, nw, w),
      [&] {
        return detail::substitute_normal_of<N, Surface>(v,
                                                        std::array<const Vec3<N>*, 5>{&e, &ne, &n, &nw, &w});
      },
      zero_normals);
}

/// Of a point inside a semi-sharp edge: e lies on it, before `after`, and w on the part before it. Allocates.
template <class N, class Surface>
typename Surface::Vertex semi_sharp_limit(const Vec3<N>& v, const QuadNeighbours<N>& r,
                                          const SidePart& before, const SidePart& after,
                                          data::Creasing creasing, std::int64_t& zero_normals) {
  using Wide = typename NumberTraits<N>::Wide;
  OwnQuadStar<Wide> own;
  own.resize(4, false, VertexKind::kPlain);
  own.star.centre = widen<N>(v);
  const Vec3<N>* ring[] = {&r.e, &r.ne, &r.n, &r.nw, &r.w, &r.sw, &r.s, &r.se};
  for (std::size_t i = 0; i < 8; ++i) own.star.ring[i] = widen<N>(*ring[i]);
  for (const StarTags& tags : straight_steps(before, after, creasing)) own.subdivide(&tags);
  const auto at = [&](int i) -> const Vec3<Wide>& { return own.star.ring[i]; };
  const LimitFrame<Wide> limit = regular_quad_limit(
      own.star.centre, QuadNeighbours<Wide>{at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7)});
  return Surface::vertex(
      LimitFrame<N>{narrow<N>(limit.position), narrow<N>(limit.du), narrow<N>(limit.dv)},
      [&]() -> Vec3<Wide> {
        if constexpr (requires { Surface::kLinear; })
          return {};
        else
          return substitute_star_normal<Wide>(own, kParallel<N>);
      },
      zero_normals);
}

}  // namespace limitcheck::fast
