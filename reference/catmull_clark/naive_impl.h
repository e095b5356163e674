// SPDX-License-Identifier: MIT
// Definitions behind naive.h, for the .cpp files that instantiate them.
#pragma once

#include <string>
#include <utility>

#include "data/error.h"
#include "reference/catmull_clark/naive.h"
#include "reference/catmull_clark/refine.h"
#include "reference/catmull_clark/vertex_limit.h"

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
      const auto& c = quad.corner[k];
      const Normal<N> normal = limit_normal(c, limit_tangents(c));
      leaf[k] = {limit_position(c), normal.direction, normal.kind, i + kCorners[k][0], j + kCorners[k][1]};
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
  const auto settled = [](const TaggedMesh<N>& mesh) {
    return !mesh.sharpness.needs_a_step(mesh.topology)[0];
  };
  const auto stepped = [](const TaggedMesh<N>& mesh) {
    return refine_once(mesh, data::TriangleRule::kCatmark);
  };
  if (settled(near)) return subdivide<N>(ringed(QuadMesh<N>(std::move(near)), 0), depth, i, j, emit);
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
    while (!settled(at_corner)) at_corner = stepped(at_corner).around(k);
    subdivide<N>(ringed(QuadMesh<N>(std::move(at_corner)), 0), 0, i, j,
                 [&](const LeafQuad<N>& l) { leaf[k] = l[k]; });
  }
  emit(leaf);
}

}  // namespace detail

template <class N>
NaiveSubdivider<N>::NaiveSubdivider(data::Faces faces, std::vector<Vec3<N>> positions, const SharpTags& tags)
    : mesh_(std::make_unique<const QuadMesh<N>>(std::move(faces), std::move(positions), tags)) {}
template <class N>
NaiveSubdivider<N>::~NaiveSubdivider() = default;
template <class N>
NaiveSubdivider<N>::NaiveSubdivider(NaiveSubdivider&&) noexcept = default;
template <class N>
NaiveSubdivider<N>& NaiveSubdivider<N>::operator=(NaiveSubdivider&&) noexcept = default;

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

}  // namespace limitcheck::reference::catmull_clark
