// SPDX-License-Identifier: MIT
// The faces near a vertex of a refined mesh, to follow it alone through the steps in which it has tags left.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reference/mesh/topology.h"
#include "verify/subject/model_tags.h"

namespace limitcheck::verify {

class QuadModelRules;

/// All quads that touch a quad around a vertex: the points next to the vertex, and the tags at these, are
/// what they are in the whole mesh.
struct QuadNeighbourhood {
  reference::Topology topology;
  std::vector<ModelTags::V> points;
  ModelTags tags;
  std::int32_t vertex;
  std::vector<std::int32_t> ring;  // the faces around the vertex, in the order given

  static QuadNeighbourhood around(std::int32_t vertex, std::span<const std::int32_t> ring,
                                  const reference::Topology& topology,
                                  const std::vector<ModelTags::V>& points, const ModelTags& tags);
  QuadNeighbourhood refined(const QuadModelRules& rules) const;
};

}  // namespace limitcheck::verify
