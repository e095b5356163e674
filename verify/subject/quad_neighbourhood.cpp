// SPDX-License-Identifier: MIT
#include "verify/subject/quad_neighbourhood.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "data/cut_out.h"
#include "verify/subject/quad_model_rules.h"

namespace limitcheck::verify {

using reference::Topology;

QuadNeighbourhood QuadNeighbourhood::around(std::int32_t vertex, std::span<const std::int32_t> ring,
                                            const Topology& topology,
                                            const std::vector<ModelTags::V>& points, const ModelTags& tags) {
  std::vector<std::int32_t> faces(ring.begin(), ring.end());
  for (const std::int32_t f : ring)
    for (const std::int32_t v : topology.faces()[f])
      for (const std::int32_t near : topology.sector(v).faces)
        if (std::find(faces.begin(), faces.end(), near) == faces.end()) faces.push_back(near);
  const data::CutOut part = data::cut_out(topology.faces(), faces);
  Topology local(part.vertices.size(), part.faces);
  ModelTags its = tags.of_part(topology, local, part.vertices);
  const auto at = std::find(part.vertices.begin(), part.vertices.end(), vertex) - part.vertices.begin();
  std::vector<std::int32_t> first(ring.size());
  std::iota(first.begin(), first.end(), 0);
  return {std::move(local), part.of(points), std::move(its), static_cast<std::int32_t>(at), std::move(first)};
}

QuadNeighbourhood QuadNeighbourhood::refined(const QuadModelRules& rules) const {
  const auto edges = static_cast<std::int32_t>(topology.vertex_count());
  const auto middles = edges + static_cast<std::int32_t>(topology.edges().size());
  data::Faces quads;
  for (std::size_t f = 0; f < topology.faces().size(); ++f)
    for (std::size_t k = 0; k < 4; ++k)
      quads.push_back({topology.faces()[f][k], edges + topology.edge(f, k),
                       middles + static_cast<std::int32_t>(f), edges + topology.edge(f, (k + 3) % 4)});
  std::vector<std::int32_t> next_ring;
  for (const std::int32_t f : ring) {
    const auto face = topology.faces()[f];
    const auto corner = std::find(face.begin(), face.end(), vertex) - face.begin();
    next_ring.push_back(4 * f + static_cast<std::int32_t>(corner));
  }
  const std::vector<ModelTags::V> next = rules.refine(topology, points, tags, 1);
  const Topology finer(next.size(), quads);
  return around(vertex, next_ring, finer, next, tags.refined(topology, finer));
}

}  // namespace limitcheck::verify
