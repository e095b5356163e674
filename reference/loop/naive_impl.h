// SPDX-License-Identifier: MIT
// Definitions behind naive.h, for the .cpp files that instantiate them.
#pragma once

#include "data/error.h"
#include "reference/loop/naive.h"
#include "reference/loop/refine.h"
#include "reference/loop/ringed_face.h"
#include "reference/loop/vertex_limit.h"

namespace limitcheck::reference {
namespace detail {

using LatticePoint = std::array<std::int32_t, 2>;

/// procedure subdiv(face, depth) of section 4. `lattice` holds the corners in units of 2^-depth.
template <class N>
void subdivide(const RingedFace<N>& face, int depth, const std::array<LatticePoint, 3>& lattice,
               const std::function<void(const LeafTriangle<N>&)>& emit) {
  if (depth == 0) {
    LeafTriangle<N> leaf;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& c = face.corner[k];
      const VertexLimit<N> limit = vertex_limit<N>(c.point, c.span(), c.on_boundary, face.weights);
      leaf[k] = {limit.position, limit.normal.direction, limit.normal.kind, lattice[k][0], lattice[k][1]};
    }
    emit(leaf);
    return;
  }
  const SubdividedFace<N> next(face);
  std::array<LatticePoint, 3> middle;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t m = 0; m < 2; ++m) middle[k][m] = (lattice[k][m] + lattice[(k + 1) % 3][m]) / 2;
  for (std::size_t k = 0; k < 3; ++k)
    subdivide<N>(next.subface(static_cast<int>(k)), depth - 1, {lattice[k], middle[k], middle[(k + 2) % 3]},
                 emit);
  subdivide<N>(next.subface(3), depth - 1, middle, emit);
}

}  // namespace detail

template <class N>
NaiveSubdivider<N>::NaiveSubdivider(const data::ControlMesh& mesh, Weights weights)
    : NaiveSubdivider(positions_of<N>(mesh), triangles_of(mesh).to_vector(), weights) {
  if (!mesh.sharpness.empty()) throw data::ArgumentError("sharp edges are not for the naive subdivider");
}

template <class N>
NaiveSubdivider<N>::NaiveSubdivider(std::vector<Vec3<N>> positions, const std::vector<Triangle>& triangles,
                                    Weights weights)
    : topology_(positions.size(), triangles), positions_(std::move(positions)), weights_(weights) {}

template <class N>
void NaiveSubdivider<N>::tessellate(std::size_t face, int depth,
                                    const std::function<void(const LeafTriangle<N>&)>& emit) const {
  if (face >= face_count()) throw data::ArgumentError("no face " + std::to_string(face));
  if (depth < 0 || depth > 30) throw data::ArgumentError("depth must be 0..30");
  const std::int32_t size = 1 << depth;
  detail::subdivide<N>(RingedFace<N>::gather(topology_, positions_, face, weights_), depth,
                       {{{0, 0}, {size, 0}, {0, size}}}, emit);
}

}  // namespace limitcheck::reference
