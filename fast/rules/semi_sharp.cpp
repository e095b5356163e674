// SPDX-License-Identifier: MIT
#include "fast/rules/prepared_quads.h"

#include <algorithm>
#include <cstddef>

#include "fast/mesh/cut_mesh.h"

namespace limitcheck::fast {

namespace {

// The half of an edge towards a point where it goes straight on into another.
double half_towards(double sharpness, double onward, data::Creasing creasing) {
  return softened(sharpness, sharpness + onward, (sharpness > 0 ? 1 : 0) + (onward > 0 ? 1 : 0), creasing);
}

// One edge of a star at some level: the part at the vertex, the part after it (0 at level 0, where there is
// none), and which slot of which copy of the vertex it is.
struct Spoke {
  std::int32_t copy, slot;
  double near, onward;
  double far_sum;  // level 0: at the other end
  int far_count;
};

// A vertex before it was cut.
struct Hub {
  std::vector<std::int32_t> copies;
  std::vector<Spoke> spokes;  // those that are semi-sharp
  double sum = 0, vertex = 0;
  int count = 0;
};

int always_sharp(const QuadMesh& mesh, std::int32_t v) {
  switch (mesh.kind(v)) {
    case VertexKind::kHeld:
      return 3;
    case VertexKind::kDart:
      return 1;
    default:
      return mesh.adjacency.on_boundary(v) ? 2 : 0;
  }
}

}  // namespace

double edge_crease_share(double sharpness, double half, double other_half) {
  return half > 0 && other_half > 0 ? 1 : std::min(1., sharpness);
}

double curve_share(double before, double after, data::Creasing creasing) {
  if (before <= 0 || after <= 0) return 0;
  const double b = softened(before, before + after, 2, creasing),
               a = softened(after, before + after, 2, creasing);
  if (b > 0 && a > 0) return 1;
  double sum = 0, count = 0;
  if (b <= 0) sum += before, ++count;
  if (a <= 0) sum += after, ++count;
  return std::min(1., sum / count);
}

std::vector<StarTags> straight_steps(const SidePart& before, const SidePart& after, data::Creasing creasing) {
  std::vector<StarTags> steps;
  double a = after.sharpness, b = before.sharpness;
  double a_far = after.second_half, b_far = before.first_half;
  while (a > 0 || b > 0) {
    StarTags& tags = steps.emplace_back();
    tags.crease = curve_share(b, a, creasing);
    tags.crease_edge[1] = 2;
    const double a_near = half_towards(a, b, creasing), b_near = half_towards(b, a, creasing);
    tags.edges = {edge_crease_share(a, a_near, a_far), 0, edge_crease_share(b, b_near, b_far), 0};
    // The far half of what is near now: beyond it lies the far half.
    const double a_next = half_towards(a_near, a_far, creasing),
                 b_next = half_towards(b_near, b_far, creasing);
    a = a_near, b = b_near, a_far = a_next, b_far = b_next;
  }
  return steps;
}

SemiSharp::SemiSharp(const QuadMesh& mesh) : mesh_(&mesh) {
  if (!mesh.semi_sharp()) return;
  const QuadAdjacency& adjacency = mesh.adjacency;
  const auto uncut = [&](std::int32_t v) { return mesh.uncut.empty() ? v : mesh.uncut[v]; };
  steps_.resize(static_cast<std::size_t>(adjacency.vertex_count()));
  std::vector<Hub> hubs(steps_.size());
  for (std::int32_t v = 0; v < adjacency.vertex_count(); ++v) {
    if (adjacency.outgoing(v) < 0) continue;
    Hub& hub = hubs[uncut(v)];
    hub.copies.push_back(v);
    hub.vertex = mesh.vertex_sharpness[v];
    const auto fan = adjacency.fan(v);
    for (std::size_t i = 0; i < fan.size(); ++i) {
      const double s = mesh.side_sharpness[fan[i]];
      if (s <= 0) continue;
      hub.spokes.push_back({v, static_cast<std::int32_t>(i), s, 0, 0, 0});
      hub.sum += s;
      ++hub.count;
    }
  }
  for (Hub& hub : hubs) {
    for (Spoke& spoke : hub.spokes) {
      const Hub& far = hubs[uncut(adjacency.target(adjacency.fan(spoke.copy)[spoke.slot]))];
      spoke.far_sum = far.sum;
      spoke.far_count = far.count;
    }
  }

  for (const Hub& start : hubs) {
    if (start.count == 0 && start.vertex <= 0) continue;
    Hub hub = start;
    const int always = always_sharp(mesh, hub.copies[0]);
    for (bool first = true; hub.count > 0 || hub.vertex > 0; first = false) {
      Hub next{hub.copies, {}, 0, softened(hub.vertex, 0, 0, data::Creasing::kUniform), 0};
      StarTags tags;
      tags.sum = hub.sum;
      tags.count = hub.count;
      double vanishing = hub.vertex > 0 && next.vertex <= 0 ? hub.vertex : 0;
      int vanishing_count = vanishing > 0 ? 1 : 0;
      std::vector<Spoke> after = hub.spokes;
      std::vector<double> share;
      for (Spoke& spoke : after) {
        const double near = softened(spoke.near, hub.sum, hub.count, mesh.creasing);
        const double far = first ? softened(spoke.near, spoke.far_sum, spoke.far_count, mesh.creasing)
                                 : half_towards(spoke.near, spoke.onward, mesh.creasing);
        share.push_back(edge_crease_share(spoke.near, near, far));
        if (spoke.near > 0 && near <= 0) vanishing += spoke.near, ++vanishing_count;
        spoke.near = near;
        spoke.onward = far;
        next.sum += near;
        next.count += near > 0 ? 1 : 0;
      }

      const VertexRule now = rule_of(hub.vertex, always + hub.count),
                       then = rule_of(next.vertex, always + next.count);
      const double weight = now == VertexRule::kSmooth || now == then || vanishing_count == 0
                                ? 1
                                : std::min(1., vanishing / vanishing_count);
      for (const auto& [rule, part] : {std::pair{now, weight}, std::pair{then, 1 - weight}}) {
        if (rule == VertexRule::kHeld) tags.held += part;
        if (rule == VertexRule::kCrease) tags.crease += part;
      }
      // The two sharp edges: those that are so for ever come first and last in the ring.
      if (tags.crease > 0) {
        const bool of_now = now == VertexRule::kCrease;
        std::vector<std::int32_t> edges;
        if (always > 0) edges.push_back(0);
        for (std::size_t i = 0; i < after.size(); ++i)
          if ((of_now ? hub.spokes[i].near : after[i].near) > 0) edges.push_back(after[i].slot);
        for (std::size_t k = 0; k < 2 && always < 2; ++k) tags.crease_edge[k] = edges[k];
      }
      for (const std::int32_t v : hub.copies) {
        StarTags& own = steps_[v].emplace_back(tags);
        const auto faces = static_cast<std::int32_t>(adjacency.fan(v).size());
        if (always == 2) own.crease_edge[1] = faces;
        own.edges.assign(static_cast<std::size_t>(faces) + (adjacency.on_boundary(v) ? 1 : 0), 0);
        for (std::size_t i = 0; i < after.size(); ++i)
          if (after[i].copy == v) own.edges[static_cast<std::size_t>(after[i].slot)] = share[i];
      }
      next.spokes = std::move(after);
      hub = std::move(next);
    }
  }
}

void SemiSharp::along(std::int32_t h, int levels, std::vector<double>& out) const {
  out.clear();
  if (!has(h)) return;
  const std::int32_t a = mesh_->adjacency.origin(h), b = mesh_->adjacency.target(h);
  out.push_back(mesh_->side_sharpness[h]);
  std::size_t first = 0;
  for (int level = 0; level < levels; ++level) {
    const std::size_t n = std::size_t{1} << level;
    const auto end = [&](std::int32_t v, double s) {
      const StarTags* tags = step(v, static_cast<std::size_t>(level));
      return tags == nullptr ? softened(s, 0, 0, mesh_->creasing)
                             : softened(s, tags->sum, tags->count, mesh_->creasing);
    };
    for (std::size_t i = 0; i < n; ++i) {
      const double s = out[first + i];
      out.push_back(i == 0 ? end(a, s) : half_towards(s, out[first + i - 1], mesh_->creasing));
      out.push_back(i + 1 == n ? end(b, s) : half_towards(s, out[first + i + 1], mesh_->creasing));
    }
    first += n;
  }
}

}  // namespace limitcheck::fast
