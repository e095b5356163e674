// SPDX-License-Identifier: MIT
#include "fast/plan/crack.h"

#include <algorithm>

#include "data/error.h"
#include "fast/plan/faces.h"
#include "fast/plan/printed_rules.h"

namespace limitcheck::fast {

template <class Faces>
CrackPlan plan_cracks(const Faces& faces, std::span<const std::int32_t> depth, const CrackOptions& options,
                      const PrintedRules& rules) {
  if (depth.size() != static_cast<std::size_t>(faces.size()))
    throw data::ArgumentError("cracks: not one depth per face");
  CrackPlan plan;
  plan.edge_depth.assign(static_cast<std::size_t>(faces.first_side(faces.size())), -1);
  plan.display.assign(depth.size(), Display::kNothing);
  for (std::int32_t f = 0; f < faces.size(); ++f) {
    const std::int32_t own = depth[f];
    if (own < 0) continue;
    const auto beyond = [&](std::int32_t side) {
      const std::int32_t g = faces.across(side);
      return g < 0 || depth[g] < 0 ? own : depth[g];
    };
    int deeper = 0;
    const std::int32_t first = faces.first_side(f), end = faces.first_side(f + 1);
    for (std::int32_t side = first; side < end; ++side) deeper += beyond(side) > own ? 1 : 0;
    const bool repaired =
        options.repair != Repair::kNone && deeper >= (rules.edge_depth == EdgeDepthRule::kTwoOrMore ? 2 : 1);
    for (std::int32_t side = first; side < end; ++side) {
      const std::int32_t edge = !repaired ? own
                                : rules.edge_depth == EdgeDepthRule::kRespective
                                    ? beyond(side)
                                    : std::max(own, beyond(side));
      plan.edge_depth[side] = static_cast<std::int8_t>(edge);
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

template CrackPlan plan_cracks(const LoopFaces&, std::span<const std::int32_t>, const CrackOptions&,
                               const PrintedRules&);
template CrackPlan plan_cracks(const QuadFaces&, std::span<const std::int32_t>, const CrackOptions&,
                               const PrintedRules&);

}  // namespace limitcheck::fast
