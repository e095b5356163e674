// SPDX-License-Identifier: MIT
// Catmull and Clark's rules with one of them changed.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

#include "reference/catmull_clark/vertex_limit.h"
#include "verify/mutants/mutant_rules.h"

namespace limitcheck::verify {
namespace {

namespace masks = reference::catmull_clark;
using reference::Topology;
using V = MutantRules::V;

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

class QuadRules : public MutantRules {
 public:
  using MutantRules::MutantRules;

  Points refine(const Topology& topology, const Points& points, int step, int) const override {
    const std::size_t vertices = points.size(), edges = topology.edges().size();
    Points refined(vertices + edges + topology.faces().size());
    for (std::size_t f = 0; f < topology.faces().size(); ++f)
      refined[vertices + edges + f] = face_point(topology.faces()[f], points, step);
    for (std::size_t e = 0; e < edges; ++e) {
      const reference::Edge& edge = topology.edges()[e];
      const V ends = points[edge.a] + points[edge.b];
      const V& left = refined[vertices + edges + edge.left_face];
      V& p = refined[vertices + e];
      if (edge.on_boundary()) {
        p = is("boundary_edge_flap") ? ends * (7. / 16) + left * (1. / 8) : ends * 0.5;
      } else {
        const double w = face_weight(topology, edge, step);
        p = ends * ((1 - 2 * w) / 2) + (left + refined[vertices + edges + edge.right_face]) * w;
      }
    }
    for (std::size_t v = 0; v < vertices; ++v)
      refined[v] = vertex_point(topology, points, refined, static_cast<std::int32_t>(v));
    return refined;
  }
  Limit limit(const MutantRing& ring, int) const override {
    const auto right = masks::limit_of<double>(ring);
    return {position(ring, right.position), normal(ring, right.tangents)};
  }

 private:
  V face_point(std::span<const std::int32_t> corners, const Points& points, int step) const;
  // Of each of the two face points in the point of an edge inside.
  double face_weight(const Topology& topology, const reference::Edge& edge, int step) const;
  V vertex_point(const Topology& topology, const Points& points, const Points& refined, std::int32_t v) const;
  // `right` where nothing is changed.
  V position(const MutantRing& ring, const V& right) const;
  V normal(const MutantRing& ring, const reference::Tangents<double>& right) const;
};

V QuadRules::face_point(std::span<const std::int32_t> corners, const Points& points, int step) const {
  if (is("polygons_as_quads")) return mean(points, corners, 4);
  if (is("six_corners_at_most")) return mean(points, corners, 6);
  if (is("centroid_by_area")) return centroid_by_area(points, corners);
  V p = mean(points, corners, corners.size());
  if (is("face_weight_1e-6")) p += (points[corners[0]] - p) * 1e-6;
  if (is("quarter_turn") && step == 0) p += (points[corners[0]] - p) * 1e-9;
  if (is("lower_corner") && step == 0)
    p += (points[*std::min_element(corners.begin(), corners.end())] - p) * 1e-9;
  return p;
}

double QuadRules::face_weight(const Topology& topology, const reference::Edge& edge, int step) const {
  if (is("edge_points_without_ends")) return 0.5;
  if (is("midpoints")) return 0;
  if (step > 0 || !is("smooth_triangles")) return 0.25;
  const auto of = [&](std::int32_t f) { return topology.faces()[f].size() == 3 ? 0.47 : 0.25; };
  return (of(edge.left_face) + of(edge.right_face)) / 2;
}

V QuadRules::vertex_point(const Topology& topology, const Points& points, const Points& refined,
                          std::int32_t v) const {
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

V QuadRules::position(const MutantRing& ring, const V& right) const {
  const V& c = ring.point;
  if (is("no_limit")) return c;
  if (ring.on_boundary)
    return is("boundary_limit_3_5") ? c * (3. / 5) + (ring.edges.front() + ring.edges.back()) * (1. / 5)
                                    : right;
  const V near = std::accumulate(ring.edges.begin(), ring.edges.end(), V{}),
          far = std::accumulate(ring.faces.begin(), ring.faces.end(), V{});
  const auto count = static_cast<double>(ring.faces.size());
  if (is("limit_at_valence_3") && count == 3) return (c * 3 + near * 2 + far) * (1. / 12);
  if (!is("limit_of_valence_4") && !is("limit_weights_1e-5")) return right;
  const double n = is("limit_of_valence_4") ? 4 : count * (1 + 1e-5);
  return (c * n + near * (4 / count) + far * (1 / count)) * (1 / (n + 5));
}

V QuadRules::normal(const MutantRing& ring, const reference::Tangents<double>& right) const {
  const V& c = ring.point;
  const auto& [e, f] = std::tie(ring.edges, ring.faces);
  if (is("mean_of_facets")) return reference::unit_normal<double>({}, facets(ring)).direction;
  auto t = right;
  if (!ring.on_boundary && (is("tangents_without_faces") || is("tangents_of_valence_4"))) {
    // f_i as the mask of valence 4 has it, in proportion
    const double share =
        is("tangents_of_valence_4") ? masks::four_lambda_minus_one<double>(std::ssize(f)) : 0;
    std::vector<V> other(f.begin(), f.end());
    for (V& p : other) p = c + (p - c) * share;
    t = masks::interior_tangents<double>(c, ring.edge_span(), other);
  }
  if (ring.on_boundary && is("boundary_tangent_mean")) {
    t.second = {};
    for (const V& p : e) t.second += p - c;
    for (const V& p : f) t.second += p - c;
  }
  if (ring.on_boundary && is("boundary_tangent_trap") &&
      f.size() >= 3) {  // that of another rule: without the faces
    t.second = {};
    for (std::size_t i = 1; i + 1 < e.size(); ++i)
      t.second +=
          (e[i] - c) * std::sin(std::numbers::pi * static_cast<double>(i) / static_cast<double>(f.size()));
  }
  return reference::unit_normal<double>(t, facets(ring)).direction;
}

}  // namespace

std::unique_ptr<MutantRules> quad_rules(std::string_view mutation) {
  return std::make_unique<QuadRules>(mutation);
}

}  // namespace limitcheck::verify
