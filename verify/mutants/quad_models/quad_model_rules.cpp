// SPDX-License-Identifier: MIT
#include "verify/mutants/quad_models/quad_model_rules.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limitcheck::verify {

using V = QuadModelRules::V;

namespace {

constexpr double kPi = std::numbers::pi;

V mean(const std::vector<V>& points, std::span<const std::int32_t> which, std::size_t most) {
  V sum{};
  const std::size_t count = std::min(which.size(), most);
  for (std::size_t k = 0; k < count; ++k) sum += points[which[k]];
  return sum * (1 / static_cast<double>(count));
}

double length(const V& a) {
  return std::hypot(a.x, a.y, a.z);
}

V centroid_by_area(const std::vector<V>& points, std::span<const std::int32_t> corners) {
  const V middle = mean(points, corners, corners.size());
  V sum{};
  double whole = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const V &a = points[corners[k]], &b = points[corners[(k + 1) % corners.size()]];
    const double area = length(cross(a - middle, b - middle));
    sum += (a + b + middle) * (area / 3);
    whole += area;
  }
  return whole > 0 ? sum * (1 / whole) : middle;
}

// The vertex opposite v in a quad.
std::int32_t opposite(std::span<const std::int32_t> quad, std::int32_t v) {
  const auto at = std::find(quad.begin(), quad.end(), v) - quad.begin();
  return quad[static_cast<std::size_t>(at + 2) % 4];
}

}  // namespace

V mean_of_facets(const QuadRing& ring) {
  V sum{};
  for (std::size_t i = 0; i < ring.f.size(); ++i)
    sum += cross(ring.e[i] - ring.c, ring.e[(i + 1) % ring.e.size()] - ring.c);
  return unit_or_up(sum);
}

V QuadModelRules::face_point(std::span<const std::int32_t> corners, const std::vector<V>& points,
                             int level) const {
  if (is("polygons_as_quads")) return mean(points, corners, 4);
  if (is("six_corners_at_most")) return mean(points, corners, 6);
  if (is("centroid_by_area")) return centroid_by_area(points, corners);
  V p = mean(points, corners, corners.size());
  if (is("face_weight_1e-6")) p += (points[corners[0]] - p) * 1e-6;
  if (is("quarter_turn") && level == 0) p += (points[corners[0]] - p) * 1e-9;
  if (is("lower_corner") && level == 0)
    p += (points[*std::min_element(corners.begin(), corners.end())] - p) * 1e-9;
  return p;
}

V QuadModelRules::vertex_point(const reference::Topology& topology, const std::vector<V>& points,
                               const std::vector<V>& refined, std::int32_t v) const {
  const reference::Sector sector = topology.sector(v);
  const V& c = points[v];
  const auto edges = points.size(), faces = edges + topology.edges().size();
  if (sector.faces.empty() || is("vertices_stay")) return c;
  if (!sector.closed && !is("boundary_as_inside")) {
    const V ends = points[sector.neighbours.front()] + points[sector.neighbours.back()];
    if (is("boundary_vertices_stay") || (is("corners_stay") && sector.faces.size() == 1)) return c;
    if (is("boundary_two_thirds")) return c * (2. / 3) + ends * (1. / 6);
    return c * (3. / 4) + ends * (1. / 8);
  }
  V sum{};
  for (std::size_t i = 0; i < sector.neighbours.size(); ++i)
    sum += is("ends_for_midpoints") ? refined[edges + sector.edges[i]] : points[sector.neighbours[i]];
  for (const std::int32_t f : sector.faces) sum += refined[faces + f];
  auto n = static_cast<double>(sector.faces.size());
  const double members = static_cast<double>(sector.neighbours.size()) + n;
  if (is("weights_of_valence_4")) n = 4;
  if (is("weights_of_valence_8")) n = std::min(n, 8.);
  const double inner = 2 / n;  // of all members together
  V p = c * (1 - inner) + sum * (inner / members);
  if (is("weight_1e-6_at_valence_5") && n == 5) p += (p - c) * 1e-6;
  return p;
}

std::vector<V> QuadModelRules::refine(const reference::Topology& topology, const std::vector<V>& points,
                                      const ModelTags& tags, int level) const {
  const std::size_t vertices = points.size(), edges = topology.edges().size();
  std::vector<V> refined(vertices + edges + topology.faces().size());
  for (std::size_t f = 0; f < topology.faces().size(); ++f)
    refined[vertices + edges + f] = face_point(topology.faces()[f], points, level);
  for (std::size_t e = 0; e < edges; ++e) {
    const reference::Edge& edge = topology.edges()[e];
    const V ends = points[edge.a] + points[edge.b];
    const V& left = refined[vertices + edges + edge.left_face];
    V& p = refined[vertices + e];
    if (edge.on_boundary()) {
      p = is("boundary_edge_flap") ? ends * (7. / 16) + left * (1. / 8) : ends * 0.5;
      continue;
    }
    const V faces = left + refined[vertices + edges + edge.right_face];
    double w = 0.25;
    const bool smooth = tags.smooth_triangles() && !is("triangles_not_smooth");
    const bool everywhere = smooth && (is("smooth_rule_for_all") || is("smooth_rule_in_every_step"));
    if ((level == 0 && (smooth || is("smooth_triangles"))) ||
        (level > 0 && everywhere && is("smooth_rule_in_every_step"))) {
      const auto of = [&](std::int32_t f) {
        return topology.faces()[f].size() == 3 || (everywhere && (level > 0 || is("smooth_rule_for_all")))
                   ? 0.47
                   : 0.25;
      };
      w = (of(edge.left_face) + of(edge.right_face)) / 2;
    }
    if (is("edge_points_without_ends")) w = 0.5;
    if (is("midpoints")) w = 0;
    p = ends * ((1 - 2 * w) / 2) + faces * w;
  }
  for (std::size_t v = 0; v < vertices; ++v)
    refined[v] = vertex_point(topology, points, refined, static_cast<std::int32_t>(v));
  if (!tags.none()) tags.sharpen(topology, points, refined);
  return refined;
}

QuadRing QuadModelRules::ring(const reference::Topology& topology, const std::vector<V>& points,
                              std::int32_t v) {
  const reference::Sector sector = topology.sector(v);
  QuadRing ring{points[v], {}, {}, sector.closed};
  for (const std::int32_t e : sector.neighbours) ring.e.push_back(points[e]);
  for (const std::int32_t f : sector.faces) ring.f.push_back(points[opposite(topology.faces()[f], v)]);
  return ring;
}

V QuadModelRules::limit(const QuadRing& ring) const {
  const V& c = ring.c;
  if (is("no_limit") || ring.f.empty()) return c;
  if (!ring.closed) {
    const V ends = ring.e.front() + ring.e.back();
    return is("boundary_limit_3_5") ? c * (3. / 5) + ends * (1. / 5) : c * (2. / 3) + ends * (1. / 6);
  }
  V near{}, far{};
  for (const V& e : ring.e) near += e;
  for (const V& f : ring.f) far += f;
  const auto count = static_cast<double>(ring.f.size());
  double n = is("limit_of_valence_4") ? 4 : count;
  if (is("limit_weights_1e-5")) n *= 1 + 1e-5;
  if (is("limit_at_valence_3") && count == 3) return (c * 3 + near * 2 + far) * (1. / 12);
  return (c * n + near * (4 / count) + far * (1 / count)) * (1 / (n + 5));
}

V QuadModelRules::normal(const QuadRing& ring) const {
  const V& c = ring.c;
  const std::vector<V>& e = ring.e;
  std::vector<V> f = ring.f;
  if (is("mean_of_facets")) return mean_of_facets(ring);
  if (is("tangents_without_faces") && ring.closed) f.assign(f.size(), c);
  if (is("tangents_of_valence_4") && ring.closed) {
    // f_i as the mask of valence 4 has it, in proportion.
    const double n = static_cast<double>(f.size()), t = 2 * kPi / n;
    const double cosine = std::cos(t),
                 right = (1 + cosine + std::cos(t / 2) * std::sqrt(2 * (9 + cosine))) / 4;
    for (V& p : f) p = c + (p - c) * right;
  }
  QuadTangents t = quad_tangents({c, e, f, ring.closed});
  if (!ring.closed && (is("boundary_tangent_mean") || (is("boundary_tangent_trap") && f.size() >= 3))) {
    V sum{};
    for (const V& p : e) sum += p - c;
    for (const V& p : f) sum += p - c;
    if (is("boundary_tangent_trap")) {  // the eigenvector of another rule: without the faces
      sum = {};
      for (std::size_t i = 1; i + 1 < e.size(); ++i)
        sum += (e[i] - c) * std::sin(kPi * static_cast<double>(i) / static_cast<double>(f.size()));
    }
    t.second = sum;
  }
  return unit_or_up(cross(t.first, t.second));
}

}  // namespace limitcheck::verify
