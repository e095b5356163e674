// SPDX-License-Identifier: MIT
// Limits of the quad model where edges and vertices are sharp.
#include <span>
#include <utility>

#include "verify/mutants/models/model_neighbourhood.h"
#include "verify/mutants/quad_models/quad_model_rules.h"

namespace limitcheck::verify {

using reference::Topology;
using Rule = ModelTags::Rule;
using V = QuadModelRules::V;

ModelTags QuadModelRules::tags(const data::Sharpness& sharpness, const Topology& topology) const {
  return sharpness.empty() ? ModelTags() : ModelTags(sharpness, topology, mutation_);
}

ModelLimit QuadModelRules::limit(const Topology& topology, const std::vector<V>& points,
                                 const ModelTags& tags, std::int32_t v) const {
  const auto faces = topology.sector(v).faces;
  if (tags.none() || faces.empty() || tags.plain(topology, v)) {
    const QuadRing around = ring(topology, points, v);
    return {limit(around), {normal(around)}};
  }
  if (tags.settled(topology, v)) return sharp_limit(topology, points, tags, v, faces);
  const auto near = ModelNeighbourhood::settled(
      v, topology, points, tags, [this](const Topology& t, const std::vector<V>& p, const ModelTags& s) {
        return refine(t, p, s, /*level=*/1);
      });
  return sharp_limit(near.topology, near.points, near.tags, near.vertex, near.ring);
}

// Of a vertex whose rule stays.
//   faces   around it, in the order of the normals asked for
ModelLimit QuadModelRules::sharp_limit(const Topology& topology, const std::vector<V>& points,
                                       const ModelTags& tags, std::int32_t v,
                                       std::span<const std::int32_t> faces) const {
  const ModelSides sides(topology, tags, v);
  const QuadRing whole = ring(topology, points, v);
  const std::size_t count = whole.f.size();
  if (sides.rule() == Rule::kSmooth) return {limit(whole), {normal(whole)}};
  if (sides.rule() == Rule::kDart) {
    const std::size_t first = sides.sharp()[0];
    const QuadRing turned{whole.c, ModelSides::turned(whole.e, first, count),
                          ModelSides::turned(whole.f, first, count), true};
    const QuadTangents t = dart_tangents(turned);
    return {is("dart_limit_smooth") ? limit(turned) : dart_limit(turned),
            {is("dart_normal_smooth") ? normal(turned) : unit_or_up(cross(t.first, t.second))}};
  }
  return sides.limit(points, faces, [&](std::size_t first, std::size_t length) {
    if (sides.sharp().empty()) return mean_of_facets(whole);
    const QuadRing part{whole.c, ModelSides::turned(whole.e, first, length + 1),
                        ModelSides::turned(whole.f, first, length), false};
    return sides.rule() == Rule::kCorner ? mean_of_facets(part) : normal(part);
  });
}

}  // namespace limitcheck::verify
