// SPDX-License-Identifier: MIT
// Definitions behind refined_mesh.h, for the .cpp files that instantiate them.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "data/error.h"
#include "reference/catmull_clark/refine.h"
#include "reference/catmull_clark/refined_mesh.h"
#include "reference/catmull_clark/vertex_limit.h"

namespace limitcheck::reference::catmull_clark {

template <class N>
RefinedMesh<N>::RefinedMesh(data::Faces faces, std::vector<Vec3<N>> positions, const SharpTags& tags)
    : given_(std::move(faces)),
      topology_(positions.size(), given_),
      positions_(std::move(positions)),
      sharpness_(tags.empty() ? nullptr : std::make_shared<const Sharpness>(topology_, tags)),
      triangles_(tags.triangles) {}

template <class N>
void RefinedMesh<N>::refine() {
  if (sharpness_) {
    TaggedMesh<N> next =
        refine_once(TaggedMesh<N>{std::move(topology_), std::move(positions_), *sharpness_}, triangles_);
    topology_ = std::move(next.topology);
    positions_ = std::move(next.positions);
    sharpness_ = std::make_shared<const Sharpness>(std::move(next.sharpness));
    ++depth_;
    return;
  }
  std::vector<Vec3<N>> positions = refine_once(topology_, positions_);
  topology_ = Topology(positions.size(), refined_faces(topology_));
  positions_ = std::move(positions);
  ++depth_;
}

template <class N>
std::int32_t RefinedMesh<N>::vertex(std::size_t face, std::size_t corner, int i, int j) const {
  const auto refuse = [](const std::string& why) { throw data::ArgumentError(why); };
  if (face >= given_.size()) refuse("no face " + std::to_string(face));
  const bool is_quad = given_[face].size() == 4;
  const int depth = is_quad ? depth_ : depth_ - 1;
  if (depth < 0) refuse("a face that is no quad has no lattice at depth 0");
  if (corner >= (is_quad ? 1 : given_[face].size())) refuse("no corner " + std::to_string(corner));
  const int side = 1 << depth;
  if (i < 0 || j < 0 || i > side || j > side) refuse("no lattice point");
  // The cell that has the point as a corner, found bit by bit: the quads of a step follow in the order of the
  // corners.
  static constexpr int kCorner[2][2] = {{0, 1}, {3, 2}};
  const int x = i == side ? i - 1 : i, y = j == side ? j - 1 : j;
  std::size_t cell = is_quad ? face : given_.first_corner(face) + corner;
  for (int bit = depth - 1; bit >= 0; --bit) {
    const auto k = static_cast<std::size_t>(kCorner[(y >> bit) & 1][(x >> bit) & 1]);
    // The first step numbers the corners of all faces through, later ones have quads only.
    cell = bit == depth - 1 && is_quad ? given_.first_corner(face) + k : 4 * cell + k;
  }
  return topology_.faces()[cell][static_cast<std::size_t>(kCorner[j - y][i - x])];
}

template <class N>
typename RefinedMesh<N>::Limits RefinedMesh<N>::limits() const {
  bool only_quads = true;
  for (std::size_t f = 0; f < topology_.faces().size(); ++f)
    only_quads = only_quads && topology_.faces()[f].size() == 4;
  if (!only_quads) {  // the vertices come first after one more step, and have the same limits
    RefinedMesh finer = *this;
    finer.refine();
    Limits all = finer.limits();
    all.positions.resize(positions_.size());
    all.normals.resize(positions_.size());
    all.kinds.resize(positions_.size());
    return all;
  }
  const auto gathered = [](const Topology& topology, const std::vector<Vec3<N>>& positions, std::size_t v,
                           std::span<const VertexState> states) {
    return gather_vertex<Vec3<N>>(
        topology, static_cast<std::int32_t>(v),
        [&](std::int32_t p) { return positions[static_cast<std::size_t>(p)]; }, states);
  };
  std::optional<QuadMesh<N>> cut;
  if (sharpness_) cut.emplace(TaggedMesh<N>{topology_, positions_, *sharpness_});
  const auto ring_of = [&](std::size_t v) {
    if (!cut) return gathered(topology_, positions_, v, {});
    const Sector sector = topology_.sector(static_cast<std::int32_t>(v));
    if (sector.faces.empty() || cut->is_settled(static_cast<std::size_t>(sector.faces[0])))
      return gathered(cut->topology, cut->positions, v, cut->states);
    const auto face = static_cast<std::size_t>(sector.faces[0]);
    const auto corners = topology_.faces()[face];
    const auto k = static_cast<std::size_t>(
        std::find(corners.begin(), corners.end(), static_cast<std::int32_t>(v)) - corners.begin());
    double right = k == 1 || k == 2 ? 1 : 0, up = k >= 2 ? 1 : 0;
    long steps = 0;
    const QuadMesh<N> near = settled_around(*cut->tagged, face, right, up, steps);
    return gathered(near.topology, near.positions, static_cast<std::size_t>(near.topology.faces()[0][k]),
                    near.states);
  };
  Limits limits;
  for (std::size_t v = 0; v < positions_.size(); ++v) {
    const auto corner = ring_of(v);
    if (corner.faces.empty()) {  // no face has it
      limits.positions.push_back(positions_[v]);
      limits.normals.push_back({N(0), N(0), N(1)});
      limits.kinds.push_back(NormalKind::kArbitrary);
      continue;
    }
    const Normal<N> normal = limit_normal(corner, limit_tangents(corner));
    limits.positions.push_back(limit_position(corner));
    limits.normals.push_back(normal.direction);
    limits.kinds.push_back(normal.kind);
  }
  return limits;
}

}  // namespace limitcheck::reference::catmull_clark
