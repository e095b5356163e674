// SPDX-License-Identifier: MIT
#include "reference/mesh/sharpness.h"

#include <algorithm>
#include <string>

#include "data/error.h"
#include "reference/point/parameter_exact.h"

namespace limitcheck::reference {
namespace {

[[noreturn]] void refuse(const std::string& why) {
  throw data::ArgumentError("sharpness: " + why);
}

Rational exact_sharpness(const Parameter& given) {
  if (!(given.as_double() >= 0)) refuse("a sharpness is negative or no number");
  const Rational infinite(10);
  return given.as_double() > 11 ? infinite : std::min(exact_value(given), infinite);
}

/// The edge between two vertices, or -1.
std::int32_t edge_between(const Topology& topology, std::int32_t a, std::int32_t b) {
  const auto count = static_cast<std::int32_t>(topology.vertex_count());
  if (a < 0 || b < 0 || a >= count || b >= count) return -1;
  const Sector sector = topology.sector(a);
  for (std::size_t i = 0; i < sector.neighbours.size(); ++i)
    if (sector.neighbours[i] == b) return sector.edges[i];
  return -1;
}

}  // namespace

Sharpness::Sharpness(const Topology& topology, const SharpTags& tags)
    : edge_(topology.edges().size()),
      vertex_(topology.vertex_count()),
      chaikin_(tags.creasing == data::Creasing::kChaikin) {
  std::vector<bool> tagged(edge_.size(), false);
  for (const auto& tag : tags.edges) {
    const std::int32_t e = edge_between(topology, tag.a, tag.b);
    const std::string name = std::to_string(tag.a) + "-" + std::to_string(tag.b);
    if (e < 0) refuse("there is no edge " + name);
    const Rational s = exact_sharpness(tag.sharpness);
    const auto at = static_cast<std::size_t>(e);
    if (tagged[at] && edge_[at] != s) refuse("edge " + name + " has two");
    tagged[at] = true;
    edge_.set(at, s);
  }
  tagged.assign(vertex_.size(), false);
  for (const auto& tag : tags.vertices) {
    if (tag.vertex < 0 || static_cast<std::size_t>(tag.vertex) >= vertex_.size())
      refuse("there is no vertex " + std::to_string(tag.vertex));
    const Rational s = exact_sharpness(tag.sharpness);
    const auto at = static_cast<std::size_t>(tag.vertex);
    if (tagged[at] && vertex_[at] != s) refuse("vertex " + std::to_string(tag.vertex) + " has two");
    tagged[at] = true;
    vertex_.set(at, s);
  }
  for (const auto& tag : tags.beyond) {
    if (tag.vertex < 0 || static_cast<std::size_t>(tag.vertex) >= vertex_.size())
      refuse("there is no vertex " + std::to_string(tag.vertex));
    beyond_[tag.vertex].push_back({exact_sharpness(tag.sharpness), tag.holds});
  }
  if (tags.boundary == data::Boundary::kEdgeAndCorner)
    for (std::size_t v = 0; v < vertex_.size(); ++v) {
      const Sector sector = topology.sector(static_cast<std::int32_t>(v));
      if (!sector.closed && sector.faces.size() == 1) vertex_.set(v, 10);
    }
}

bool Sharpness::is_smooth_around(const Topology& topology, std::int32_t v) const {
  if (!vertex_.is_zero(static_cast<std::size_t>(v))) return false;
  const auto edges = topology.sector(v).edges;
  return std::none_of(edges.begin(), edges.end(), [&](std::int32_t e) { return is_sharp(topology, e); });
}

Rational Sharpness::half_after_step(const Topology& topology, std::int32_t e, std::int32_t v) const {
  const Rational& s = edge(e);
  return topology.edges()[static_cast<std::size_t>(e)].on_boundary() ? one_less(s)
                                                                     : half_after_step(topology, s, v);
}

Rational Sharpness::half_after_step(const Topology& topology, const Rational& s, std::int32_t v) const {
  if (!is_semi_sharp(s)) return s;
  Rational others = -s;
  int count = -1;
  const auto add = [&](const Rational& other) {
    if (is_semi_sharp(other)) others += other, ++count;
  };
  if (chaikin_) {
    for (const std::int32_t e : topology.sector(v).edges)
      if (!topology.edges()[static_cast<std::size_t>(e)].on_boundary()) add(edge(e));
    if (const auto at = beyond_.find(v); at != beyond_.end())
      for (const Beyond& other : at->second) add(other.sharpness);
  }
  if (count < 1) return one_less(s);
  const Rational next = s * Rational(3, 4) + others / (4 * count) - 1;
  return next > 0 ? next : Rational(0);
}

Rational Sharpness::edge_share(const Topology& topology, std::int32_t e) const {
  const Rational& s = edge(e);
  if (s >= 1 || s == 0) return s == 0 ? Rational(0) : Rational(1);
  const Edge& ends = topology.edges()[static_cast<std::size_t>(e)];
  if (chaikin_ && half_after_step(topology, e, ends.a) > 0 && half_after_step(topology, e, ends.b) > 0)
    return 1;
  return s;
}

VertexRules Sharpness::rules(const Topology& topology, std::int32_t v) const {
  const Sector sector = topology.sector(v);
  const Rational &own = vertex_[static_cast<std::size_t>(v)], own_after = one_less(own);
  VertexRules result{};
  int parents = 0, children = 0, vanishing = 0;
  Rational sum;
  const auto vanishes = [&](const Rational& s, const Rational& after) {
    const bool counts = chaikin_ ? s > 0 && after == 0 : s > 0 && s <= 1;
    if (counts) sum += s, ++vanishing;
  };
  for (std::size_t i = 0; i < sector.edges.size(); ++i) {
    const std::int32_t e = sector.edges[i], end = sector.neighbours[i];
    if (!is_sharp(topology, e)) continue;
    if (parents < 2) result.parent.ends[static_cast<std::size_t>(parents)] = end;
    ++parents;
    const bool lasts = stays_sharp(topology, e);
    const Rational after = lasts ? Rational(10) : half_after_step(topology, e, v);
    if (!lasts) vanishes(edge(e), after);
    if (after == 0) continue;
    if (children < 2) result.child.ends[static_cast<std::size_t>(children)] = end;
    ++children;
  }
  if (const auto at = beyond_.find(v); at != beyond_.end())
    for (const Beyond& edge : at->second) {
      if (!edge.holds) continue;
      const Rational after = half_after_step(topology, edge.sharpness, v);
      vanishes(edge.sharpness, after);
      ++parents;
      children += after > 0 ? 1 : 0;
    }
  vanishes(own, own_after);
  const auto rule = [](const Rational& held, int edges) {
    if (held > 0) return VertexRule::kCorner;
    return static_cast<VertexRule>(std::min(edges, 3));
  };
  result.parent.rule = rule(own, parents);
  result.child.rule = rule(own_after, children);
  const bool blends = result.parent.rule != result.child.rule && result.parent.rule != VertexRule::kSmooth &&
                      result.parent.rule != VertexRule::kDart && vanishing > 0;
  result.parent_share = blends ? std::min(Rational(1), Rational(sum / vanishing)) : Rational(1);
  return result;
}

Sharpness Sharpness::refined(const Topology& topology, const Topology& finer) const {
  Sharpness result;
  result.chaikin_ = chaikin_;
  result.vertex_ = SparseRationals(finer.vertex_count());
  for (std::size_t v = 0; v < vertex_.size(); ++v)
    if (!vertex_.is_zero(v)) result.vertex_.set(v, one_less(vertex_[v]));
  result.edge_ = SparseRationals(finer.edges().size());
  const std::size_t vertices = topology.vertex_count(), edges = topology.edges().size();
  for (std::size_t e = 0; e < finer.edges().size(); ++e) {
    const auto [v, point] = std::minmax(finer.edges()[e].a, finer.edges()[e].b);
    const auto parent = static_cast<std::size_t>(point) - vertices;
    if (static_cast<std::size_t>(v) >= vertices || parent >= edges) continue;
    if (!edge_.is_zero(parent))
      result.edge_.set(e, half_after_step(topology, static_cast<std::int32_t>(parent), v));
  }
  for (const auto& [v, edges_beyond] : beyond_)
    for (const Beyond& edge : edges_beyond)
      if (const Rational after = half_after_step(topology, edge.sharpness, v); after > 0)
        result.beyond_[v].push_back({after, edge.holds});
  return result;
}

Sharpness Sharpness::of_part(const Topology& topology, const Topology& part,
                             const std::vector<std::int32_t>& faces,
                             const std::vector<std::int32_t>& vertices) const {
  Sharpness result;
  result.chaikin_ = chaikin_;
  result.edge_ = SparseRationals(part.edges().size());
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = 0; k < part.faces()[f].size(); ++k)
      if (const std::int32_t e = topology.edge(static_cast<std::size_t>(faces[f]), k); !is_smooth(e))
        result.edge_.set(static_cast<std::size_t>(part.edge(f, k)), edge(e));
  result.vertex_ = SparseRationals(vertices.size());
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    result.vertex_.set(k, vertex_[static_cast<std::size_t>(vertices[k])]);
    if (const auto at = beyond_.find(vertices[k]); at != beyond_.end())
      result.beyond_[static_cast<std::int32_t>(k)] = at->second;
  }
  return result;
}

SharpTags Sharpness::tags(const Topology& topology) const {
  SharpTags result;
  const auto exact = [](const Rational& s) { return Parameter::parse(s.str()); };
  for (std::size_t e = 0; e < edge_.size(); ++e)
    if (!edge_.is_zero(e))
      result.edges.push_back({topology.edges()[e].a, topology.edges()[e].b, exact(edge_[e])});
  for (std::size_t v = 0; v < vertex_.size(); ++v)
    if (!vertex_.is_zero(v)) result.vertices.push_back({static_cast<std::int32_t>(v), exact(vertex_[v])});
  for (const auto& [v, edges] : beyond_)
    for (const Beyond& edge : edges) result.beyond.push_back({v, exact(edge.sharpness), edge.holds});
  result.creasing = creasing();
  return result;
}

int Sharpness::lasting_edges(const Topology& topology, std::int32_t v) const {
  int count = 0;
  for (const std::int32_t e : topology.sector(v).edges) count += stays_sharp(topology, e) ? 1 : 0;
  return count;
}

std::vector<bool> Sharpness::needs_a_step(const Topology& topology) const {
  std::vector<bool> at_vertex(topology.vertex_count(), false);
  for (std::size_t v = 0; v < vertex_.size(); ++v)
    at_vertex[v] = !vertex_.is_zero(v) && is_semi_sharp(vertex_[v]);
  for (const auto& [v, edges] : beyond_)
    for (const Beyond& edge : edges)
      if (edge.holds) at_vertex[static_cast<std::size_t>(v)] = true;
  for (std::size_t e = 0; e < edge_.size(); ++e) {
    const Edge& ends = topology.edges()[e];
    if (ends.on_boundary() || edge_.is_zero(e)) continue;
    if (is_semi_sharp(edge_[e]) ||
        (lasting_edges(topology, ends.a) == 1 && lasting_edges(topology, ends.b) == 1))
      at_vertex[static_cast<std::size_t>(ends.a)] = at_vertex[static_cast<std::size_t>(ends.b)] = true;
  }
  std::vector<bool> result(topology.faces().size(), false);
  for (std::size_t f = 0; f < result.size(); ++f)
    for (const std::int32_t v : topology.faces()[f])
      result[f] = result[f] || at_vertex[static_cast<std::size_t>(v)];
  return result;
}

Sharpness::Cut Sharpness::cut(const Topology& topology) const {
  Cut result{topology.faces(), {}, {}};
  const std::size_t count = topology.vertex_count();
  result.origin.resize(count);
  result.states.assign(count, VertexState::kOrdinary);
  for (std::size_t id = 0; id < count; ++id) {
    const auto v = static_cast<std::int32_t>(id);
    result.origin[id] = v;
    const Sector sector = topology.sector(v);
    std::vector<std::size_t> sharp;  // where in the sector
    for (std::size_t i = 0; i < sector.edges.size(); ++i)
      if (stays_sharp(topology, sector.edges[i])) sharp.push_back(i);
    const bool held = (!vertex_.is_zero(id) && is_infinite(vertex_[id])) || sharp.size() > 2;
    const bool uncut = sector.closed && sharp.size() == 1 &&
                       lasting_edges(topology, sector.neighbours[sharp[0]]) == 1;  // needs a step
    const VertexState state = held                                           ? VertexState::kHeld
                              : sector.closed && sharp.size() == 1 && !uncut ? VertexState::kDart
                                                                             : VertexState::kOrdinary;
    result.states[id] = state;
    // From one sharp edge to the next all faces have the same copy; the first copy is the vertex itself.
    for (std::size_t s = 0; s + (sector.closed ? 0 : 1) < sharp.size(); ++s) {
      if (s == 0) continue;
      const auto copy = static_cast<std::int32_t>(result.origin.size());
      result.origin.push_back(v);
      result.states.push_back(state);
      const std::size_t end = s + 1 < sharp.size() ? sharp[s + 1] : sharp[0] + sector.faces.size();
      for (std::size_t i = sharp[s]; i < end; ++i) {
        const std::int32_t f = sector.faces[i % sector.faces.size()];
        for (std::int32_t& corner : result.faces[static_cast<std::size_t>(f)])
          if (corner == v) corner = copy;
      }
    }
  }
  return result;
}

}  // namespace limitcheck::reference
