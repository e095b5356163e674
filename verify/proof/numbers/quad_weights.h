// SPDX-License-Identifier: MIT
// What the proofs of Catmull-Clark's scheme need of their numbers beyond what those of Loop's do. For .cpp
// files.
#pragma once

#include <cstddef>
#include <vector>

#include "fast/rules/quad_limit.h"
#include "verify/proof/numbers/error_bound_number.h"
#include "verify/proof/numbers/stencil.h"

namespace limitcheck::verify {

/// Tangents of control vertices in a field without the roots that most valences need: those of regular
/// vertices and of corners; elsewhere none. Darts have a limit that is found by iteration alone.
template <class C>
fast::StarWeights<C> rational_star_weights(int faces, bool open, fast::VertexKind kind) {
  using fast::VertexKind;
  const auto row = [](const std::vector<int>& from) { return std::vector<C>(from.begin(), from.end()); };
  if (kind == VertexKind::kDart) throw NotLinear("a dart");
  if (kind == VertexKind::kHeld && open) return fast::detail::held_weights<C>(faces);
  if (kind == VertexKind::kPlain) {
    if (!open && faces == 4) return {row({4, 1, 0, -1, -4, -1, 0, 1}), row({0, 1, 4, 1, 0, -1, -4, -1}), {}};
    if (open && faces == 1) return {row({1, 0, -1}), row({1, 0, 1}), {}};
    if (open && faces == 2) return {row({1, 0, 0, 0, -1}), row({-1, 1, 4, 1, -1}), {}};
  }
  const std::vector<C> none(2 * static_cast<std::size_t>(faces) + (open ? 1 : 0), C(0));
  return {none, none, {}};
}

}  // namespace limitcheck::verify

namespace limitcheck::fast {

template <>
inline StarWeights<reference::Rational> star_weights(int faces, bool open, VertexKind kind) {
  return verify::rational_star_weights<reference::Rational>(faces, open, kind);
}
template <>
inline StarWeights<verify::Residue> star_weights(int faces, bool open, VertexKind kind) {
  return verify::rational_star_weights<verify::Residue>(faces, open, kind);
}
/// As the double kernels have them: right to 2^-40, which is more than cosines, roots and the iteration of
/// darts lose (bounds_test.cpp).
template <>
inline StarWeights<verify::BoundDouble> star_weights(int faces, bool open, VertexKind kind) {
  const StarWeights<double> given = star_weights<double>(faces, open, kind);
  StarWeights<verify::BoundDouble> w;
  const auto known_to = [](const std::vector<double>& from, std::vector<verify::BoundDouble>& to) {
    for (const double x : from)
      to.emplace_back(verify::BoundForm::rounded_constant(x, 0x1p-40, false, x == 0 || x == 1 || x == -1));
  };
  known_to(given.du, w.du);
  known_to(given.dv, w.dv);
  known_to(given.position, w.position);
  return w;
}

}  // namespace limitcheck::fast
