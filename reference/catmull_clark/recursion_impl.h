// SPDX-License-Identifier: MIT
// Definitions behind recursion.h, for the .cpp files that instantiate them.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "data/error.h"
#include "reference/catmull_clark/patch.h"
#include "reference/catmull_clark/recursion.h"
#include "reference/catmull_clark/refine.h"
#include "reference/catmull_clark/vertex_limit.h"
#include "reference/point/parameter_exact.h"

namespace limitcheck::reference::catmull_clark {

namespace detail {

inline constexpr std::array<std::array<std::int32_t, 2>, 4> kCorners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

/// A quad with its neighbourhood.
template <class N>
RingedQuad<Vec3<N>> ringed(const QuadMesh<N>& mesh, std::size_t quad) {
  return gather<Vec3<N>>(
      mesh.topology, quad, [&](std::int32_t v) { return mesh.positions[static_cast<std::size_t>(v)]; },
      mesh.states);
}

/// procedure subdiv(face, depth) of section 4; the quad's corner (0, 0) is lattice point (i, j).
template <class N>
void subdivide(const RingedQuad<Vec3<N>>& quad, int depth, std::int32_t i, std::int32_t j,
               const std::function<void(const LeafQuad<N>&)>& emit) {
  if (depth == 0) {
    LeafQuad<N> leaf;
    for (std::size_t k = 0; k < 4; ++k) {
      const VertexLimit<N> limit = limit_of(quad.corner[k]);
      leaf[k] = {limit.position, limit.normal.direction, limit.normal.kind, i + kCorners[k][0],
                 j + kCorners[k][1]};
    }
    emit(leaf);
    return;
  }
  const SubdividedQuad<N> next(quad);
  const std::int32_t half = 1 << (depth - 1);
  for (std::size_t k = 0; k < 4; ++k)
    subdivide<N>(next.subquad(static_cast<int>(k)), depth - 1, i + half * kCorners[k][0],
                 j + half * kCorners[k][1], emit);
}

/// The same of quad 0 of a few quads with semi-sharp tags.
template <class N>
void subdivide_tagged(TaggedMesh<N> near, int depth, std::int32_t i, std::int32_t j,
                      const std::function<void(const LeafQuad<N>&)>& emit) {
  const auto stepped = [](const TaggedMesh<N>& mesh) {
    return refine_once(mesh, data::TriangleRule::kCatmark);
  };
  if (near.is_settled(0)) return subdivide<N>(ringed(QuadMesh<N>(std::move(near)), 0), depth, i, j, emit);
  if (depth > 0) {
    const TaggedMesh<N> next = stepped(near);
    const std::int32_t half = 1 << (depth - 1);
    for (std::size_t k = 0; k < 4; ++k)
      subdivide_tagged<N>(next.around(k), depth - 1, i + half * kCorners[k][0], j + half * kCorners[k][1],
                          emit);
    return;
  }
  LeafQuad<N> leaf;
  for (std::size_t k = 0; k < 4; ++k) {
    TaggedMesh<N> at_corner = near;  // a quad's sub-quad at corner k has that corner for its own number k
    while (!at_corner.is_settled(0)) at_corner = stepped(at_corner).around(k);
    subdivide<N>(ringed(QuadMesh<N>(std::move(at_corner)), 0), 0, i, j,
                 [&](const LeafQuad<N>& l) { leaf[k] = l[k]; });
  }
  emit(leaf);
}

}  // namespace detail

template <class N>
NaiveSubdivider<N>::NaiveSubdivider(data::Faces faces, std::vector<Vec3<N>> positions, const SharpTags& tags)
    : mesh_(std::make_shared<const QuadMesh<N>>(std::move(faces), std::move(positions), tags)) {}

template <class N>
std::size_t NaiveSubdivider<N>::face_count() const {
  return mesh_->face_count();
}

template <class N>
void NaiveSubdivider<N>::tessellate(std::size_t face, std::size_t corner, int depth,
                                    const std::function<void(const LeafQuad<N>&)>& emit) const {
  const auto refuse = [](const std::string& why) { throw data::ArgumentError(why); };
  if (face >= face_count()) refuse("no face " + std::to_string(face));
  if (depth < 0 || depth > 30) refuse("depth must be 0..30");
  const bool stepped = mesh_->given.size() > 0;
  const std::size_t corners = stepped ? mesh_->given[face].size() : 4;
  if (corner >= (corners == 4 ? 1 : corners)) refuse("no corner " + std::to_string(corner));
  if (corners != 4 && depth == 0) refuse("a face that is no quad has no leaves at depth 0");
  using Emit = std::function<void(const LeafQuad<N>&)>;
  const auto run = [&](std::size_t q, int levels, std::int32_t i, std::int32_t j, const Emit& to) {
    if (mesh_->is_settled(q))
      detail::subdivide<N>(detail::ringed(*mesh_, q), levels, i, j, to);
    else
      detail::subdivide_tagged<N>(mesh_->tagged->around(q), levels, i, j, to);
  };
  if (!stepped) {
    run(face, depth, 0, 0, emit);
  } else if (corners != 4) {
    run(mesh_->given.first_corner(face) + corner, depth - 1, 0, 0, emit);
  } else if (depth == 0) {  // a quad among other faces: its corners' limits, which the step did not change
    LeafQuad<N> leaf;
    for (std::size_t k = 0; k < 4; ++k)
      run(mesh_->given.first_corner(face) + k, 0, 0, 0,
          [&](const LeafQuad<N>& child) { leaf[k] = child[k]; });
    emit(leaf);
  } else {
    const std::int32_t half = 1 << (depth - 1);
    for (std::size_t k = 0; k < 4; ++k)
      run(mesh_->given.first_corner(face) + k, depth - 1, k == 1 || k == 2 ? half : 0, k >= 2 ? half : 0,
          emit);
  }
}

template <class N>
RefinedMesh<N>::RefinedMesh(data::Faces faces, std::vector<Vec3<N>> positions, const SharpTags& tags)
    : given_(std::move(faces)),
      topology_(positions.size(), given_),
      positions_(std::move(positions)),
      sharpness_(tags.empty() ? nullptr : std::make_shared<const Sharpness>(topology_, tags)),
      triangles_(tags.triangles) {}

template <class N>
void RefinedMesh<N>::refine() {
  if (sharpness_) {
    TaggedMesh<N> next =
        refine_once(TaggedMesh<N>{std::move(topology_), std::move(positions_), *sharpness_}, triangles_);
    topology_ = std::move(next.topology);
    positions_ = std::move(next.positions);
    sharpness_ = std::make_shared<const Sharpness>(std::move(next.sharpness));
    ++depth_;
    return;
  }
  std::vector<Vec3<N>> positions = points_after_step(topology_, positions_);
  topology_ = Topology(positions.size(), refined_faces(topology_));
  positions_ = std::move(positions);
  ++depth_;
}

template <class N>
std::int32_t RefinedMesh<N>::vertex(std::size_t face, std::size_t corner, int i, int j) const {
  const auto refuse = [](const std::string& why) { throw data::ArgumentError(why); };
  if (face >= given_.size()) refuse("no face " + std::to_string(face));
  const bool is_quad = given_[face].size() == 4;
  const int depth = is_quad ? depth_ : depth_ - 1;
  if (depth < 0) refuse("a face that is no quad has no lattice at depth 0");
  if (corner >= (is_quad ? 1 : given_[face].size())) refuse("no corner " + std::to_string(corner));
  const int side = 1 << depth;
  if (i < 0 || j < 0 || i > side || j > side) refuse("no lattice point");
  // The cell that has the point as a corner, found bit by bit: the quads of a step follow in the order of the
  // corners.
  static constexpr int kCorner[2][2] = {{0, 1}, {3, 2}};
  const int x = i == side ? i - 1 : i, y = j == side ? j - 1 : j;
  std::size_t cell = is_quad ? face : given_.first_corner(face) + corner;
  for (int bit = depth - 1; bit >= 0; --bit) {
    const auto k = static_cast<std::size_t>(kCorner[(y >> bit) & 1][(x >> bit) & 1]);
    // The first step numbers the corners of all faces through, later ones have quads only.
    cell = bit == depth - 1 && is_quad ? given_.first_corner(face) + k : 4 * cell + k;
  }
  return topology_.faces()[cell][static_cast<std::size_t>(kCorner[j - y][i - x])];
}

template <class N>
VertexLimits<N> RefinedMesh<N>::limits() const {
  bool only_quads = true;
  for (std::size_t f = 0; f < topology_.faces().size(); ++f)
    only_quads = only_quads && topology_.faces()[f].size() == 4;
  if (!only_quads) {  // the vertices come first after one more step, and have the same limits
    RefinedMesh finer = *this;
    finer.refine();
    VertexLimits<N> all = finer.limits();
    all.positions.resize(positions_.size());
    all.normals.resize(positions_.size());
    all.kinds.resize(positions_.size());
    return all;
  }
  const auto gathered = [](const Topology& topology, const std::vector<Vec3<N>>& positions, std::size_t v,
                           std::span<const VertexState> states) {
    return gather_vertex<Vec3<N>>(
        topology, static_cast<std::int32_t>(v),
        [&](std::int32_t p) { return positions[static_cast<std::size_t>(p)]; }, states);
  };
  std::optional<QuadMesh<N>> cut;
  if (sharpness_) cut.emplace(TaggedMesh<N>{topology_, positions_, *sharpness_});
  const auto ring_of = [&](std::size_t v) {
    if (!cut) return gathered(topology_, positions_, v, {});
    const Sector sector = topology_.sector(static_cast<std::int32_t>(v));
    if (sector.faces.empty() || cut->is_settled(static_cast<std::size_t>(sector.faces[0])))
      return gathered(cut->topology, cut->positions, v, cut->states);
    const auto face = static_cast<std::size_t>(sector.faces[0]);
    const auto corners = topology_.faces()[face];
    const auto k = static_cast<std::size_t>(
        std::find(corners.begin(), corners.end(), static_cast<std::int32_t>(v)) - corners.begin());
    double right = k == 1 || k == 2 ? 1 : 0, up = k >= 2 ? 1 : 0;
    long steps = 0;
    const QuadMesh<N> near = settled_around(*cut->tagged, face, right, up, steps);
    return gathered(near.topology, near.positions, static_cast<std::size_t>(near.topology.faces()[0][k]),
                    near.states);
  };
  VertexLimits<N> limits;
  for (std::size_t v = 0; v < positions_.size(); ++v) {
    const auto corner = ring_of(v);
    if (corner.faces.empty()) {  // no face has it
      limits.add(positions_[v], {N(0), N(0), N(1)}, NormalKind::kArbitrary);
      continue;
    }
    const VertexLimit<N> limit = limit_of(corner);
    limits.add(limit.position, limit.normal.direction, limit.normal.kind);
  }
  return limits;
}

template <class N>
SubdivisionEvaluator<N>::SubdivisionEvaluator(data::Faces faces, std::vector<Vec3<N>> positions,
                                              const SharpTags& tags)
    : mesh_(std::make_shared<const QuadMesh<N>>(std::move(faces), std::move(positions), tags)) {}

template <class N>
int SubdivisionEvaluator<N>::face_count() const {
  return static_cast<int>(mesh_->face_count());
}

template <class N>
SurfacePoint<N> SubdivisionEvaluator<N>::evaluate(int face, int corner, const Parameter& u,
                                                  const Parameter& v, Derivatives order) const {
  QuadParameter<Rational> at = locate(*mesh_, face, corner, exact_value(u), exact_value(v));
  long level = 0;
  RingedQuad<Vec3<N>> quad =
      mesh_->is_settled(at.quad)
          ? detail::ringed(*mesh_, at.quad)
          : detail::ringed(settled_around(*mesh_->tagged, at.quad, at.u, at.v, level), 0);
  const Vec3<N> fallback =
      area_of(quad.corner[0].point, quad.corner[1].point, quad.corner[2].point, quad.corner[3].point);
  const long steps = level;
  level += at.halved ? 1 : 0;
  while (!quad.is_regular()) {
    const Rational half(1, 2);
    const bool right = at.u > half, up = at.v > half;
    const std::size_t k = up ? (right ? 2 : 3) : (right ? 1 : 0);
    if (at.u == (right ? 1 : 0) && at.v == (up ? 1 : 0) && !quad.corner[k].is_regular()) {
      const RingedCorner<Vec3<N>>& c = quad.corner[k];
      SurfacePoint<N> result = extraordinary_corner<N>(
          limit_of(c), {c.face_count(), c.sector, c.on_boundary, c.state}, k, at.halved, order);
      if (steps > 0) scale_derivatives(result, NumberTraits<N>::scale(N(1), steps));
      return result;
    }
    quad = SubdividedQuad<N>(quad).subquad(static_cast<int>(k));
    at.u = 2 * at.u - (right ? 1 : 0);
    at.v = 2 * at.v - (up ? 1 : 0);
    ++level;
  }
  const LocalPoint<N> p =
      evaluate_patch<N>(quad.patch(ghost_point<N>), number_from<N>(at.u), number_from<N>(at.v), order);
  SurfacePoint<N> result;
  result.position = p.position;
  set_derivatives(result, p, turn_of(0), NumberTraits<N>::scale(N(1), level),
                  NumberTraits<N>::scale(N(1), 2 * level), order);
  if (order != Derivatives::kPosition) set_normal(result, tangents_of(result), fallback);
  return result;
}

}  // namespace limitcheck::reference::catmull_clark
