// SPDX-License-Identifier: MIT
#include "verify/subject/quad_model_rules.h"

#include <algorithm>
#include <cmath>

#include "reference/catmull_clark/masks.h"

namespace limitcheck::verify {

using V = QuadModelRules::V;

std::span<const Mutation> quad_mutations() {
  static const std::vector<Mutation> list{
      {"none", "nothing: right in every check", ""},
      // Subdivision.
      {"face_weight_1e-6", "face points lean by 1e-6 to the first corner", "positions"},
      {"polygons_as_quads", "the face point of any face is the mean of its first four corners", "positions"},
      {"centroid_by_area", "face points are centroids by area", "positions"},
      {"six_corners_at_most", "a face point counts six corners and no more", "positions"},
      {"edge_points_without_ends", "edge points are the means of two face points", "positions"},
      {"midpoints", "edge points half and half", "positions"},
      {"smooth_triangles", "OpenSubdiv's weights beside triangles, in the first step", "positions"},
      {"ends_for_midpoints", "the vertex rule takes edge points in place of the neighbours", "positions"},
      {"weights_of_valence_4", "the vertex rule of valence 4 at every valence", "positions"},
      {"weights_of_valence_8", "a table of weights that ends at valence 8", "positions"},
      {"weight_1e-6_at_valence_5", "a vertex of valence 5 is moved by 1e-6 of its step too far", "positions"},
      {"vertices_stay", "vertices are not moved by a step", "positions"},
      {"one_step_missing", "one step less than asked for at the vertices", "positions"},
      // Boundary.
      {"boundary_two_thirds", "boundary vertices 1/6, 2/3, 1/6: the limit mask taken for the rule",
       "positions"},
      {"boundary_vertices_stay", "boundary vertices stay where they are", "positions"},
      {"boundary_as_inside", "boundary vertices by the rule of those inside", "positions"},
      {"corners_stay", "boundary vertices of one face stay where they are", "positions"},
      {"boundary_edge_flap", "boundary edge points take an eighth of the face point", "positions"},
      {"boundary_limit_3_5", "boundary limits 1/5, 3/5, 1/5", "positions"},
      {"boundary_tangent_trap", "the tangent mask of another boundary rule from three faces on", "normals"},
      {"boundary_tangent_mean", "across the boundary: towards the mean of the neighbours", "normals"},
      // Limit.
      {"no_limit", "points of the refined mesh instead of the limit", "positions"},
      {"limit_of_valence_4", "the limit mask of valence 4 at every valence", "positions"},
      {"limit_at_valence_3", "at valence 3 the limit is the mean of the faces around", "positions"},
      {"limit_weights_1e-5", "all limit weights are 1e-5 off", "positions"},
      {"tangents_of_valence_4", "tangents take f_i with the weight of valence 4", "normals"},
      {"tangents_without_faces", "tangents of the neighbours alone", "normals"},
      {"mean_of_facets", "normals are means of the facets around", "normals"},
      {"flipped_on_polygons", "normals inside faces that are no quads point inward", "normals"},
      // Places.
      {"quarter_turn", "the inside of a quad leans by 1e-9 to its first corner", "corner-rotation"},
      {"lower_corner", "face points lean by 1e-9 to the corner with the lowest number", "vertex-order"},
      {"next_corner", "points of the quad at a corner are said to be of the next corner's", "positions"},
      {"u_for_v", "u and v are exchanged", "orientation"},
      {"one_level_more_in_polygons", "faces that are no quads are one level finer than asked for",
       "coverage"},
      {"middle_left_out", "faces that are no quads have a hole in the middle", "coverage"},
      {"corner_is_null", "the corner of no point is delivered", "positions"},
      {"clockwise_polygons", "triangles of faces that are no quads run clockwise", "orientation"},
      // Frames.
      {"unstitched", "faces beside deeper ones are not stitched to them", "watertight"},
      {"stitched_on_side_0", "faces are stitched to deeper ones on their first side only", "t-vertices"},
      {"ulp_on_polygons", "points of faces that are no quads are one ulp off", "shared-positions"},
      {"culled_are_holes", "culled faces are left out before the first step", "positions"},
      {"cache_by_count", "a mesh of as many vertices and faces is taken for the one before", "state"},
      {"every_other_time", "every other frame has a point one ulp off", "determinism"},
  };
  return list;
}

namespace {

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
                                      int level) const {
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
    if (is("smooth_triangles") && level == 0) {
      const auto of = [&](std::int32_t f) { return topology.faces()[f].size() == 3 ? 0.47 : 0.25; };
      w = (of(edge.left_face) + of(edge.right_face)) / 2;
    }
    if (is("edge_points_without_ends")) w = 0.5;
    if (is("midpoints")) w = 0;
    p = ends * ((1 - 2 * w) / 2) + faces * w;
  }
  for (std::size_t v = 0; v < vertices; ++v)
    refined[v] = vertex_point(topology, points, refined, static_cast<std::int32_t>(v));
  return refined;
}

V QuadModelRules::limit(const reference::Topology& topology, const std::vector<V>& points,
                        std::int32_t v) const {
  const reference::Sector sector = topology.sector(v);
  const V& c = points[v];
  if (is("no_limit") || sector.faces.empty()) return c;
  if (!sector.closed) {
    const V ends = points[sector.neighbours.front()] + points[sector.neighbours.back()];
    return is("boundary_limit_3_5") ? c * (3. / 5) + ends * (1. / 5) : c * (2. / 3) + ends * (1. / 6);
  }
  V near{}, far{};
  for (const std::int32_t e : sector.neighbours) near += points[e];
  for (const std::int32_t f : sector.faces) far += points[opposite(topology.faces()[f], v)];
  const auto count = static_cast<double>(sector.faces.size());
  double n = is("limit_of_valence_4") ? 4 : count;
  if (is("limit_weights_1e-5")) n *= 1 + 1e-5;
  if (is("limit_at_valence_3") && count == 3) return (c * 3 + near * 2 + far) * (1. / 12);
  return (c * n + near * (4 / count) + far * (1 / count)) * (1 / (n + 5));
}

V QuadModelRules::normal(const reference::Topology& topology, const std::vector<V>& points,
                         std::int32_t v) const {
  const reference::Sector sector = topology.sector(v);
  const V& c = points[v];
  std::vector<V> e, f;
  for (const std::int32_t k : sector.neighbours) e.push_back(points[k]);
  for (const std::int32_t k : sector.faces) f.push_back(points[opposite(topology.faces()[k], v)]);
  if (is("mean_of_facets")) {
    V sum{};
    for (std::size_t i = 0; i < f.size(); ++i) sum += cross(e[i] - c, e[(i + 1) % e.size()] - c);
    return sum * (1 / length(sum));
  }
  if (is("tangents_without_faces") && sector.closed) f.assign(f.size(), c);
  if (is("tangents_of_valence_4") && sector.closed) {
    // f_i as the mask of valence 4 has it, in proportion.
    const double n = static_cast<double>(f.size()), t = 2 * 3.14159265358979323846 / n;
    const double cosine = std::cos(t),
                 right = (1 + cosine + std::cos(t / 2) * std::sqrt(2 * (9 + cosine))) / 4;
    for (V& p : f) p = c + (p - c) * right;
  }
  auto t = sector.closed ? reference::catmull_clark::interior_tangents<double>(c, e, f)
                         : reference::catmull_clark::boundary_tangents<double>(c, e, f);
  if (!sector.closed && (is("boundary_tangent_mean") || (is("boundary_tangent_trap") && f.size() >= 3))) {
    V sum{};
    for (const V& p : e) sum += p - c;
    for (const V& p : f) sum += p - c;
    if (is("boundary_tangent_trap")) {  // the eigenvector of another rule: without the faces
      sum = {};
      for (std::size_t i = 1; i + 1 < e.size(); ++i)
        sum += (e[i] - c) *
               std::sin(3.14159265358979323846 * static_cast<double>(i) / static_cast<double>(f.size()));
    }
    t.second = sum;
  }
  const V n = cross(t.first, t.second);
  const double size = length(n);
  return size > 0 ? n * (1 / size) : V{0, 0, 1};
}

}  // namespace limitcheck::verify
