// SPDX-License-Identifier: MIT
#include "fast/frame/engine_state.h"

#include <algorithm>
#include <chrono>

namespace limitcheck::fast {

template <class Real>
FrameStats EngineState<Real>::plan_frame(std::span<const std::int32_t> depth, std::span<const Grid> keep) {
  using Clock = std::chrono::steady_clock;
  const auto seconds_since = [](Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  FrameStats stats;
  check_depths(depth, adjacency.face_count(), kDeepest);
  auto start = Clock::now();
  pairing = pair_faces(adjacency, depth, rules, keep);
  stats.seconds_pairing = seconds_since(start);

  start = Clock::now();
  plan = plan_cracks(triangles, pairing.depth, options.cracks, rules);
  patches.clear();
  max_depth = 0;
  for (const Grid& grid : pairing.grids) {
    const Patch& patch = patches.emplace_back(Patch::of(adjacency, grid, plan));
    max_depth = std::max(max_depth, grid.depth);
    stats.limit_points += limit_points_of(patch, plan);
    const DrawSize size = draw_size(patch, plan);
    stats.triangles += size.triangles;
    stats.draws += size.draws;
    stats.strips += size.draws;
    for (const Half& half : patch.half)
      if (!patch.full() && half.repaired()) --stats.strips;
  }
  for (const std::int8_t d : plan.edge_depth) max_depth = std::max<int>(max_depth, d);
  stats.faces = adjacency.face_count();
  stats.culled = pairing.culled;
  stats.pairs = pairing.pair_count;
  stats.singletons = pairing.singletons;
  stats.fans = plan.fans;
  stats.stitched = plan.stitched;
  stats.seconds_planning = seconds_since(start);
  return stats;
}

template <class Real>
void EngineState<Real>::write_control_vertices(IndexedMesh<Real>& out) const {
  for (std::size_t v = 0; v < layout_.vertex.size(); ++v)
    if (layout_.vertex[v] != IndexLayout::kUnused)
      out.vertices[layout_.vertex[v]] = limit(static_cast<std::int32_t>(v));
  if (!options.provenance) return;
  for (std::int32_t f = adjacency.face_count() - 1; f >= 0; --f) {
    if (pairing.depth[f] < 0) continue;
    for (int k = 0; k < 3; ++k) {
      const std::int64_t at = layout_.vertex[adjacency.corner(f, k)];
      out.provenance[at] = {f, k == 1 ? 1u : 0u, k == 2 ? 1u : 0u, 1};
    }
  }
}

template struct EngineState<float>;
template struct EngineState<double>;

}  // namespace limitcheck::fast
