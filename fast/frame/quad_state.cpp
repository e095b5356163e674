// SPDX-License-Identifier: MIT
#include "fast/frame/quad_state.h"

#include <algorithm>
#include <chrono>

#include "fast/plan/printed_rules.h"

namespace limitcheck::fast {

template <class Real>
FrameStats QuadEngineState<Real>::plan_frame(std::span<const std::int32_t> depth,
                                             std::span<const Grid> /*keep*/) {
  const auto start = std::chrono::steady_clock::now();
  FrameStats stats;
  check_depths(depth, faces.size(), kDeepest);
  pairing = {};
  pairing.depth.assign(depth.begin(), depth.end());
  plan = plan_cracks(faces, depth, options.cracks, PrintedRules{});
  patches.clear();
  max_depth = 0;
  for (std::int32_t f = 0; f < faces.size(); ++f) {
    if (depth[f] < 0) {
      ++pairing.culled;
      continue;
    }
    pairing.grids.push_back({f, -1, -1, -1, depth[f]});
    const QuadPatch& patch = patches.emplace_back(QuadPatch{f, depth[f], plan.display[f]});
    max_depth = std::max<int>(max_depth, depth[f]);
    stats.limit_points += quad_limit_points(patch, faces, plan);
    const DrawSize size = quad_draw_size(patch, faces, plan);
    stats.triangles += size.triangles;
    stats.draws += size.draws;
    stats.strips += size.draws - (patch.display == Display::kStrips && !corners_only(patch, faces) ? 0 : 1);
  }
  for (const std::int8_t d : plan.edge_depth) max_depth = std::max<int>(max_depth, d);
  pairing.pair_count = static_cast<std::int64_t>(patches.size());
  stats.faces = faces.size();
  stats.culled = pairing.culled;
  stats.pairs = pairing.pair_count;
  stats.fans = plan.fans;
  stats.stitched = plan.stitched;
  stats.seconds_planning = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return stats;
}

template <class Real>
void QuadEngineState<Real>::write_control_vertices(IndexedMesh<Real>& out) const {
  for (std::size_t v = 0; v < layout_.vertex.size(); ++v)
    if (layout_.vertex[v] != QuadIndexLayout::kUnused)
      out.vertices[layout_.vertex[v]] = limit(static_cast<std::int32_t>(v));
  if (!options.provenance) return;
  for (std::int32_t f = faces.size() - 1; f >= 0; --f) {
    if (pairing.depth[f] < 0) continue;
    for (int k = 0; k < faces.sides(f); ++k) {
      const auto c = static_cast<std::int32_t>(faces.first[f]) + k;
      out.provenance[layout_.vertex[faces.vertex(c)]] = faces.corner(f, k);
    }
  }
}

template struct QuadEngineState<float>;
template struct QuadEngineState<double>;

}  // namespace limitcheck::fast
