// SPDX-License-Identifier: MIT
#include "verify/mutants/models/model_neighbourhood.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "data/cut_out.h"

namespace limitcheck::verify {

using reference::Topology;

ModelNeighbourhood ModelNeighbourhood::around(std::int32_t vertex, std::span<const std::int32_t> ring,
                                              const Topology& topology, const std::vector<V>& points,
                                              const ModelTags& tags) {
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

ModelNeighbourhood ModelNeighbourhood::refined(const Refine& refine) const {
  // Either scheme makes four faces of one, of which face k has corner k.
  const auto edges = static_cast<std::int32_t>(topology.vertex_count());
  const auto middles = edges + static_cast<std::int32_t>(topology.edges().size());
  data::Faces finer_faces;
  for (std::size_t f = 0; f < topology.faces().size(); ++f) {
    const auto corners = topology.faces()[f];
    const std::size_t n = corners.size();
    const auto edge = [&](std::size_t k) { return edges + topology.edge(f, k % n); };
    for (std::size_t k = 0; k < n; ++k) {
      if (n == 3) {
        finer_faces.push_back({corners[k], edge(k), edge(k + 2)});
      } else {
        finer_faces.push_back({corners[k], edge(k), middles + static_cast<std::int32_t>(f), edge(k + 3)});
      }
    }
    if (n == 3) finer_faces.push_back({edge(0), edge(1), edge(2)});
  }
  std::vector<std::int32_t> next_ring;
  for (const std::int32_t f : ring) {
    const auto corners = topology.faces()[f];
    const auto corner = std::find(corners.begin(), corners.end(), vertex) - corners.begin();
    next_ring.push_back(4 * f + static_cast<std::int32_t>(corner));
  }
  const std::vector<V> next = refine(topology, points, tags);
  const Topology finer(next.size(), finer_faces);
  return around(vertex, next_ring, finer, next, tags.refined(topology, finer));
}

ModelNeighbourhood ModelNeighbourhood::settled(std::int32_t vertex, const Topology& topology,
                                               const std::vector<V>& points, const ModelTags& tags,
                                               const Refine& refine) {
  ModelNeighbourhood near = around(vertex, topology.sector(vertex).faces, topology, points, tags);
  // No sharpness that falls is above 10.
  for (int step = 0; step < 16 && !near.tags.settled(near.topology, near.vertex); ++step)
    near = near.refined(refine);
  return near;
}

}  // namespace limitcheck::verify
