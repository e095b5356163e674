// SPDX-License-Identifier: MIT
#include "fast/frame/frame_state.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

namespace limitcheck::fast {
namespace {

const data::ControlMesh& checked(const data::ControlMesh& mesh) {
  if (mesh.triangles.empty()) throw std::invalid_argument("tessellator: a mesh without faces");
  for (const auto& p : mesh.positions)
    for (const double x : p)
      if (!std::isfinite(x)) throw std::invalid_argument("tessellator: a coordinate is not finite");
  return mesh;
}

}  // namespace

FrameState::FrameState(const data::ControlMesh& given, const TessellatorOptions& with)
    : mesh(checked(given)), options(with), adjacency(mesh) {
  if (options.threads < 0) throw std::invalid_argument("tessellator: a negative number of threads");
  // More threads than oneTBB has would only earn a warning on standard error.
  const auto most =
      static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  arena.initialize(options.threads > 0 ? std::min(options.threads, most) : tbb::task_arena::automatic);
}

FrameStats FrameState::plan_frame(std::span<const std::int32_t> depth, int deepest) {
  FrameStats stats;
  if (depth.size() != mesh.triangles.size())
    throw std::invalid_argument("frame: " + std::to_string(depth.size()) + " depths for " +
                                std::to_string(mesh.triangles.size()) + " faces");
  for (const std::int32_t d : depth)
    if (d < kCulled || d > deepest)
      throw std::invalid_argument("frame: depth " + std::to_string(d) + " is not in -1.." +
                                  std::to_string(deepest));
  auto start = Clock::now();
  pairing = pair_faces(adjacency, depth, options.pairing);
  stats.seconds_pairing = seconds_since(start);

  start = Clock::now();
  plan = plan_cracks(adjacency, pairing.depth, options.cracks);
  patches.clear();
  max_depth = 0;
  for (const Pair& pair : pairing.pairs) {
    const Patch& patch = patches.emplace_back(Patch::of(adjacency, pair, plan));
    max_depth = std::max(max_depth, pair.depth);
    stats.limit_points += limit_points_of(patch, plan);
    const DrawSize size = draw_size(patch, plan);
    stats.triangles += size.triangles;
    stats.draws += size.draws;
    stats.strips += size.draws;
    for (const Half& half : patch.half)
      if (!patch.full() && (half.show == Half::Show::kFan || half.show == Half::Show::kStitch))
        --stats.strips;
  }
  for (const std::int8_t d : plan.edge_depth) max_depth = std::max<int>(max_depth, d);
  stats.faces = adjacency.face_count();
  stats.pairs = pairing.pair_count;
  stats.singletons = pairing.singletons;
  stats.fans = plan.fans;
  stats.stitched = plan.stitched;
  for (std::size_t f = 0; f < depth.size(); ++f) {
    stats.culled += pairing.depth[f] < 0 ? 1 : 0;
    stats.revived += depth[f] < 0 && pairing.depth[f] >= 0 ? 1 : 0;
  }
  stats.seconds_planning = seconds_since(start);
  return stats;
}

}  // namespace limitcheck::fast
