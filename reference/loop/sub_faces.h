// SPDX-License-Identifier: MIT
// The four sub-faces of a triangle: of all triangles of a mesh in a step, and those that hold a point.
#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "data/error.h"
#include "reference/loop/patch.h"
#include "reference/loop/refine.h"
#include "reference/mesh/cut_mesh.h"
#include "reference/mesh/topology.h"

namespace limitcheck::reference {

/// The triangles of a step, four for each face: those at its corners (c_k, e_k, e_{k-1}), then the middle
/// one.
inline data::Faces refined_triangles(const Topology& topology) {
  const auto edges = static_cast<std::int32_t>(topology.vertex_count());
  data::Faces refined;
  refined.reserve(4 * topology.faces().size());
  for (std::size_t f = 0; f < topology.faces().size(); ++f) {
    const auto corner = topology.faces()[f];
    const auto e = [&](std::size_t k) { return edges + topology.edge(f, k % 3); };
    for (std::size_t k = 0; k < 3; ++k) refined.push_back({corner[k], e(k), e(k + 2)});
    refined.push_back({e(0), e(1), e(2)});
  }
  return refined;
}

/// One step of a mesh with sharp edges and vertices.
template <class N>
TaggedMesh<N> refine_once(const TaggedMesh<N>& mesh, Weights weights) {
  std::vector<Vec3<N>> refined = refine_once(mesh.topology, mesh.positions, weights);
  sharpen(mesh.topology, mesh.sharpness, mesh.positions, refined);
  Topology finer(refined.size(), refined_triangles(mesh.topology));
  Sharpness sharpness = mesh.sharpness.refined(mesh.topology, finer);
  return {std::move(finer), std::move(refined), std::move(sharpness)};
}

/// A point on its way down into the sub-faces.
template <class P>
struct SubFacePath {
  std::array<P, 3> w;                                                      ///< barycentric in the sub-face
  std::array<std::array<int, 2>, 3> gradient{{{-1, -1}, {1, 0}, {0, 1}}};  ///< of w, in units of 2^level
  long level = 0;

  SubFacePath(const P& l1, const P& l2) : w{1 - l1 - l2, l1, l2} {}

  bool at_corner() const { return w[0] == 1 || w[1] == 1 || w[2] == 1; }
  /// Goes on into the sub-face that holds the point, and says which: 0 .. 2 at a corner, 3 in the middle.
  int descend() {
    const P half = P(1) / P(2);
    std::size_t k = 0;
    while (k < 3 && w[k] < half) ++k;
    ++level;
    if (k < 3) {
      const std::size_t next = (k + 1) % 3, before = (k + 2) % 3;
      w = {2 * w[k] - 1, 2 * w[next], 2 * w[before]};
      gradient = {gradient[k], gradient[next], gradient[before]};
    } else {  // e_0, e_1, e_2 are opposite corners 2, 0, 1
      w = {1 - 2 * w[2], 1 - 2 * w[0], 1 - 2 * w[1]};
      const auto minus = [](std::array<int, 2> g) { return std::array<int, 2>{-g[0], -g[1]}; };
      gradient = {minus(gradient[2]), minus(gradient[0]), minus(gradient[1])};
    }
    return static_cast<int>(k);
  }
  /// Of the second and third coordinate.
  ParameterGradients gradients() const {
    return {gradient[1][0], gradient[1][1], gradient[2][0], gradient[2][1], level};
  }
};

/// Takes a point of a face that needs steps to the mesh of few faces in whose face 0 it is after these steps,
/// with no semi-sharp tags left.
template <class N, class P>
CutMesh<N> settled_around(const TaggedMesh<N>& mesh, std::size_t face, Weights weights,
                          SubFacePath<P>& path) {
  TaggedMesh<N> near = mesh.around(face);
  while (!near.is_settled(0))
    near = refine_once(near, weights).around(static_cast<std::size_t>(path.descend()));
  return CutMesh<N>(std::move(near));
}

/// Two doubles may add up to 1 only after rounding; their exact values are treated like the rounded ones.
inline std::pair<Rational, Rational> exact_parameters(const Parameter& l1, const Parameter& l2) {
  Rational first = exact_value(l1), second = exact_value(l2);
  if (l1.is_double() && l2.is_double() && l1.as_double() + l2.as_double() == 1.0 && first + second > 1)
    (first > second ? second : first) = 1 - (first > second ? first : second);
  return {first, second};
}

/// Where a point lies after one step, decided on the parameters alone (P is double or Rational).
template <class P>
struct SubFaceLocation {
  int subface;                   ///< 0..2 at a corner, 3 the middle
  P u, v;                        ///< coordinates in the sub-face: towards its second and third corner
  ParameterGradients gradients;  ///< of u and v
};

template <class P>
SubFaceLocation<P> locate(P l1, P l2) {
  if (!(l1 >= 0) || !(l2 >= 0) || !(l1 + l2 <= 1))
    throw data::ArgumentError("l1, l2 must be >= 0 and l1 + l2 <= 1");
  if (l2 > 1 - l1) (l1 > l2 ? l2 : l1) = 1 - (l1 > l2 ? l1 : l2);  // the sum was rounded to 1
  const P half = P(1) / P(2);
  // Differences from 1 are exact in double where it matters: next to the corner they are measured from.
  if (l1 >= half) return {1, 2 * l2, 2 * ((1 - l1) - l2), {0, 1, -1, -1, 1}};
  if (l2 >= half) return {2, 2 * ((1 - l2) - l1), 2 * l1, {-1, -1, 1, 0, 1}};
  if (l1 + l2 <= half) return {0, 2 * l1, 2 * l2, {1, 0, 0, 1, 1}};
  return {3, 2 * (l1 + l2) - 1, 1 - 2 * l1, {1, 1, -1, 0, 1}};
}

}  // namespace limitcheck::reference
