// SPDX-License-Identifier: MIT
#include "fast/plan/crack.h"

#include <algorithm>

#include "data/error.h"
#include "fast/mesh/cut_mesh.h"
#include "fast/plan/printed_rules.h"
#include "fast/plan/quad_faces.h"

namespace limitcheck::fast {

namespace {

// Faces of any number of sides: first(f) is the number of the first, across(side) the face beyond or -1.
template <class First, class Across>
CrackPlan plan_over(std::size_t faces, First&& first, Across&& across, std::span<const std::int32_t> depth,
                    const CrackOptions& options, const PrintedRules& rules) {
  if (depth.size() != faces) throw data::ArgumentError("cracks: not one depth per face");
  CrackPlan plan;
  plan.edge_depth.assign(first(faces), -1);
  plan.display.assign(faces, Display::kNothing);
  for (std::size_t f = 0; f < faces; ++f) {
    const std::int32_t own = depth[f];
    if (own < 0) continue;
    const auto beyond = [&](std::size_t side) {
      const std::int32_t g = across(side);
      return g < 0 || depth[g] < 0 ? own : depth[g];
    };
    int deeper = 0;
    for (std::size_t side = first(f); side < first(f + 1); ++side) deeper += beyond(side) > own ? 1 : 0;
    const bool repaired =
        options.repair != Repair::kNone && deeper >= (rules.edge_depth == EdgeDepthRule::kTwoOrMore ? 2 : 1);
    for (std::size_t side = first(f); side < first(f + 1); ++side) {
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

}  // namespace

CrackPlan plan_cracks(const Adjacency& adjacency, std::span<const std::int32_t> depth,
                      const CrackOptions& options, const PrintedRules& rules) {
  return plan_over(
      static_cast<std::size_t>(adjacency.face_count()), [](std::size_t f) { return 3 * f; },
      [&](std::size_t side) {
        const std::int32_t twin = adjacency.twin(static_cast<std::int32_t>(side));
        return twin < 0 ? -1 : Adjacency::face(twin);
      },
      depth, options, rules);
}

CrackPlan plan_cracks(const TriangleMesh& mesh, std::span<const std::int32_t> depth,
                      const CrackOptions& options, const PrintedRules& rules) {
  return plan_over(
      static_cast<std::size_t>(mesh.adjacency().face_count()), [](std::size_t f) { return 3 * f; },
      [&](std::size_t side) { return mesh.across(static_cast<std::int32_t>(side)); }, depth, options, rules);
}

CrackPlan plan_cracks(const QuadFaces& faces, std::span<const std::int32_t> depth,
                      const CrackOptions& options, const PrintedRules& rules) {
  return plan_over(
      static_cast<std::size_t>(faces.size()), [&](std::size_t f) { return faces.first[f]; },
      [&](std::size_t side) { return faces.across(static_cast<std::int32_t>(side)); }, depth, options, rules);
}

CrackPlan plan_cracks(const Adjacency& adjacency, std::span<const std::int32_t> depth,
                      const CrackOptions& options) {
  return plan_cracks(adjacency, depth, options, PrintedRules{});
}

}  // namespace limitcheck::fast
