// SPDX-License-Identifier: MIT
// Definitions behind recursion.h, for the .cpp files that instantiate them.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <utility>

#include "data/error.h"
#include "reference/loop/patch.h"
#include "reference/loop/recursion.h"
#include "reference/loop/refine.h"
#include "reference/loop/ringed_face.h"
#include "reference/loop/sub_faces.h"
#include "reference/loop/vertex_limit.h"
#include "reference/point/parameter_exact.h"

namespace limitcheck::reference {
namespace detail {

using LatticePoint = std::array<std::int32_t, 2>;

/// Of sub-face k: three at the corners (c_k, e_k, e_{k-1}), then the middle one.
inline std::array<LatticePoint, 3> sub_lattice(const std::array<LatticePoint, 3>& lattice, std::size_t k) {
  std::array<LatticePoint, 3> middle;
  for (std::size_t e = 0; e < 3; ++e)
    for (std::size_t m = 0; m < 2; ++m) middle[e][m] = (lattice[e][m] + lattice[(e + 1) % 3][m]) / 2;
  if (k == 3) return middle;
  return {lattice[k], middle[k], middle[(k + 2) % 3]};
}

/// procedure subdiv(face, depth) of section 4. `lattice` holds the corners in units of 2^-depth.
template <class N>
void subdivide(const RingedFace<Vec3<N>>& face, int depth, const std::array<LatticePoint, 3>& lattice,
               Weights weights, const std::function<void(const LeafTriangle<N>&)>& emit) {
  if (depth == 0) {
    LeafTriangle<N> leaf;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& c = face.corner[k];
      const VertexLimit<N> limit = c.fan != nullptr
                                       ? c.fan->after(c.steps).limit
                                       : vertex_limit<N>(c.point, c.span(), c.on_boundary, weights, c.state);
      leaf[k] = {limit.position, limit.normal.direction, limit.normal.kind, lattice[k][0], lattice[k][1]};
    }
    emit(leaf);
    return;
  }
  const SubdividedFace<N> next(face, weights);
  for (std::size_t k = 0; k < 4; ++k)
    subdivide<N>(next.subface(static_cast<int>(k)), depth - 1, sub_lattice(lattice, k), weights, emit);
}

/// The same of face 0 of a few faces with semi-sharp tags.
template <class N>
void subdivide_tagged(TaggedMesh<N> near, int depth, const std::array<LatticePoint, 3>& lattice,
                      Weights weights, const std::function<void(const LeafTriangle<N>&)>& emit) {
  const auto ringed = [&](TaggedMesh<N> mesh) {
    const CutMesh<N> cut(std::move(mesh));
    return gather_triangle<N>(cut.topology, cut.positions, 0, cut.states);
  };
  if (near.is_settled(0)) return subdivide<N>(ringed(std::move(near)), depth, lattice, weights, emit);
  if (depth > 0) {
    const TaggedMesh<N> next = refine_once(near, weights);
    for (std::size_t k = 0; k < 4; ++k)
      subdivide_tagged<N>(next.around(k), depth - 1, sub_lattice(lattice, k), weights, emit);
    return;
  }
  LeafTriangle<N> leaf;
  for (std::size_t k = 0; k < 3; ++k) {
    TaggedMesh<N> at_corner = near;  // the corner is number k at first, and number 0 of the sub-face there
    std::size_t at = k;
    for (; !at_corner.is_settled(0); at = 0) at_corner = refine_once(at_corner, weights).around(at);
    subdivide<N>(ringed(std::move(at_corner)), 0, {}, weights,
                 [&](const LeafTriangle<N>& l) { leaf[k] = l[at]; });
    leaf[k].i = lattice[k][0], leaf[k].j = lattice[k][1];
  }
  emit(leaf);
}

}  // namespace detail

template <class N>
NaiveSubdivider<N>::NaiveSubdivider(const data::ControlMesh& mesh, Weights weights)
    : NaiveSubdivider(positions_of<N>(mesh), triangles_of(mesh).to_vector(), weights, mesh.sharpness) {}

template <class N>
NaiveSubdivider<N>::NaiveSubdivider(std::vector<Vec3<N>> positions, const std::vector<Triangle>& triangles,
                                    Weights weights, const SharpTags& tags)
    : mesh_(std::make_shared<const CutMesh<N>>(std::move(positions), data::Faces(triangles), tags)),
      weights_(weights) {
  auto fans = std::make_shared<std::map<std::int32_t, SteppedFan<Vec3<N>>>>();
  for (std::int32_t v = 0; std::cmp_less(v, mesh_->topology.vertex_count()); ++v) {
    const Sector sector = mesh_->topology.sector(v);
    if (!sector.closed || sector.faces.size() < SteppedFan<Vec3<N>>::kMany ||
        state_of(mesh_->states, v) != VertexState::kOrdinary)
      continue;
    std::vector<Vec3<N>> ring;
    for (const std::int32_t r : sector.neighbours)
      ring.push_back(mesh_->positions[static_cast<std::size_t>(r)]);
    fans->try_emplace(v, mesh_->positions[static_cast<std::size_t>(v)], std::move(ring), weights);
  }
  fans_ = std::move(fans);
}

template <class N>
std::size_t NaiveSubdivider<N>::face_count() const {
  return mesh_->topology.faces().size();
}

template <class N>
void NaiveSubdivider<N>::tessellate(std::size_t face, int depth,
                                    const std::function<void(const LeafTriangle<N>&)>& emit) const {
  if (face >= face_count()) throw data::ArgumentError("no face " + std::to_string(face));
  if (depth < 0 || depth > 30) throw data::ArgumentError("depth must be 0..30");
  const std::int32_t size = 1 << depth;
  const std::array<detail::LatticePoint, 3> lattice{{{0, 0}, {size, 0}, {0, size}}};
  if (!mesh_->is_settled(face))
    return detail::subdivide_tagged<N>(mesh_->tagged->around(face), depth, lattice, weights_, emit);
  const auto fan_of = [this](std::int32_t v) {
    const auto found = fans_->find(v);
    return found == fans_->end() ? nullptr : &found->second;
  };
  detail::subdivide<N>(gather_triangle<N>(mesh_->topology, mesh_->positions, face, mesh_->states, fan_of),
                       depth, lattice, weights_, emit);
}

template <class N>
SubdivisionEvaluator<N>::SubdivisionEvaluator(const data::ControlMesh& mesh, Weights weights)
    : SubdivisionEvaluator(positions_of<N>(mesh), triangles_of(mesh).to_vector(), weights, mesh.sharpness) {}

template <class N>
SubdivisionEvaluator<N>::SubdivisionEvaluator(std::vector<Vec3<N>> positions,
                                              const std::vector<Triangle>& triangles, Weights weights,
                                              const SharpTags& tags)
    : mesh_(std::make_shared<const CutMesh<N>>(std::move(positions), data::Faces(triangles), tags)),
      weights_(weights) {}

template <class N>
int SubdivisionEvaluator<N>::face_count() const {
  return static_cast<int>(mesh_->topology.faces().size());
}

template <class N>
SurfacePoint<N> SubdivisionEvaluator<N>::evaluate(int face, const Parameter& l1, const Parameter& l2,
                                                  Derivatives order) const {
  if (face < 0 || face >= face_count()) throw data::ArgumentError("no face " + std::to_string(face));
  const auto [first, second] = exact_parameters(l1, l2);
  if (first < 0 || second < 0 || first + second > 1)
    throw data::ArgumentError("l1, l2 must be >= 0 and l1 + l2 <= 1");

  SubFacePath<Rational> path(first, second);
  const auto gathered = [](const CutMesh<N>& mesh, std::size_t which) {
    return gather_triangle<N>(mesh.topology, mesh.positions, which, mesh.states);
  };
  const auto at = static_cast<std::size_t>(face);
  RingedFace<Vec3<N>> f = mesh_->is_settled(at)
                              ? gathered(*mesh_, at)
                              : gathered(settled_around(*mesh_->tagged, at, weights_, path), 0);
  const auto& w = path.w;
  while (!f.is_regular()) {
    for (std::size_t k = 0; k < 3; ++k)
      if (w[k] == 1 && !f.corner[k].is_regular()) {
        const auto next = path.gradient[(k + 1) % 3], before = path.gradient[(k + 2) % 3];
        SurfacePoint<N> result = extraordinary_corner<N>(
            f.corner[k].point, f.corner[k].span(), f.corner[k].on_boundary, f.corner[k].ring_index,
            {next[0], next[1], before[0], before[1], path.level}, weights_, order, f.corner[k].state);
        if (path.level > 0) scale_derivatives(result, NumberTraits<N>::scale(N(1), path.level));
        return result;
      }
    const SubdividedFace<N> subdivided(f, weights_);
    f = subdivided.subface(path.descend());
  }

  Basis<N> basis;
  evaluate_basis<N>(basis, number_from<N>(w[1]), number_from<N>(w[2]), order);
  const LocalPoint<N> s = evaluate_patch<N>(f.patch(ghost_point<N>), basis, order);
  SurfacePoint<N> result;
  result.position = s.position;
  set_derivatives(result, s, path.gradients(), NumberTraits<N>::scale(N(1), path.level),
                  NumberTraits<N>::scale(N(1), 2 * path.level), order);
  if (order == Derivatives::kPosition) return result;
  const auto corner = [&](std::size_t k) { return mesh_->positions[mesh_->topology.faces()[at][k]]; };
  set_normal(result, tangents_of(result), cross(corner(1) - corner(0), corner(2) - corner(0)));
  return result;
}

}  // namespace limitcheck::reference
