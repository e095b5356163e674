// SPDX-License-Identifier: MIT
// The faces near a vertex of a refined mesh, to follow it alone through the steps in which it has tags left.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "reference/mesh/topology.h"
#include "verify/mutants/models/model_tags.h"

namespace limitcheck::verify {

/// All faces that touch a face around a vertex, triangles of Loop's scheme or quads: the points next to the
/// vertex, and the tags at these, are what they are in the whole mesh.
struct ModelNeighbourhood {
  using V = ModelTags::V;
  /// The points of one step.
  using Refine = std::function<std::vector<V>(const reference::Topology&, const std::vector<V>& points,
                                              const ModelTags&)>;

  reference::Topology topology;
  std::vector<V> points;
  ModelTags tags;
  std::int32_t vertex;
  std::vector<std::int32_t> ring;  // the faces around the vertex, in the order given

  static ModelNeighbourhood around(std::int32_t vertex, std::span<const std::int32_t> ring,
                                   const reference::Topology& topology, const std::vector<V>& points,
                                   const ModelTags& tags);
  /// The same after as many steps as it takes until the rule of the vertex stays.
  static ModelNeighbourhood settled(std::int32_t vertex, const reference::Topology& topology,
                                    const std::vector<V>& points, const ModelTags& tags,
                                    const Refine& refine);

 private:
  ModelNeighbourhood refined(const Refine& refine) const;
};

}  // namespace limitcheck::verify
