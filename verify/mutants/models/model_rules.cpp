// SPDX-License-Identifier: MIT
#include "verify/mutants/models/model_rules.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "reference/loop/masks.h"
#include "reference/mesh/topology.h"
#include "reference/point/normal.h"

namespace limitcheck::verify {
namespace {

using reference::Edge;
using reference::Topology;
using V = ModelRules::V;

double turn(double fraction) {
  return 2 * std::numbers::pi * fraction;
}

std::vector<V> ring_of(const Topology& topology, const std::vector<V>& points, std::int32_t v,
                       std::size_t first = 0) {
  std::vector<V> ring;
  for (const std::int32_t r : topology.ring(v)) ring.push_back(points[r]);
  if (!topology.on_boundary(v))
    std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(first % ring.size()), ring.end());
  return ring;
}

V in_float(const V& p) {
  return {static_cast<double>(static_cast<float>(p.x)), static_cast<double>(static_cast<float>(p.y)),
          static_cast<double>(static_cast<float>(p.z))};
}

double length(const V& p) {
  return std::sqrt(dot(p, p));
}

}  // namespace

double ModelRules::alpha(int n) const {
  const double s = 3 + 2 * std::cos(turn((is("half_angle") ? .5 : 1.) / n));
  if (is("warren_weights") && n > 3) return 3. / 8;
  if (is("square_forgotten")) return 5. / 8 - s / 64;
  if (is("half_angle")) return 5. / 8 - s * s / 64;
  if (is("valence_one_less") && n > 3) return reference::loop_a<double>(n - 1);
  if (is("vertices_stay")) return 0;
  if (is("weights_of_16")) n = std::min(n, 16);
  if (is("weights_of_32")) n = std::min(n, 32);
  if (is("weights_below_64") && n == 64) return 0;
  if (is("weight_at_infinity") && n >= 20) return 15. / 64;
  if (is("valence_in_8_bits") && n % 256 == 0) return 0;
  const auto weights = is("warren_declared") ? reference::Weights::kLoop : weights_;
  return reference::ring_weight<double>(n, weights) + (n == 5 && is("weight_1e-6_at_valence_5") ? 1e-6 : 0);
}

V ModelRules::vertex_point(const Topology& topology, const std::vector<V>& points, std::int32_t v) const {
  const V& p = points[v];
  const std::vector<V> ring = ring_of(topology, points, v);
  if (topology.on_boundary(v)) {
    const double end = is("boundary_vertex_5_8") ? 3. / 16 : 1. / 8;
    return p + ((ring.front() - p) + (ring.back() - p)) * end;
  }
  V sum{};
  for (const V& r : ring) sum += r - p;
  if (is("ring_off_by_one")) sum += ring.front() - ring.back();
  if (is("valence_3_pairs") && ring.size() == 3)
    for (const std::int32_t r : topology.ring(v))
      if (!topology.on_boundary(r) && topology.ring(r).size() == 3) sum += points[r] - p;
  const auto n = static_cast<int>(ring.size());
  return p + sum * (alpha(n) / n);
}

V ModelRules::edge_point(const Topology& topology, const std::vector<V>& points, const Edge& e) const {
  const auto at = [&](std::int32_t v) { return points[v]; };
  const V a = at(e.a), b = at(e.b);
  const std::int32_t left = opposite(topology, e, e.left_face);
  if (e.on_boundary()) {
    if (is("boundary_edge_flap")) return (a + b) * (3. / 8) + at(left) * .25;
    return (a + b) * .5;
  }
  const std::int32_t right = opposite(topology, e, e.right_face);
  V c = at(left), d = at(right);
  if (is("midpoints")) return (a + b) * .5;
  if (is("one_flap")) return (a + b) * (3. / 8) + c * .25;
  if (is("indices_modulo_n")) {
    const std::int32_t last = topology.ring(e.a).back();  // v_n, seen from v_0 = a
    if (last == left) c = a;
    if (last == right) d = a;
  }
  V p = reference::interior_edge_point(a, b, c, d);
  if (is("edge_weight_1e-6")) p += (a - b) * 1e-6;
  if (is("lower_end")) p += (e.a < e.b ? a - b : b - a) * 1e-9;
  if (is("left_flap")) p += (c - d) * 1e-9;
  if (is("biermann_edges") && topology.on_boundary(e.a) != topology.on_boundary(e.b)) {
    const bool first = topology.on_boundary(e.a);
    const auto faces = static_cast<double>(topology.ring(first ? e.a : e.b).size()) - 1;
    const double g = .5 - std::cos(turn(.5 / faces)) / 4;
    if (faces != 3) p = (first ? a : b) * (.75 - g) + (first ? b : a) * g + (c + d) * (1. / 8);
  }
  return p;
}

std::vector<V> ModelRules::refine(const Topology& topology, const std::vector<V>& points, int depth) const {
  std::vector<V> out;
  out.reserve(points.size() + topology.edges().size());
  for (std::size_t v = 0; v < points.size(); ++v)
    out.push_back(vertex_point(topology, points, static_cast<std::int32_t>(v)));
  for (const Edge& e : topology.edges())
    out.push_back(depth == 1 && is("midpoints_at_depth_1") ? (points[e.a] + points[e.b]) * .5
                                                           : edge_point(topology, points, e));
  return out;
}

V ModelRules::limit(const Topology& topology, const std::vector<V>& points, std::int32_t v, int depth,
                    std::size_t first) const {
  const V& p = points[v];
  if (refined_ || is("no_limit") || (is("no_limit_at_depth_0") && depth == 0) ||
      (is("no_limit_from_depth_5") && depth >= 5) ||
      (is("valence_in_8_bits") && topology.ring(v).size() == 256))
    return p;
  const std::vector<V> ring = ring_of(topology, points, v, first);
  if (topology.on_boundary(v)) {
    if (is("boundary_limit_hoppe")) return p * .6 + (ring.front() + ring.back()) * .2;
    if (is("corners_stay") && ring.size() == 2) return p;
    return reference::boundary_limit<double>(p, ring.front(), ring.back());
  }
  if (is("limits_in_float")) {
    V sum{};
    for (const V& r : ring) sum = in_float(sum + in_float(r - p));
    const double a8 = 8 * reference::loop_a<double>(static_cast<int>(ring.size()));
    return p + sum * (a8 / (static_cast<double>(ring.size()) * (3 + a8)));
  }
  const auto n = static_cast<double>(ring.size());
  double weight = 3 * n / (8 * reference::loop_a<double>(static_cast<int>(n)));
  if (is("limit_mask_of_six")) {
    weight = n;
  } else if (is("limit_weight_misread")) {
    weight = 3 * n / 8 * reference::loop_a<double>(static_cast<int>(n));
  } else if (is("limit_weight_at_valence_3") && ring.size() == 3) {
    weight *= 1.1;
  } else if (is("limit_weights_1e-4")) {
    weight *= 1.0001;
  } else {
    return reference::interior_limit<double>(
        p, ring, is("warren_declared") || is("warren_limit_of_loop") ? reference::Weights::kLoop : weights_);
  }
  V sum = p * weight;
  for (const V& r : ring) sum += r;
  return sum * (1 / (weight + n));
}

bool ModelRules::taken_as_vanishing(const reference::Tangents<double>& t, const V& p) const {
  const double a = length(t.first), b = length(t.second), sine = length(cross(t.first, t.second));
  const auto square = static_cast<float>(a) * static_cast<float>(a);
  return (is("fixed_epsilon") && sine < 1e-15) || (is("epsilon_of_coordinates") && a < 1e-4 * length(p)) ||
         (is("thin_is_none") && sine < 1e-3 * a * b) || (is("squares_underflow") && square == 0) ||
         (is("squares_overflow") && !std::isfinite(square));
}

V ModelRules::normal(const Topology& topology, const std::vector<V>& points, std::int32_t v,
                     std::size_t first) const {
  return normal(points[v], ring_of(topology, points, v, first), topology.on_boundary(v));
}

V ModelRules::normal(const V& p, const std::vector<V>& ring, bool open) const {
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
  if (is("zero_where_tangents_vanish") && length(cross(t.first, t.second)) == 0) return {};
  if (taken_as_vanishing(t, p)) return {0, 0, 1};
  V result = reference::unit_normal<double>(t, facets).direction;
  if (open && n > 4 && is("boundary_normals_inside")) result *= -1;
  if (is("quick_root")) {  // 1 / sqrt(x) by the bits of x, with one step of Newton's
    const V c = cross(t.first, t.second);
    const auto x = static_cast<float>(dot(c, c));
    const auto y = std::bit_cast<float>(0x5f3759dfU - (std::bit_cast<std::uint32_t>(x) >> 1));
    if (x > 0) result = c * static_cast<double>(y * (1.5F - .5F * x * y * y));
  }
  if (is("two_components")) {  // z by the other two, in float
    result = in_float(result);
    result.z =
        std::copysign(std::sqrt(std::max(0., 1 - result.x * result.x - result.y * result.y)), result.z);
  }
  if (is("tilted_normals")) {
    const V aside = cross(result, std::abs(result.x) < .5 ? V{1, 0, 0} : V{0, 1, 0});
    result = reference::unit(result + aside * (1e-3 / std::sqrt(dot(aside, aside))));
  }
  return result;
}

}  // namespace limitcheck::verify
