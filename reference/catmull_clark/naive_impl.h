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

/// procedure subdiv(face, depth) of section 4; the quad's corner (0, 0) is lattice point (i, j).
template <class N>
void subdivide(const RingedQuad<Vec3<N>>& quad, int depth, std::int32_t i, std::int32_t j,
               const std::function<void(const LeafQuad<N>&)>& emit) {
  static constexpr std::array<std::array<std::int32_t, 2>, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  if (depth == 0) {
    LeafQuad<N> leaf;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& c = quad.corner[k];
      const Normal<N> normal = limit_normal(c, limit_tangents(c));
      leaf[k] = {limit_position(c), normal.direction, normal.kind, i + corners[k][0], j + corners[k][1]};
    }
    emit(leaf);
    return;
  }
  const SubdividedQuad<N> next(quad);
  const std::int32_t half = 1 << (depth - 1);
  for (std::size_t k = 0; k < 4; ++k)
    subdivide<N>(next.subquad(static_cast<int>(k)), depth - 1, i + half * corners[k][0],
                 j + half * corners[k][1], emit);
}

}  // namespace detail

template <class N>
NaiveSubdivider<N>::NaiveSubdivider(data::Faces faces, std::vector<Vec3<N>> positions)
    : mesh_(std::make_unique<const QuadMesh<N>>(std::move(faces), std::move(positions))) {}
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
  const auto quad = [&](std::size_t q) {
    return gather<Vec3<N>>(mesh_->topology, q,
                           [&](std::int32_t v) { return mesh_->positions[static_cast<std::size_t>(v)]; });
  };
  if (!stepped) {
    detail::subdivide<N>(quad(face), depth, 0, 0, emit);
  } else if (corners != 4) {
    detail::subdivide<N>(quad(mesh_->given.first_corner(face) + corner), depth - 1, 0, 0, emit);
  } else if (depth == 0) {  // a quad among other faces: its corners' limits, which the step did not change
    LeafQuad<N> leaf;
    for (std::size_t k = 0; k < 4; ++k)
      detail::subdivide<N>(quad(mesh_->given.first_corner(face) + k), 0, 0, 0,
                           [&](const LeafQuad<N>& child) { leaf[k] = child[k]; });
    emit(leaf);
  } else {
    const std::int32_t half = 1 << (depth - 1);
    for (std::size_t k = 0; k < 4; ++k)
      detail::subdivide<N>(quad(mesh_->given.first_corner(face) + k), depth - 1, k == 1 || k == 2 ? half : 0,
                           k >= 2 ? half : 0, emit);
  }
}

}  // namespace limitcheck::reference::catmull_clark
