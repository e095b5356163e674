// SPDX-License-Identifier: MIT
// The mesh that Loop's evaluators start from: cut along its sharp edges; and the way to it where tags are
// semi-sharp.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "reference/loop/patch.h"
#include "reference/loop/refine.h"
#include "reference/loop/triangles.h"
#include "reference/mesh/sharpness.h"

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

/// A mesh of triangles, cut along its sharp edges.
template <class N>
struct TriangleMesh {
  Topology topology;
  std::vector<Vec3<N>> positions;
  std::vector<VertexState> states;  ///< of the vertices; empty if all are ordinary
  /// Faces whose surface this mesh does not have, since semi-sharp tags are near: theirs are those of
  /// `tagged`, which has the same faces and is not cut.
  std::vector<bool> needs_a_step;
  std::shared_ptr<const TaggedMesh<N>> tagged;

  TriangleMesh(std::vector<Vec3<N>> points, const std::vector<Triangle>& triangles, const SharpTags& tags)
      : topology(points.size(), triangles), positions(std::move(points)) {
    if (tags.empty()) return;
    Sharpness sharpness(topology, tags);
    settle({std::move(topology), std::move(positions), std::move(sharpness)});
  }
  explicit TriangleMesh(TaggedMesh<N> mesh) : topology(mesh.topology) { settle(std::move(mesh)); }

  bool is_settled(std::size_t face) const { return !tagged || !needs_a_step[face]; }

 private:
  void settle(TaggedMesh<N> mesh) {
    needs_a_step = mesh.sharpness.needs_a_step(mesh.topology);
    Sharpness::Cut cut = mesh.sharpness.cut(mesh.topology);
    positions.clear();
    for (const std::int32_t v : cut.origin) positions.push_back(mesh.positions[v]);
    states = std::move(cut.states);
    topology = Topology(positions.size(), std::move(cut.faces));
    if (std::find(needs_a_step.begin(), needs_a_step.end(), true) != needs_a_step.end())
      tagged = std::make_shared<const TaggedMesh<N>>(std::move(mesh));
  }
};

/// A point on its way down into the sub-faces.
template <class P>
struct SubFacePath {
  std::array<P, 3> w;                                                      ///< barycentric in the sub-face
  std::array<std::array<int, 2>, 3> gradient{{{-1, -1}, {1, 0}, {0, 1}}};  ///< of w, in units of 2^level
  long level = 0;

  SubFacePath(const P& l1, const P& l2) : w{1 - l1 - l2, l1, l2} {}

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
TriangleMesh<N> settled_around(const TaggedMesh<N>& mesh, std::size_t face, Weights weights,
                               SubFacePath<P>& path) {
  TaggedMesh<N> near = mesh.around(face);
  while (near.sharpness.needs_a_step(near.topology)[0])
    near = refine_once(near, weights).around(static_cast<std::size_t>(path.descend()));
  return TriangleMesh<N>(std::move(near));
}

}  // namespace limitcheck::reference
