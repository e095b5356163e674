// SPDX-License-Identifier: MIT
// Definitions behind refine.h, for the .cpp files that instantiate them.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>

#include "data/error.h"
#include "reference/loop/masks.h"
#include "reference/loop/refine.h"
#include "reference/loop/sub_faces.h"
#include "reference/loop/vertex_limit.h"
#include "reference/mesh/topology.h"

namespace limitcheck::reference {

template <class N>
std::vector<Vec3<N>> refine_once(const Topology& topology, const std::vector<Vec3<N>>& positions,
                                 Weights weights, std::span<const VertexState> states,
                                 const Valences& valences) {
  std::vector<Vec3<N>> result;
  result.reserve(topology.vertex_count() + topology.edges().size());
  std::vector<Vec3<N>> ring;
  for (std::size_t v = 0; v < topology.vertex_count(); ++v) {
    const Sector sector = topology.sector(static_cast<std::int32_t>(v));
    if (sector.faces.empty()) {
      result.push_back(positions[v]);  // isolated: nothing to subdivide
      continue;
    }
    ring.clear();
    for (const std::int32_t r : sector.neighbours) ring.push_back(positions[r]);
    result.push_back(vertex_point<N>(positions[v], ring, !sector.closed,
                                     state_of(states, static_cast<std::int32_t>(v)), weights,
                                     valence_of(valences, static_cast<std::int32_t>(v), 0)));
  }
  for (const Edge& e : topology.edges()) {
    const auto across = [&](std::int32_t face) -> const Vec3<N>& {
      return positions[opposite(topology, e, face)];
    };
    const Vec3<N>&a = positions[e.a], &b = positions[e.b];
    result.push_back(e.on_boundary() ? boundary_edge_point(a, b)
                                     : interior_edge_point(a, b, across(e.left_face), across(e.right_face)));
  }
  return result;
}

template <class N>
std::vector<Vec3<N>> positions_of(const data::ControlMesh& mesh) {
  std::vector<Vec3<N>> result;
  result.reserve(mesh.positions.size());
  for (const auto& p : mesh.positions)
    result.push_back({NumberTraits<N>::from_double(p[0]), NumberTraits<N>::from_double(p[1]),
                      NumberTraits<N>::from_double(p[2])});
  return result;
}

template <class N>
RefinedMesh<N>::RefinedMesh(const data::ControlMesh& mesh, Weights weights)
    : RefinedMesh(positions_of<N>(mesh), triangles_of(mesh).to_vector(), weights, mesh.sharpness) {}

template <class N>
RefinedMesh<N>::RefinedMesh(std::vector<Vec3<N>> positions, std::vector<Triangle> triangles, Weights weights,
                            const SharpTags& tags)
    : weights_(weights),
      positions_(std::move(positions)),
      topology_(positions_.size(), triangles),
      sharpness_(tags.empty() ? nullptr : std::make_shared<const Sharpness>(topology_, tags)) {}

template <class N>
void RefinedMesh<N>::refine() {
  const std::size_t count = positions_.size() + topology_.edges().size();
  if (count > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw data::ArgumentError("refined mesh has more than 2^31 - 1 vertices");
  const auto old_vertices = static_cast<std::int32_t>(positions_.size());
  std::vector<Vec3<N>> refined = refine_once(topology_, positions_, weights_);
  if (sharpness_) sharpen(topology_, *sharpness_, positions_, refined);
  positions_ = std::move(refined);
  data::Faces triangles;
  triangles.reserve(4 * topology_.faces().size());
  const int k = 2 << depth_;
  for (std::size_t f = 0; f < topology_.faces().size() >> (2 * depth_); ++f) {
    // Lattice points of even coordinates were there before; the others lie on an edge of an upright triangle.
    const auto at = [&](int i, int j) {
      if (i % 2 == 0 && j % 2 == 0) return vertex(f, i / 2, j / 2);
      return old_vertices + topology_.edge(upright(f, i / 2, j / 2), j % 2 == 0 ? 0 : i % 2 == 0 ? 2 : 1);
    };
    for (int j = 0; j < k; ++j)
      for (int i = 0; i + j < k; ++i) triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
    for (int j = 0; j < k; ++j)
      for (int i = 0; i + j + 1 < k; ++i) triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  }
  ++depth_;
  Topology finer(positions_.size(), std::move(triangles));
  if (sharpness_) sharpness_ = std::make_shared<const Sharpness>(sharpness_->refined(topology_, finer));
  topology_ = std::move(finer);
}

template <class N>
VertexLimits<N> RefinedMesh<N>::limits() const {
  VertexLimits<N> result;
  const auto limit_at = [&](const Topology& topology, const std::vector<Vec3<N>>& positions, std::int32_t v,
                            std::span<const VertexState> states) {
    const Sector sector = topology.sector(v);
    std::vector<Vec3<N>> ring;
    for (const std::int32_t r : sector.neighbours) ring.push_back(positions[r]);
    return vertex_limit<N>(positions[v], ring, !sector.closed, weights_, state_of(states, v));
  };
  std::optional<CutMesh<N>> cut;
  if (sharpness_) cut.emplace(TaggedMesh<N>{topology_, positions_, *sharpness_});
  const auto limit_of = [&](std::int32_t v) {
    if (!cut) return limit_at(topology_, positions_, v, {});
    const std::int32_t face = topology_.sector(v).faces[0];
    if (cut->is_settled(face)) return limit_at(cut->topology, cut->positions, v, cut->states);
    const Triangle corners = triangle_of(topology_, face);
    SubFacePath<Rational> path(v == corners[1] ? 1 : 0, v == corners[2] ? 1 : 0);
    const CutMesh<N> near = settled_around(*cut->tagged, face, weights_, path);
    const auto k = static_cast<std::size_t>(std::find(path.w.begin(), path.w.end(), 1) - path.w.begin());
    return limit_at(near.topology, near.positions, near.topology.faces()[0][k], near.states);
  };
  for (std::size_t v = 0; v < positions_.size(); ++v) {
    if (topology_.sector(static_cast<std::int32_t>(v)).faces.empty()) {
      result.add(positions_[v], {N(0), N(0), N(1)}, NormalKind::kArbitrary);
      continue;
    }
    const VertexLimit<N> limit = limit_of(static_cast<std::int32_t>(v));
    result.add(limit.position, limit.normal.direction, limit.normal.kind);
  }
  return result;
}

}  // namespace limitcheck::reference
