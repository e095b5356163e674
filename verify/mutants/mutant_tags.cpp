// SPDX-License-Identifier: MIT
#include "verify/mutants/mutant_rules.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace limitcheck::verify {

using reference::Edge, reference::Sector, reference::Topology;
using V = MutantTags::V;

namespace {

bool is_semi_sharp(double sharpness) {
  return sharpness > 0 && sharpness < MutantTags::kForEver;
}

}  // namespace

MutantTags::MutantTags(const data::Sharpness& sharpness, const Topology& topology, std::string_view mutation)
    : edge_(topology.edges().size(), 0.),
      vertex_(topology.vertex_count(), 0.),
      chaikin_(sharpness.creasing == data::Creasing::kChaikin),
      smooth_triangles_(sharpness.triangles == data::TriangleRule::kSmooth),
      mutation_(mutation) {
  const auto value = [](float given) -> double {
    return given >= data::kInfiniteSharpness ? kForEver : given;
  };
  if (sharpness.boundary == data::Boundary::kEdgeAndCorner)
    for (std::size_t v = 0; v < vertex_.size(); ++v) {
      const Sector sector = topology.sector(static_cast<std::int32_t>(v));
      if (!sector.closed && sector.faces.size() == 1) vertex_[v] = kForEver;
    }
  std::map<std::pair<std::int32_t, std::int32_t>, double> tags;
  for (const data::SharpEdge& e : sharpness.edges) tags.emplace(std::minmax(e.a, e.b), value(e.sharpness));
  for (std::size_t k = 0; k < edge_.size(); ++k)
    if (const auto found = tags.find(std::minmax(topology.edges()[k].a, topology.edges()[k].b));
        found != tags.end())
      edge_[k] = found->second;
  for (const data::SharpVertex& v : sharpness.vertices)
    vertex_[v.vertex] = std::max(vertex_[v.vertex], value(v.sharpness));
}

double MutantTags::edge(const Topology& topology, std::int32_t e) const {
  return topology.edges()[e].on_boundary() ? kForEver : edge_[e];
}

bool MutantTags::plain(const Topology& topology, std::int32_t v) const {
  const Sector sector = topology.sector(v);
  return vertex_[v] == 0 && std::all_of(sector.edges.begin(), sector.edges.end(), [&](std::int32_t e) {
           return topology.edges()[e].on_boundary() || edge_[e] == 0;
         });
}

bool MutantTags::settled(const Topology& topology, std::int32_t v) const {
  const auto open = [&](double sharpness) {
    return is("last_sharp_step_missing") ? is_semi_sharp(sharpness) && sharpness > 1
                                         : is_semi_sharp(sharpness);
  };
  const Sector sector = topology.sector(v);
  return !open(vertex_[v]) && std::none_of(sector.edges.begin(), sector.edges.end(),
                                           [&](std::int32_t e) { return open(edge_[e]); });
}

MutantTags::Step MutantTags::step(const Topology& topology, std::int32_t v, bool next) const {
  const Sector sector = topology.sector(v);
  Step step{Rule::kCorner, {v, v}};
  if ((next ? fallen(vertex_[v]) : vertex_[v]) > 0) return step;
  int sharp = 0;
  for (std::size_t i = 0; i < sector.edges.size(); ++i) {
    const std::int32_t e = sector.edges[i];
    const bool counts = !is("boundary_not_counted") || sector.closed || topology.edges()[e].on_boundary();
    if (!counts || (next ? fallen(topology, e, v) : edge(topology, e)) <= 0) continue;
    if (sharp < 2) step.ends[sharp] = sector.neighbours[i];
    ++sharp;
  }
  if (is("three_edges_are_a_crease")) sharp = std::min(sharp, 2);
  step.rule = sharp == 0   ? Rule::kSmooth
              : sharp == 1 ? Rule::kDart
              : sharp == 2 ? Rule::kCrease
                           : Rule::kCorner;
  if (is("dart_as_corner") && sharp == 1) step.rule = Rule::kCorner;
  if (is("crease_as_corner") && sharp == 2 && sector.closed) step.rule = Rule::kCorner;
  return step;
}

double MutantTags::fallen(double sharpness) const {
  if (sharpness == kForEver) return kForEver;
  return std::max(0., sharpness - (is("falls_by_2") ? 2 : 1));
}

double MutantTags::fallen(const Topology& topology, std::int32_t e, std::int32_t v) const {
  const double own = edge(topology, e);
  if (topology.edges()[e].on_boundary()) return kForEver;
  if (!is_semi_sharp(own) || !chaikin_) return fallen(own);
  const Edge& edge_of_mesh = topology.edges()[e];
  const std::int32_t end =
      is("chaikin_ends_exchanged") ? (edge_of_mesh.a == v ? edge_of_mesh.b : edge_of_mesh.a) : v;
  double sum = 0, most = 0;
  int others = 0;
  for (const std::int32_t other : topology.sector(end).edges) {
    const double s = edge(topology, other);
    if (other == e || s <= 0) continue;
    if (s == kForEver && !is("chaikin_takes_infinite")) continue;
    sum += std::min(s, 10.);
    most = std::max(most, std::min(s, 10.));
    ++others;
  }
  if (others == 0) return fallen(own);
  const double share = is("chaikin_takes_half") ? 1. / 2 : 3. / 4;
  const double mean = is("chaikin_by_maximum") ? most : is("chaikin_by_sum") ? sum : sum / others;
  return fallen(share * own + (1 - share) * mean);
}

double MutantTags::edge_share(const Topology& topology, std::int32_t e) const {
  const double s = edge(topology, e);
  if (s <= 0 || (is("below_1_is_smooth") && s < 1)) return 0;
  if (chaikin_ && is_semi_sharp(s)) {
    const Edge& of = topology.edges()[e];
    const bool both = fallen(topology, e, of.a) > 0 && fallen(topology, e, of.b) > 0;
    if (both) return 1;
    if (is("chaikin_without_clamp")) return s;
  }
  return std::min(s, 1.);
}

double MutantTags::old_share(const Topology& topology, std::int32_t v) const {
  std::vector<double> ending;
  if (is_semi_sharp(vertex_[v]) && fallen(vertex_[v]) <= 0) ending.push_back(vertex_[v]);
  for (const std::int32_t e : topology.sector(v).edges)
    if (is_semi_sharp(edge(topology, e)) && fallen(topology, e, v) <= 0) ending.push_back(edge(topology, e));
  if (ending.empty()) return 1;
  const double mean = std::accumulate(ending.begin(), ending.end(), 0.) / static_cast<double>(ending.size());
  const double most = *std::max_element(ending.begin(), ending.end());
  const double share = std::min(1., is("blend_by_the_sharpest") ? most : mean);
  if (is("no_blend")) return 0;
  return is("blend_reversed") ? 1 - share : share;
}

V MutantTags::point(const Step& step, const std::vector<V>& points, std::int32_t v, const V& smooth) const {
  const V& c = points[v];
  if (step.rule == Rule::kCorner) return c;
  if (step.rule != Rule::kCrease) return smooth;
  return c + ((points[step.ends[0]] - c) + (points[step.ends[1]] - c)) * (1. / 8);
}

void MutantTags::sharpen(const Topology& topology, const std::vector<V>& points,
                         std::vector<V>& refined) const {
  for (std::size_t k = 0; k < topology.edges().size(); ++k) {
    const Edge& e = topology.edges()[k];
    if (e.on_boundary()) continue;
    const double share = edge_share(topology, static_cast<std::int32_t>(k));
    if (share == 0) continue;
    V& p = refined[points.size() + k];
    const V middle = (points[e.a] + points[e.b]) * 0.5;
    p = share == 1 ? middle : p + (middle - p) * share;
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto v = static_cast<std::int32_t>(k);
    if (plain(topology, v)) continue;
    const Step now = step(topology, v, false), next = step(topology, v, true);
    const V smooth = refined[k];
    refined[k] = point(now, points, v, smooth);
    const bool was_smooth = now.rule == Rule::kSmooth || now.rule == Rule::kDart;
    if (now.rule == next.rule || was_smooth) continue;
    const double share = old_share(topology, v);
    refined[k] = refined[k] * share + point(next, points, v, smooth) * (1 - share);
  }
}

MutantTags MutantTags::refined(const Topology& topology, const Topology& finer) const {
  if (none()) return {};
  MutantTags next = *this;
  next.control_ = false;
  next.edge_.assign(finer.edges().size(), 0.);
  next.vertex_.assign(finer.vertex_count(), 0.);
  const auto vertices = static_cast<std::int32_t>(topology.vertex_count());
  const auto edges = static_cast<std::int32_t>(topology.edges().size());
  for (std::size_t k = 0; k < finer.edges().size(); ++k) {  // halves join a vertex to the point of its edge
    const Edge& e = finer.edges()[k];
    const std::int32_t end = std::min(e.a, e.b), middle = std::max(e.a, e.b);
    if (end < vertices && middle >= vertices && middle < vertices + edges)
      next.edge_[k] = fallen(topology, middle - vertices, end);
    // Tags of control edges alone.
    if (control_ && is("tags_for_one_step")) next.edge_[k] = 0;
    if (control_ && is("tags_of_the_lower_end") && end < vertices && middle < vertices + edges) {
      const Edge& whole = topology.edges()[middle - vertices];
      if (end == std::max(whole.a, whole.b)) next.edge_[k] = 0;
    }
  }
  for (std::size_t v = 0; v < vertex_.size(); ++v) next.vertex_[v] = fallen(vertex_[v]);
  return next;
}

MutantTags MutantTags::of_part(const Topology& topology, const Topology& part,
                               const std::vector<std::int32_t>& vertices) const {
  MutantTags result = *this;
  result.edge_.clear();
  result.vertex_.clear();
  for (const Edge& e : part.edges()) {
    const Sector sector = topology.sector(vertices[e.a]);
    const auto at = std::find(sector.neighbours.begin(), sector.neighbours.end(), vertices[e.b]);
    result.edge_.push_back(edge_[sector.edges[static_cast<std::size_t>(at - sector.neighbours.begin())]]);
  }
  for (const std::int32_t v : vertices) result.vertex_.push_back(vertex_[v]);
  return result;
}

}  // namespace limitcheck::verify
