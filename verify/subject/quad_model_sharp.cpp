// SPDX-License-Identifier: MIT
// Limits where edges and vertices are sharp.
#include <algorithm>
#include <span>

#include "verify/subject/quad_model_rules.h"
#include "verify/subject/quad_neighbourhood.h"

namespace limitcheck::verify {

using reference::Sector;
using reference::Topology;
using V = QuadModelRules::V;

ModelTags QuadModelRules::tags(const data::Sharpness& sharpness, const Topology& topology) const {
  return sharpness.empty() ? ModelTags() : ModelTags(sharpness, topology, mutation_);
}

QuadModelRules::Limit QuadModelRules::limit(const Topology& topology, const std::vector<V>& points,
                                            const ModelTags& tags, std::int32_t v) const {
  const auto faces = topology.sector(v).faces;
  if (tags.none() || faces.empty() || tags.plain(topology, v)) {
    const QuadRing around = ring(topology, points, v);
    return {limit(around), {normal(around)}};
  }
  if (tags.settled(topology, v)) return sharp_limit(topology, points, tags, v, faces);
  // As many steps more as there are tags that fall.
  QuadNeighbourhood near = QuadNeighbourhood::around(v, faces, topology, points, tags);
  for (int step = 0; step < 32 && !near.tags.settled(near.topology, near.vertex); ++step)
    near = near.refined(*this);
  return near.tags.plain(near.topology, near.vertex)
             ? limit(near.topology, near.points, near.tags, near.vertex)
             : sharp_limit(near.topology, near.points, near.tags, near.vertex, near.ring);
}

// Of a vertex whose tags stay.
//   faces   around it, in the order of the normals asked for
QuadModelRules::Limit QuadModelRules::sharp_limit(const Topology& topology, const std::vector<V>& points,
                                                  const ModelTags& tags, std::int32_t v,
                                                  std::span<const std::int32_t> faces) const {
  const Sector sector = topology.sector(v);
  const std::size_t count = sector.faces.size();
  const QuadRing whole = ring(topology, points, v);
  std::vector<std::size_t> sharp;  // which neighbours are across an edge that stays sharp
  for (std::size_t i = 0; i < sector.edges.size(); ++i)
    if (tags.lasts(topology, sector.edges[i])) sharp.push_back(i);
  using Rule = ModelTags::Rule;
  const Rule rule = tags.vertex(v) == ModelTags::kForEver ? Rule::kCorner
                    : sharp.size() == 1                   ? Rule::kDart
                    : sharp.size() == 2                   ? Rule::kCrease
                    : sharp.empty()                       ? Rule::kSmooth
                                                          : Rule::kCorner;
  if (rule == Rule::kSmooth) return {limit(whole), {normal(whole)}};

  // The ring begun at a sharp edge.
  const auto from = [&](std::size_t first, std::size_t length) {
    QuadRing part{whole.c, {}, {}, false};
    for (std::size_t i = 0; i < length; ++i) part.f.push_back(whole.f[(first + i) % count]);
    for (std::size_t i = 0; i <= length; ++i) part.e.push_back(whole.e[(first + i) % whole.e.size()]);
    return part;
  };
  if (rule == Rule::kDart) {
    QuadRing turned = from(sharp[0], count);
    turned.e.pop_back();
    turned.closed = true;
    const QuadTangents t = dart_tangents(turned);
    return {is("dart_limit_smooth") ? limit(turned) : dart_limit(turned),
            {is("dart_normal_smooth") ? normal(turned) : unit_or_up(cross(t.first, t.second))}};
  }
  const bool corner = rule == Rule::kCorner;
  Limit result;
  result.position = whole.c;
  if (!corner || is("corner_limit_moved")) {
    const std::size_t last = sharp.size() > 1 ? sharp.back() : 0, first = sharp.empty() ? 0 : sharp.front();
    result.position = whole.c * (2. / 3) + (whole.e[first] + whole.e[last]) * (1. / 6);
  }
  if (sharp.empty()) return {result.position, {mean_of_facets(whole)}};

  // A normal for each stretch between two sharp edges.
  std::vector<V> normals(count);
  const std::size_t stretches = sector.closed ? sharp.size() : sharp.size() - 1;
  for (std::size_t k = 0; k < stretches; ++k) {
    const std::size_t first = sharp[k], next = k + 1 < sharp.size() ? sharp[k + 1] : sharp[0] + count;
    const QuadRing part = from(first, next - first);
    const V n = corner ? mean_of_facets(part) : normal(part);
    for (std::size_t i = first; i < next; ++i) normals[i % count] = n;
  }
  if (is("normal_of_the_other_side"))
    std::rotate(normals.begin(), normals.begin() + static_cast<std::ptrdiff_t>(count / 2), normals.end());
  if (is("one_normal_for_all_sides")) normals.assign(count, V(normals[0]));
  if (is("mean_of_all_sides")) {
    V sum{};
    for (const V& n : normals) sum += n;
    normals.assign(count, unit_or_up(sum));
  }
  for (const std::int32_t f : faces) {
    const auto at = std::find(sector.faces.begin(), sector.faces.end(), f) - sector.faces.begin();
    result.normals.push_back(normals[static_cast<std::size_t>(at)]);
  }
  if (stretches == 1) result.normals.resize(1);
  return result;
}

}  // namespace limitcheck::verify
