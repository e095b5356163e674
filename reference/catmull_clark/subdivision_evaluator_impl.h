// SPDX-License-Identifier: MIT
// Definitions behind subdivision_evaluator.h, for the .cpp files that instantiate them.
#pragma once

#include <utility>

#include "reference/catmull_clark/quad_point.h"
#include "reference/catmull_clark/refine.h"
#include "reference/catmull_clark/subdivision_evaluator.h"
#include "reference/point/parameter_exact.h"

namespace limitcheck::reference::catmull_clark {

template <class N>
SubdivisionEvaluator<N>::SubdivisionEvaluator(data::Faces faces, std::vector<Vec3<N>> positions,
                                              const SharpTags& tags)
    : mesh_(std::make_unique<const QuadMesh<N>>(std::move(faces), std::move(positions), tags)) {}
template <class N>
SubdivisionEvaluator<N>::~SubdivisionEvaluator() = default;
template <class N>
SubdivisionEvaluator<N>::SubdivisionEvaluator(SubdivisionEvaluator&&) noexcept = default;
template <class N>
SubdivisionEvaluator<N>& SubdivisionEvaluator<N>::operator=(SubdivisionEvaluator&&) noexcept = default;

template <class N>
int SubdivisionEvaluator<N>::face_count() const {
  return static_cast<int>(mesh_->face_count());
}

template <class N>
SurfacePoint<N> SubdivisionEvaluator<N>::evaluate(int face, int corner, const Parameter& u,
                                                  const Parameter& v, Order order) const {
  QuadParameter<Rational> at = locate(*mesh_, face, corner, exact_value(u), exact_value(v));
  const auto gathered = [](const QuadMesh<N>& mesh, std::size_t which) {
    return gather<Vec3<N>>(
        mesh.topology, which, [&](std::int32_t p) { return mesh.positions[static_cast<std::size_t>(p)]; },
        mesh.states);
  };
  long level = 0;
  RingedQuad<Vec3<N>> quad = mesh_->is_settled(at.quad)
                                 ? gathered(*mesh_, at.quad)
                                 : gathered(settled_around(*mesh_->tagged, at.quad, at.u, at.v, level), 0);
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
  const PatchPoint<N> p = evaluate_patch<N>(quad.patch(ghost_point<N>), number_from_rational<N>(at.u),
                                            number_from_rational<N>(at.v), order);
  SurfacePoint<N> result;
  result.position = p.position;
  set_derivatives(result, p, turn_of(0), NumberTraits<N>::scale(N(1), level),
                  NumberTraits<N>::scale(N(1), 2 * level), order);
  if (order != Order::kPosition)
    set_normal(result, {result.t1, result.t2, result.t1_terms, result.t2_terms}, fallback);
  return result;
}

}  // namespace limitcheck::reference::catmull_clark
