// SPDX-License-Identifier: MIT
// Definitions behind subdivision_evaluator.h, for the .cpp files that instantiate them.
#pragma once

#include <string>

#include "data/error.h"
#include "reference/loop/patch.h"
#include "reference/loop/refine.h"
#include "reference/loop/ringed_face.h"
#include "reference/loop/subdivision_evaluator.h"
#include "reference/point/parameter_exact.h"

namespace limitcheck::reference {
namespace detail {

/// The twelve points of a regular face in the order of Appendix A. Two linear ghosts complete the ring of a
/// boundary vertex.   [D10]
template <class N>
std::array<Vec3<N>, 12> regular_patch(const RingedFace<N>& face) {
  std::array<std::array<Vec3<N>, 6>, 3> rings;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& c = face.corner[k];
    std::array<Vec3<N>, 6> full;
    for (std::size_t i = 0; i < c.ring.size(); ++i) full[i] = c.ring[i];
    if (c.on_boundary) {
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
    : SubdivisionEvaluator(positions_of<N>(mesh), triangles_of(mesh).to_vector(), weights) {}

template <class N>
SubdivisionEvaluator<N>::SubdivisionEvaluator(std::vector<Vec3<N>> positions,
                                              const std::vector<Triangle>& triangles, Weights weights)
    : topology_(positions.size(), triangles), positions_(std::move(positions)), weights_(weights) {}

template <class N>
SurfacePoint<N> SubdivisionEvaluator<N>::evaluate(int face, const Parameter& l1, const Parameter& l2,
                                                  Order order) const {
  if (face < 0 || face >= face_count()) throw data::ArgumentError("no face " + std::to_string(face));
  Rational first = exact_value(l1), second = exact_value(l2);
  if (l1.is_double() && l2.is_double() && l1.as_double() + l2.as_double() == 1.0 && first + second > 1)
    (first > second ? second : first) = 1 - (first > second ? first : second);
  if (first < 0 || second < 0 || first + second > 1)
    throw data::ArgumentError("l1, l2 must be >= 0 and l1 + l2 <= 1");

  std::array<Rational, 3> w{1 - first - second, first, second};  // barycentric in the current sub-face
  std::array<std::array<int, 2>, 3> gradient{{{-1, -1}, {1, 0}, {0, 1}}};  // of w, in units of 2^level
  long level = 0;
  RingedFace<N> f = RingedFace<N>::gather(topology_, positions_, face, weights_);
  while (!f.is_regular()) {
    for (std::size_t k = 0; k < 3; ++k)
      if (w[k] == 1 && !f.corner[k].is_regular()) {
        const auto next = gradient[(k + 1) % 3], before = gradient[(k + 2) % 3];
        return extraordinary_corner<N>(f.corner[k].point, f.corner[k].span(), f.corner[k].on_boundary,
                                       f.corner[k].ring_index,
                                       {next[0], next[1], before[0], before[1], level}, weights_, order);
      }
    const SubdividedFace<N> subdivided(f);
    const Rational half(1, 2);
    std::size_t k = 0;
    while (k < 3 && w[k] < half) ++k;
    ++level;
    f = subdivided.subface(static_cast<int>(k));
    if (k < 3) {
      const std::size_t next = (k + 1) % 3, before = (k + 2) % 3;
      w = {2 * w[k] - 1, 2 * w[next], 2 * w[before]};
      gradient = {gradient[k], gradient[next], gradient[before]};
    } else {  // e_0, e_1, e_2 are opposite corners 2, 0, 1
      w = {1 - 2 * w[2], 1 - 2 * w[0], 1 - 2 * w[1]};
      const auto minus = [](std::array<int, 2> g) { return std::array<int, 2>{-g[0], -g[1]}; };
      gradient = {minus(gradient[2]), minus(gradient[0]), minus(gradient[1])};
    }
  }

  Basis<N> basis;
  const auto number = [](const Rational& a) {
    if constexpr (std::is_same_v<N, double>)
      return a.convert_to<double>();
    else
      return NumberTraits<N>::from_rational(a);
  };
  evaluate_basis<N>(basis, number(w[1]), number(w[2]), order);
  const LocalPoint<N> s = evaluate_patch<N>(detail::regular_patch(f), basis, order);
  SurfacePoint<N> result;
  result.position = s.position;
  const ParameterGradients at{gradient[1][0], gradient[1][1], gradient[2][0], gradient[2][1], level};
  set_derivatives(result, s, at, NumberTraits<N>::scale(N(1), level), NumberTraits<N>::scale(N(1), 2 * level),
                  order);
  if (order == Order::kPosition) return result;
  const auto corner = [&](std::size_t k) { return positions_[topology_.faces()[face][k]]; };
  set_normal(result, tangents_of(result), cross(corner(1) - corner(0), corner(2) - corner(0)));
  return result;
}

}  // namespace limitcheck::reference
