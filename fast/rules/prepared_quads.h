// SPDX-License-Identifier: MIT
// A mesh of quads as the kernels read it: what steps make of its semi-sharp edges, the limit points of its
// vertices, the corner of a quad with its whole ring from level to level, and the limits between corners.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "fast/mesh/cut_mesh.h"
#include "fast/rules/limit.h"
#include "fast/rules/quad_limit.h"
#include "fast/rules/quad_star.h"

namespace limitcheck::fast {

/// The share of the midpoint in the point of an edge of this sharpness, whose halves get the others. Chaikin:
/// an edge below 1 with halves that stay sharp is a midpoint.
double edge_crease_share(double sharpness, double half, double other_half);

/// The share of the curve's rule in the point between two edges of these sharpnesses that go straight on.
double curve_share(double before, double after, data::Creasing creasing);

/// Part i of an edge that was cut into parts, and what the next step makes of it: the halves at either end.
struct SidePart {
  double sharpness = 0, first_half = 0, second_half = 0;
};

/// All steps of a point inside a semi-sharp edge, between two parts of it, for a star of four faces with the
/// parts along edges 0 (`after`) and 2 (`before`).
std::vector<StarTags> straight_steps(const SidePart& before, const SidePart& after, data::Creasing creasing);

/// The tags of every vertex for each of the steps in which it has some. Read-only once made.
class SemiSharp {
 public:
  explicit SemiSharp(const QuadMesh& mesh);

  /// One entry per step, at most 10; none at a vertex where nothing is semi-sharp.
  std::span<const StarTags> steps(std::int32_t v) const {
    return steps_.empty() ? std::span<const StarTags>{} : std::span<const StarTags>(steps_[v]);
  }
  const StarTags* step(std::int32_t v, std::size_t level) const {
    const auto all = steps(v);
    return level < all.size() ? &all[level] : nullptr;
  }

  /// The sharpness of the 2^level parts of half-edge h, from its origin on, for level = 0 .. levels, one
  /// level after the other; empty if the edge is not semi-sharp.
  void along(std::int32_t h, int levels, std::vector<double>& out) const;
  bool has(std::int32_t h) const { return !steps_.empty() && mesh_->side_sharpness[h] > 0; }

 private:
  const QuadMesh* mesh_;
  std::vector<std::vector<StarTags>> steps_;
};

/// The unit normal of a vertex, see normal_or_substitute(), with substitute_star_normal().
///   own   is subdivided then
template <class W>
Vec3<W> star_normal(const LimitFrame<W>& limit, OwnQuadStar<W>& own, bool& degenerate) {
  const std::span<const Vec3<W>> ring(own.star.ring, static_cast<std::size_t>(own.star.size()));
  return normal_or_substitute(limit, own.star.centre, ring, degenerate,
                              std::numeric_limits<double>::infinity(),
                              [&] { return substitute_star_normal(own, kParallel<double>); });
}

/// The sums of e_i - c and f_i - c over a closed ring.
template <class W>
struct StarSums {
  Vec3<W> edges, faces;
};

/// Positions of the vertices in N and their limit points, computed once per mesh in a canonical order: the
/// ring from adjacency.outgoing(v). Every face that touches a vertex delivers these very bits, at whatever
/// depth. [D14] Read-only afterwards, so that threads may share it. Keeps a reference to the mesh, which must
/// outlive it.
template <class N, class Surface = LimitSurface<N>>
class PreparedQuads {
 public:
  using Vertex = typename Surface::Vertex;
  using Wide = typename NumberTraits<N>::Wide;

  using Sums = StarSums<Wide>;

  /// One position per vertex of the mesh.
  PreparedQuads(const QuadMesh& mesh, std::vector<Vec3<N>> positions)
      : mesh_(&mesh), positions_(std::move(positions)), semi_(mesh) {
    const QuadAdjacency& adjacency = mesh.adjacency;
    limits_.resize(positions_.size());
    sums_.resize(positions_.size());
    slot_.resize(4 * static_cast<std::size_t>(adjacency.face_count()));
    StarWeightTable<Weight> table;
    OwnQuadStar<Wide> own;
    for (std::int32_t v = 0; v < adjacency.vertex_count(); ++v) {
      const auto fan = adjacency.fan(v);
      if (fan.empty()) continue;
      for (std::size_t i = 0; i < fan.size(); ++i) slot_[fan[i]] = static_cast<std::int32_t>(i);
      own.gather(mesh, v, [&](std::int32_t w) { return widen<N>(position(w)); });
      for (int i = 0; i < own.star.faces; ++i) {
        sums_[v].edges = sums_[v].edges + (own.star.edge(i) - own.star.centre);
        sums_[v].faces = sums_[v].faces + (own.star.face(i) - own.star.centre);
      }
      for (const StarTags& tags : semi_.steps(v)) own.subdivide(&tags);
      limits_[v] = limit_of(own, table.of(own.star.faces, own.star.open, own.star.kind));
    }
  }
  PreparedQuads(QuadMesh&&, std::vector<Vec3<N>>) = delete;

  const QuadMesh& mesh() const { return *mesh_; }
  const Vec3<N>& position(std::int32_t v) const { return positions_[v]; }
  const Vertex& limit(std::int32_t v) const { return limits_[v]; }
  const Sums& sums(std::int32_t v) const { return sums_[v]; }
  const SemiSharp& semi_sharp() const { return semi_; }
  /// Which of its origin's edges a half-edge is.
  std::int32_t slot(std::int32_t h) const { return slot_[h]; }
  std::int64_t zero_normals() const { return zero_normals_; }

 private:
  using Weight = typename NumberTraits<Wide>::Scalar;

  Vertex limit_of(OwnQuadStar<Wide>& own, const StarWeights<Weight>& weights) {
    const LimitFrame<Wide> wide = star_limit(own.star, weights);
    return control_vertex<N, Surface>(wide, zero_normals_,
                                      [&](bool& degenerate) { return star_normal(wide, own, degenerate); });
  }

  const QuadMesh* mesh_;
  std::vector<Vec3<N>> positions_;
  std::vector<Vertex> limits_;
  std::vector<Sums> sums_;
  std::vector<std::int32_t> slot_;
  SemiSharp semi_;
  std::int64_t zero_normals_ = 0;
};

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
  QuadCorner<N, typename Surface::Vertex> corner;
  corner.star = {mesh.position(v), storage, static_cast<int>(adjacency.fan(v).size()),
                 adjacency.on_boundary(v), mesh.mesh().kind(v)};
  corner.sector = mesh.slot(h);
  corner.limit = &mesh.limit(v);
  corner.tags = mesh.semi_sharp().steps(v);
  corner.by_sums = !corner.star.open && corner.star.kind == VertexKind::kPlain && corner.tags.empty();
  corner.centre = widen<N>(corner.star.centre);
  corner.sums = {mesh.sums(v).edges, mesh.sums(v).faces};
  gather_ring(
      adjacency, v, [&](std::int32_t w) -> const Vec3<N>& { return mesh.position(w); }, storage);
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

/// The star of a point: closed, or open if there is an odd number of points around it.
template <class N, std::size_t kPoints>
void fill_star(const Vec3<N>& v, const std::array<const Vec3<N>*, kPoints>& ring,
               OwnQuadStar<typename NumberTraits<N>::Wide>& own) {
  own.resize(static_cast<int>(kPoints / 2), kPoints % 2 == 1, VertexKind::kPlain);
  own.star.centre = widen<N>(v);
  for (std::size_t i = 0; i < kPoints; ++i) own.star.ring[i] = widen<N>(*ring[i]);
}
template <class N>
std::array<const Vec3<N>*, 8> ring_of(const QuadNeighbours<N>& r) {
  return {&r.e, &r.ne, &r.n, &r.nw, &r.w, &r.sw, &r.s, &r.se};
}

/// The normal that takes the place of one that is lost, for such a star. Linear numbers have no sizes, and no
/// need of it.
template <class N, class Surface, std::size_t kPoints>
WideVec3<N> substitute_normal_of(const Vec3<N>& v, const std::array<const Vec3<N>*, kPoints>& ring) {
  if constexpr (requires { Surface::kLinear; }) {
    return {};
  } else {
    OwnQuadStar<typename NumberTraits<N>::Wide> own;
    fill_star(v, ring, own);
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
      [&] { return detail::substitute_normal_of<N, Surface>(v, detail::ring_of(r)); }, zero_normals);
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
  detail::fill_star(v, detail::ring_of(r), own);
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
