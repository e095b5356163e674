// SPDX-License-Identifier: MIT
#include "verify/mutants/models/model_sharp.h"

#include <cmath>
#include <map>
#include <numbers>
#include <span>

#include "verify/mutants/models/model_dart.h"
#include "verify/mutants/models/model_neighbourhood.h"

namespace limitcheck::verify {

using reference::Topology;
using Rule = ModelTags::Rule;
using V = ModelRules::V;

namespace {

// Of the points c, r_0 .. r_{n-1}; the sharp edge leads to r_0.
const RingMasks& dart_masks(std::size_t n) {
  static std::map<std::size_t, RingMasks> known;
  const auto [at, is_new] = known.try_emplace(n);
  if (!is_new) return at->second;
  const auto r = [n](std::size_t i) { return 1 + i % n; };
  const double turn = 2 * std::numbers::pi / static_cast<double>(n), s = 3 + 2 * std::cos(turn);
  const double all = 5. / 8 - s * s / 64;  // of the neighbours together
  const auto step = [&](const std::vector<double>& p) {
    std::vector<double> q(p.size());
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      sum += p[r(i)];
      q[r(i)] = 3. / 8 * (p[0] + p[r(i)]) + 1. / 8 * (p[r(i + 1)] + p[r(i + n - 1)]);
    }
    q[0] = (1 - all) * p[0] + all / static_cast<double>(n) * sum;
    q[r(0)] = (p[0] + p[r(0)]) / 2;
    return q;
  };
  const auto mirror = [n](std::size_t k) { return k == 0 ? k : 1 + (n - (k - 1)) % n; };
  std::vector<double> even(n + 1, 0.), odd(n + 1, 0.);
  for (std::size_t i = 0; i < n; ++i) {
    even[r(i)] = std::cos(turn * static_cast<double>(i));
    odd[r(i)] = std::sin(turn * static_cast<double>(i));
  }
  return at->second = ring_masks(n + 1, step, mirror, even, odd);
}

// Of a vertex whose rule stays.
//   faces   around it, in the order of the normals asked for
ModelLimit lasting_limit(const ModelRules& rules, const Topology& topology, const std::vector<V>& points,
                         const ModelTags& tags, std::int32_t v, int depth,
                         std::span<const std::int32_t> faces) {
  const ModelSides sides(topology, tags, v);
  const V& c = points[v];
  const ModelLimit smooth{rules.limit(topology, points, v, depth), {rules.normal(topology, points, v)}};
  if (sides.rule() == Rule::kSmooth) return smooth;
  std::vector<V> ring;
  for (const std::int32_t r : topology.ring(v)) ring.push_back(points[r]);
  if (sides.rule() == Rule::kDart) {
    const std::vector<V> turned = ModelSides::turned(ring, sides.sharp()[0], ring.size());
    const RingMasks& masks = dart_masks(ring.size());
    V limit = c, first{}, second{};
    for (std::size_t i = 0; i < ring.size(); ++i) {
      limit += (turned[i] - c) * masks.limit[1 + i];
      first += (turned[i] - c) * masks.first[1 + i];
      second += (turned[i] - c) * masks.second[1 + i];
    }
    return {rules.is("dart_limit_smooth") ? smooth.position : limit,
            {rules.is("dart_normal_smooth") ? smooth.normals[0] : unit_or_up(cross(first, second))}};
  }
  return sides.limit(points, faces, [&](std::size_t first, std::size_t count) {
    if (sides.sharp().empty()) return smooth.normals[0];
    const std::vector<V> part = ModelSides::turned(ring, first, count + 1);
    return sides.rule() == Rule::kCorner ? unit_or_up(cross(part.front() - c, part.back() - c))
                                         : rules.normal(c, part, /*open=*/true);
  });
}

}  // namespace

std::vector<V> sharp_refine(const ModelRules& rules, const Topology& topology, const std::vector<V>& points,
                            const ModelTags& tags, int depth) {
  std::vector<V> next = rules.refine(topology, points, depth);
  if (!tags.none()) tags.sharpen(topology, points, next);
  return next;
}

ModelLimit sharp_limit(const ModelRules& rules, const Topology& topology, const std::vector<V>& points,
                       const ModelTags& tags, std::int32_t v, int depth) {
  if (tags.settled(topology, v))
    return lasting_limit(rules, topology, points, tags, v, depth, topology.sector(v).faces);
  const auto near = ModelNeighbourhood::settled(
      v, topology, points, tags, [&](const Topology& t, const std::vector<V>& p, const ModelTags& s) {
        return sharp_refine(rules, t, p, s, depth);
      });
  return lasting_limit(rules, near.topology, near.points, near.tags, near.vertex, depth, near.ring);
}

}  // namespace limitcheck::verify
