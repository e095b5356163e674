// SPDX-License-Identifier: MIT
// Definitions behind subdivision_evaluator.h, for the .cpp files that instantiate them.
#pragma once

#include <string>

#include "data/error.h"
#include "reference/loop/patch.h"
#include "reference/loop/refine.h"
#include "reference/loop/ringed_face.h"
#include "reference/loop/subdivision_evaluator.h"
#include "reference/loop/triangle_mesh.h"
#include "reference/point/parameter_exact.h"

namespace limitcheck::reference {
namespace detail {

/// The twelve points of a regular face in the order of Appendix A. Two linear ghosts complete the ring of a
/// boundary vertex.   [D10] A held vertex of one face has four, the last two by reflection in it.
template <class N>
std::array<Vec3<N>, 12> regular_patch(const RingedFace<N>& face) {
  std::array<std::array<Vec3<N>, 6>, 3> rings;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& c = face.corner[k];
    std::array<Vec3<N>, 6> full;
    for (std::size_t i = 0; i < c.ring.size(); ++i) full[i] = c.ring[i];
    if (c.state == VertexState::kHeld) {
      full[2] = ghost_point(c.point, c.ring[1], c.ring[0]);
      full[3] = ghost_point(c.point, c.point, c.ring[0]);
      full[4] = ghost_point(c.point, c.point, c.ring[1]);
      full[5] = ghost_point(c.point, c.ring[0], c.ring[1]);
    } else if (c.on_boundary) {
      full[4] = ghost_point(c.point, c.ring[3], c.ring[2]);
      full[5] = ghost_point(c.point, c.ring[0], c.ring[1]);
    }
    for (std::size_t i = 0; i < 6; ++i) rings[k][i] = full[(i + c.ring_index) % 6];
  }
  const auto& [a, b, c] = rings;
  return {a[4], a[3], a[5], face.corner[0].point, a[2], b[3], a[0], a[1], c[4], b[4], b[5], c[3]};
}

}  // namespace detail

template <class N>
SubdivisionEvaluator<N>::SubdivisionEvaluator(const data::ControlMesh& mesh, Weights weights)
    : SubdivisionEvaluator(positions_of<N>(mesh), triangles_of(mesh).to_vector(), weights, mesh.sharpness) {}

template <class N>
SubdivisionEvaluator<N>::SubdivisionEvaluator(std::vector<Vec3<N>> positions,
                                              const std::vector<Triangle>& triangles, Weights weights,
                                              const SharpTags& tags)
    : mesh_(std::make_unique<const TriangleMesh<N>>(std::move(positions), triangles, tags)),
      weights_(weights) {}
template <class N>
SubdivisionEvaluator<N>::~SubdivisionEvaluator() = default;
template <class N>
SubdivisionEvaluator<N>::SubdivisionEvaluator(SubdivisionEvaluator&&) noexcept = default;
template <class N>
SubdivisionEvaluator<N>& SubdivisionEvaluator<N>::operator=(SubdivisionEvaluator&&) noexcept = default;

template <class N>
int SubdivisionEvaluator<N>::face_count() const {
  return static_cast<int>(mesh_->topology.faces().size());
}

template <class N>
SurfacePoint<N> SubdivisionEvaluator<N>::evaluate(int face, const Parameter& l1, const Parameter& l2,
                                                  Order order) const {
  if (face < 0 || face >= face_count()) throw data::ArgumentError("no face " + std::to_string(face));
  Rational first = exact_value(l1), second = exact_value(l2);
  if (l1.is_double() && l2.is_double() && l1.as_double() + l2.as_double() == 1.0 && first + second > 1)
    (first > second ? second : first) = 1 - (first > second ? first : second);
  if (first < 0 || second < 0 || first + second > 1)
    throw data::ArgumentError("l1, l2 must be >= 0 and l1 + l2 <= 1");

  SubFacePath<Rational> path(first, second);
  const auto gathered = [&](const TriangleMesh<N>& mesh, std::size_t which) {
    return RingedFace<N>::gather(mesh.topology, mesh.positions, which, weights_, mesh.states);
  };
  const auto at = static_cast<std::size_t>(face);
  RingedFace<N> f = mesh_->is_settled(at) ? gathered(*mesh_, at)
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
    const SubdividedFace<N> subdivided(f);
    f = subdivided.subface(path.descend());
  }

  Basis<N> basis;
  evaluate_basis<N>(basis, number_from_rational<N>(w[1]), number_from_rational<N>(w[2]), order);
  const LocalPoint<N> s = evaluate_patch<N>(detail::regular_patch(f), basis, order);
  SurfacePoint<N> result;
  result.position = s.position;
  set_derivatives(result, s, path.gradients(), NumberTraits<N>::scale(N(1), path.level),
                  NumberTraits<N>::scale(N(1), 2 * path.level), order);
  if (order == Order::kPosition) return result;
  const auto corner = [&](std::size_t k) { return mesh_->positions[mesh_->topology.faces()[at][k]]; };
  set_normal(result, tangents_of(result), cross(corner(1) - corner(0), corner(2) - corner(0)));
  return result;
}

}  // namespace limitcheck::reference
