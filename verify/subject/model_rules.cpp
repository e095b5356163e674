// SPDX-License-Identifier: MIT
#include "verify/subject/model_rules.h"

#include <cmath>
#include <numbers>

#include "reference/masks.h"
#include "reference/normal.h"

namespace limitcheck::verify {
namespace {

using reference::Edge;
using reference::Topology;
using V = ModelRules::V;

double turn(double fraction) {
  return 2 * std::numbers::pi * fraction;
}

std::vector<V> ring_of(const Topology& topology, const std::vector<V>& points, std::int32_t v) {
  std::vector<V> ring;
  for (const std::int32_t r : topology.ring(v)) ring.push_back(points[static_cast<std::size_t>(r)]);
  return ring;
}

}  // namespace

std::span<const Mutation> mutations() {
  static const std::vector<Mutation> list{
      {"none", "nothing: right in every check", ""},
      // Subdivision.
      {"warren_weights", "a(n) = 3/8 for n > 3, as Warren has it", "positions"},
      {"warren_declared", "declares Warren's weights and has Loop's", "positions"},
      {"warren_limit_of_loop", "Warren's weights, declared, but the limit mask of Loop's", "positions"},
      {"weight_1e-6_at_valence_5", "a(5) is 1e-6 too large, and nothing else", "positions"},
      {"square_forgotten", "a(n) = 5/8 - (3 + 2 cos)/64", "positions"},
      {"half_angle", "a(n) with cos(pi/n)", "positions"},
      {"valence_one_less", "a(n - 1) at valence n > 3", "positions"},
      {"vertices_stay", "control vertices are not moved by a step", "positions"},
      {"ring_off_by_one", "the last neighbour is left out, the first counted twice", "positions"},
      {"midpoints", "edge points half and half", "positions"},
      {"edge_weight_1e-6", "edge weights 3/8 + 1e-6 and 3/8 - 1e-6", "positions"},
      {"one_flap", "edge points 3/8, 3/8, 1/4, 0", "positions"},
      {"indices_modulo_n", "indices taken modulo n: v_n is the centre", "positions", "C13"},
      {"one_step_missing", "one step less than asked for at the vertices", "positions"},
      // Boundary.
      {"boundary_edge_flap", "boundary edge points 3/8, 3/8, 1/4", "positions"},
      {"boundary_vertex_5_8", "boundary vertices 3/16, 5/8, 3/16", "positions"},
      {"boundary_limit_hoppe", "boundary limit (3 v + ends) / 5", "positions"},
      {"biermann_edges", "Biermann's rule on edges at irregular boundary vertices", "positions"},
      {"boundary_tangent_trap", "the tangent mask of another boundary rule from four faces on", "normals"},
      {"boundary_tangent_mean", "across the boundary: towards the mean of the neighbours", "normals"},
      // Limit.
      {"no_limit", "points of the refined mesh instead of the limit", "positions"},
      {"limit_mask_of_six", "the limit mask of valence 6 at all valences", "positions"},
      {"limit_weight_misread", "limit weight (3n/8) a(n) instead of 3n/(8 a(n))", "positions", "C14"},
      {"divided_tangents", "tangents divided by the sums of their weights, as printed", "normals", "C16"},
      {"affine_tangents", "tangents taken as affine combinations: points, not directions", "normals", "C15"},
      {"tangents_exchanged", "second tangent x first: normals point inside", "normals", "C17"},
      {"sines_of_n_plus_1", "tangent masks with n + 1 in place of n", "normals"},
      {"mean_facet_normals", "mean normals of the refined facets instead of limit normals", "normals"},
      {"first_facet_normal", "the normal of one facet at the vertex", "normals-against-positions"},
      {"tilted_normals", "normals tilted by 1e-3 rad", "normals-against-positions"},
      {"nan_where_tangents_vanish", "no substitute where the tangents vanish", "degenerate-geometry"},
      {"float_squares", "squared lengths of normals in float: overflow far from size 1", "extreme-scale"},
      // Display.
      {"printed_cone_depth", "depth 0 for all faces, which the printed inequality allows", "coverage", "C27"},
      {"one_level_short", "faces of depth 2 and more are displayed one level short", "coverage"},
      {"culled_shown", "culled faces are displayed", "coverage"},
      {"one_strip_more", "the last strip of each face is sent twice: 2^m + 1 strips", "coverage", "C50"},
      {"buffer_as_printed", "memory by the printed sum, 5 + 6 * 50 vectors short", "written", "C48"},
      {"no_repair", "faces of different depths meet without repair", "t-vertices", "C56"},
      {"fan_needs_two", "fans only where two or more neighbours are deeper", "t-vertices", "C57"},
      {"exchanged_depths", "fan borders take the neighbour's depth, fans among themselves too", "watertight",
       "C58"},
      {"fan_twice", "the last triangle of each fan is sent twice", "coverage"},
      {"printed_b1", "centre of a fan with the printed first basis function", "positions", "C69"},
      {"flat_centre", "centre of a fan: mean of the limit corners", "positions", "C62"},
      {"control_centroid", "centre of a fan: mean of the control corners", "positions"},
      {"centre_without_ghosts", "centres at the boundary from the border points only", "positions", "C63"},
      {"flat_centre_normal", "normal at the centre: that of the control face", "normals"},
      // Relations.
      {"gap_1e-9", "odd faces keep their border points 1e-9 of the box away", "continuity"},
      {"by_face_number", "points inside odd faces are 1e-9 of the box off", "face-order"},
      {"by_vertex_number", "odd control vertices are 1e-9 of the box off", "vertex-order"},
      {"by_first_corner", "points inside faces lean towards the first corner", "corner-rotation"},
      {"right_half", "points with positive x are 1e-9 of the box off", "mirror"},
      {"along_z", "z is stretched by 1e-9", "rotation"},
      {"about_origin", "everything is stretched by 1e-9 from the origin", "translation"},
      {"absolute_offset", "everything is moved by 1e-9 of the unit of length", "scaling"},
      {"every_other_time", "every other call: one ulp in one point", "determinism"},
      {"by_threads", "with more than one thread: one ulp in one point", "determinism"},
      {"refuses_boundaries", "calls a valid mesh with boundary invalid", "tessellates"},
      {"accepts_anything", "takes what is no manifold, and delivers nothing", "rejected-inputs", "C06"},
  };
  return list;
}

double ModelRules::alpha(int n) const {
  const double s = 3 + 2 * std::cos(turn((is("half_angle") ? .5 : 1.) / n));
  if (is("warren_weights") && n > 3) return 3. / 8;
  if (is("square_forgotten")) return 5. / 8 - s / 64;
  if (is("half_angle")) return 5. / 8 - s * s / 64;
  if (is("valence_one_less") && n > 3) return reference::loop_a<double>(n - 1);
  if (is("vertices_stay")) return 0;
  const auto weights = is("warren_declared") ? reference::Weights::kLoop : weights_;
  return reference::ring_weight<double>(n, weights) + (n == 5 && is("weight_1e-6_at_valence_5") ? 1e-6 : 0);
}

V ModelRules::vertex_point(const Topology& topology, const std::vector<V>& points, std::int32_t v) const {
  const V& p = points[static_cast<std::size_t>(v)];
  const std::vector<V> ring = ring_of(topology, points, v);
  if (topology.on_boundary(v)) {
    const double end = is("boundary_vertex_5_8") ? 3. / 16 : 1. / 8;
    return p + ((ring.front() - p) + (ring.back() - p)) * end;
  }
  V sum{};
  for (const V& r : ring) sum += r - p;
  if (is("ring_off_by_one")) sum += ring.front() - ring.back();
  const auto n = static_cast<int>(ring.size());
  return p + sum * (alpha(n) / n);
}

V ModelRules::edge_point(const Topology& topology, const std::vector<V>& points, const Edge& e) const {
  const auto at = [&](std::int32_t v) { return points[static_cast<std::size_t>(v)]; };
  const V a = at(e.a), b = at(e.b);
  if (e.on_boundary()) {
    if (is("boundary_edge_flap")) return (a + b) * (3. / 8) + at(e.left) * .25;
    return (a + b) * .5;
  }
  V c = at(e.left), d = at(e.right);
  if (is("midpoints")) return (a + b) * .5;
  if (is("one_flap")) return (a + b) * (3. / 8) + c * .25;
  if (is("indices_modulo_n")) {
    const std::int32_t last = topology.ring(e.a).back();  // v_n, seen from v_0 = a
    if (last == e.left) c = a;
    if (last == e.right) d = a;
  }
  V p = reference::interior_edge_point(a, b, c, d);
  if (is("edge_weight_1e-6")) p += (a - b) * 1e-6;
  if (is("biermann_edges") && topology.on_boundary(e.a) != topology.on_boundary(e.b)) {
    const bool first = topology.on_boundary(e.a);
    const auto faces = static_cast<double>(topology.ring(first ? e.a : e.b).size()) - 1;
    const double g = .5 - std::cos(turn(.5 / faces)) / 4;
    if (faces != 3) p = (first ? a : b) * (.75 - g) + (first ? b : a) * g + (c + d) * (1. / 8);
  }
  return p;
}

std::vector<V> ModelRules::refine(const Topology& topology, const std::vector<V>& points) const {
  std::vector<V> out;
  out.reserve(points.size() + topology.edges().size());
  for (std::size_t v = 0; v < points.size(); ++v)
    out.push_back(vertex_point(topology, points, static_cast<std::int32_t>(v)));
  for (const Edge& e : topology.edges()) out.push_back(edge_point(topology, points, e));
  return out;
}

V ModelRules::limit(const Topology& topology, const std::vector<V>& points, std::int32_t v) const {
  const V& p = points[static_cast<std::size_t>(v)];
  if (is("no_limit")) return p;
  const std::vector<V> ring = ring_of(topology, points, v);
  if (topology.on_boundary(v)) {
    if (is("boundary_limit_hoppe")) return p * .6 + (ring.front() + ring.back()) * .2;
    return reference::boundary_limit<double>(p, ring.front(), ring.back());
  }
  const auto n = static_cast<double>(ring.size());
  if (!is("limit_mask_of_six") && !is("limit_weight_misread"))
    return reference::interior_limit<double>(
        p, ring, is("warren_declared") || is("warren_limit_of_loop") ? reference::Weights::kLoop : weights_);
  const double weight =
      is("limit_mask_of_six") ? n : 3 * n / 8 * reference::loop_a<double>(static_cast<int>(n));
  V sum = p * weight;
  for (const V& r : ring) sum += r;
  return sum * (1 / (weight + n));
}

V ModelRules::normal(const Topology& topology, const std::vector<V>& points, std::int32_t v) const {
  const V& p = points[static_cast<std::size_t>(v)];
  const std::vector<V> ring = ring_of(topology, points, v);
  const bool open = topology.on_boundary(v);
  const std::size_t n = ring.size();
  reference::Tangents<double> t =
      open ? reference::boundary_tangents<double>(p, ring) : reference::interior_tangents<double>(p, ring);
  V facets{};
  for (std::size_t i = 0; i + (open ? 1 : 0) < n; ++i) {
    const V one = cross(ring[i] - p, ring[(i + 1) % n] - p);
    if (i == 0 && is("first_facet_normal")) return reference::unit(one);
    facets += one;
  }
  if (is("mean_facet_normals")) return reference::unit(facets);
  if (open && n > 4 && is("boundary_tangent_trap")) {
    const double theta = std::numbers::pi / static_cast<double>(n - 1);
    t.second = (ring.front() + ring.back()) * (std::sin(theta) / (2 * std::cos(theta) - 2));
    for (std::size_t i = 1; i + 1 < n; ++i) t.second += ring[i] * std::sin(static_cast<double>(i) * theta);
  }
  if (open && is("boundary_tangent_mean")) {
    t.second = {};
    for (const V& r : ring) t.second += r - p;
  }
  if (!open && (is("sines_of_n_plus_1") || is("divided_tangents"))) {
    const auto period = static_cast<double>(n + (is("sines_of_n_plus_1") ? 1 : 0));
    t = {};
    double sum1 = 0, sum2 = 0;
    for (std::size_t i = 1; i <= n; ++i) {
      const auto k = static_cast<double>(i);
      const double w1 = std::cos(turn(k / period)), w2 = std::cos(turn((k - 1) / period));
      t.first += (ring[i - 1] - p) * w2;
      t.second += (ring[i - 1] - p) * w1;
      sum1 += w2;
      sum2 += w1;
    }
    if (is("divided_tangents")) {
      t.first *= 1 / sum1;
      t.second *= 1 / sum2;
    } else {
      std::swap(t.first, t.second);
      t.second *= -1;
    }
  }
  if (is("affine_tangents")) {
    t.first += p;
    t.second += p;
  }
  if (is("tangents_exchanged")) std::swap(t.first, t.second);
  if (is("nan_where_tangents_vanish")) {
    const V cross_product = cross(t.first, t.second);
    return cross_product * (1 / std::sqrt(dot(cross_product, cross_product)));
  }
  if (is("float_squares")) {
    const V c = cross(t.first, t.second);
    const double length = std::sqrt(dot(c, c));
    if (!std::isfinite(static_cast<float>(length) * static_cast<float>(length))) return {};
  }
  V result = reference::unit_normal<double>(t, facets).direction;
  if (is("tilted_normals")) {
    const V aside = cross(result, std::abs(result.x) < .5 ? V{1, 0, 0} : V{0, 1, 0});
    result = reference::unit(result + aside * (1e-3 / std::sqrt(dot(aside, aside))));
  }
  return result;
}

}  // namespace limitcheck::verify
