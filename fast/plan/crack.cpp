// SPDX-License-Identifier: MIT
#include "fast/plan/crack.h"

#include <algorithm>
#include "data/error.h"
#include "fast/plan/printed_rules.h"

namespace limitcheck::fast {

CrackPlan plan_cracks(const Adjacency& adjacency, std::span<const std::int32_t> depth,
                      const CrackOptions& options, const PrintedRules& rules) {
  const auto faces = static_cast<std::size_t>(adjacency.face_count());
  if (depth.size() != faces) throw data::ArgumentError("cracks: not one depth per face");
  CrackPlan plan;
  plan.edge_depth.assign(3 * faces, -1);
  plan.display.assign(faces, Display::kNothing);
  for (std::size_t f = 0; f < faces; ++f) {
    const std::int32_t own = depth[f];
    if (own < 0) continue;
    std::int32_t neighbour[3];
    int deeper = 0;
    for (int k = 0; k < 3; ++k) {
      const std::int32_t g = adjacency.neighbour(static_cast<std::int32_t>(f), k);
      neighbour[k] = g < 0 || depth[g] < 0 ? own : depth[g];
      deeper += neighbour[k] > own ? 1 : 0;
    }
    const bool repaired =
        options.repair != Repair::kNone && deeper >= (rules.edge_depth == EdgeDepthRule::kTwoOrMore ? 2 : 1);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t edge = !repaired ? own
                                : rules.edge_depth == EdgeDepthRule::kRespective
                                    ? neighbour[k]
                                    : std::max(own, neighbour[k]);
      plan.edge_depth[3 * f + k] = static_cast<std::int8_t>(edge);
    }
    plan.display[f] = Display::kStrips;
    if (!repaired) continue;
    const bool fan =
        options.repair == Repair::kFan || own < 2 || rules.edge_depth == EdgeDepthRule::kRespective;
    plan.display[f] = fan ? Display::kFan : Display::kStitch;
    ++(fan ? plan.fans : plan.stitched);
  }
  return plan;
}

CrackPlan plan_cracks(const Adjacency& adjacency, std::span<const std::int32_t> depth,
                      const CrackOptions& options) {
  return plan_cracks(adjacency, depth, options, PrintedRules{});
}

}  // namespace limitcheck::fast
