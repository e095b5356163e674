// SPDX-License-Identifier: MIT
#include "fast/frame/scheme_frames.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <string>

#include "data/error.h"

namespace limitcheck::fast {

PairingResult QuadScheme::pair(std::span<const std::int32_t> depth, std::span<const Grid> /*keep*/) const {
  PairingResult out;
  out.depth.assign(depth.begin(), depth.end());
  for (std::int32_t f = 0; f < faces.size(); ++f)
    if (depth[f] >= 0) out.grids.push_back({f, -1, -1, -1, depth[f]});
  out.pair_count = static_cast<std::int64_t>(out.grids.size());
  out.culled = faces.size() - out.pair_count;
  return out;
}

template <class Real, class Scheme>
FrameStats SchemeFrames<Real, Scheme>::plan_frame(std::span<const std::int32_t> depth,
                                                  std::span<const Grid> keep) {
  using Clock = std::chrono::steady_clock;
  const auto seconds_since = [](Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  FrameStats stats;
  check_depths(depth, faces.size(), kDeepest);
  auto start = Clock::now();
  pairing = this->pair(depth, keep);
  stats.seconds_pairing = seconds_since(start);

  start = Clock::now();
  plan = this->plan_edges(pairing.depth, options.cracks);
  patches.clear();
  max_depth = 0;
  for (const Grid& grid : pairing.grids) {
    const Patch& patch = patches.emplace_back(patch_of(faces, grid, plan));
    max_depth = std::max(max_depth, grid.depth);
    const PatchCounts counts = count(patch, faces, plan);
    stats.limit_points += counts.limit_points;
    stats.triangles += counts.size.triangles;
    stats.draws += counts.size.draws;
    stats.strips += counts.strips;
  }
  for (const std::int8_t d : plan.edge_depth) max_depth = std::max<int>(max_depth, d);
  stats.faces = faces.size();
  stats.culled = pairing.culled;
  stats.pairs = pairing.pair_count;
  stats.singletons = pairing.singletons;
  stats.fans = plan.fans;
  stats.stitched = plan.stitched;
  stats.seconds_planning = seconds_since(start);
  return stats;
}

template <class Real, class Scheme>
void SchemeFrames<Real, Scheme>::write_index(IndexedMesh<Real>& out) {
  const IndexLayout layout = IndexLayout::of(faces, pairing.depth, plan);
  if (layout.vertex_count > std::numeric_limits<std::uint32_t>::max())
    throw data::ArgumentError("frame: " + std::to_string(layout.vertex_count) +
                              " vertices are more than 32-bit indices reach");
  out.vertices.resize(static_cast<std::size_t>(layout.vertex_count));
  out.provenance.resize(options.provenance ? out.vertices.size() : 0);
  out.triangles.resize(static_cast<std::size_t>(layout.triangle_count));
  out.triangle_face.resize(out.triangles.size());
  out.triangle_kind.resize(out.triangles.size());
  write_control_vertices(layout, out);
  index(layout, out);
}

template <class Real, class Scheme>
void SchemeFrames<Real, Scheme>::write_control_vertices(const IndexLayout& layout,
                                                        IndexedMesh<Real>& out) const {
  for (std::size_t v = 0; v < layout.vertex.size(); ++v)
    if (layout.vertex[v] != IndexLayout::kUnused)
      out.vertices[layout.vertex[v]] = limit(static_cast<std::int32_t>(v));
  if (!options.provenance) return;
  for (std::int32_t f = faces.size() - 1; f >= 0; --f) {
    if (pairing.depth[f] < 0) continue;
    for (int k = 0; k < faces.sides(f); ++k)
      out.provenance[layout.vertex[faces.vertex(faces.first_side(f) + k)]] = faces.corner(f, k);
  }
}

template struct SchemeFrames<float, LoopScheme>;
template struct SchemeFrames<double, LoopScheme>;
template struct SchemeFrames<float, QuadScheme>;
template struct SchemeFrames<double, QuadScheme>;

}  // namespace limitcheck::fast
