// SPDX-License-Identifier: MIT
// Refined control meshes with sharp edges and vertices, cut for the bounds of their pieces. Heavy, as sharpness.h is:
// include from .cpp files.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "reference/mesh/sharpness.h"

namespace limitcheck::verify {

/// A mesh with a copy of the points of each edge that stays sharp for either of its sides. Its faces are
/// those of the mesh, in their order, and its first vertices too. Over faces without semi-sharp tags it has
/// the same limit surface.
struct CutMesh {
  reference::Topology topology;
  std::vector<reference::Vec3<double>> positions;
  std::vector<reference::VertexState> states;
  std::vector<std::int32_t> origin;  // of each vertex, the one of the mesh that it is a copy of

  CutMesh(const reference::Topology& whole, std::span<const reference::Vec3<double>> points,
          const reference::Sharpness& sharpness)
      : topology(whole) {
    reference::Sharpness::Cut cut = sharpness.cut(whole);
    for (const std::int32_t v : cut.origin) positions.push_back(points[v]);
    states = std::move(cut.states);
    origin = std::move(cut.origin);
    topology = reference::Topology(positions.size(), std::move(cut.faces));
  }
};

/// Refines a mesh so many times; returns how sharp its edges are then, nothing if it has no tags.
///   refined   of either scheme, made with the tags
template <class Refined>
std::optional<reference::Sharpness> refine_tagged(Refined& refined, const reference::SharpTags& tags,
                                                  int steps) {
  std::optional<reference::Sharpness> sharpness;
  if (!tags.empty()) sharpness.emplace(refined.topology(), tags);
  for (int step = 0; step < steps; ++step) {
    if (!sharpness) {
      refined.refine();
      continue;
    }
    const reference::Topology before = refined.topology();
    refined.refine();
    sharpness = sharpness->refined(before, refined.topology());
  }
  return sharpness;
}

}  // namespace limitcheck::verify
