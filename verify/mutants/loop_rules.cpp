// SPDX-License-Identifier: MIT
// Loop's rules with one of them changed.
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "reference/loop/refine.h"
#include "reference/loop/vertex_limit.h"
#include "verify/mutants/mutant_rules.h"

namespace limitcheck::verify {
namespace {

using reference::Edge, reference::Sector, reference::Topology, reference::Weights;
using V = MutantRules::V;
using Tangents = reference::Tangents<double>;

double turn(double fraction) {
  return 2 * std::numbers::pi * fraction;
}

V in_float(const V& p) {
  return {static_cast<double>(static_cast<float>(p.x)), static_cast<double>(static_cast<float>(p.y)),
          static_cast<double>(static_cast<float>(p.z))};
}

double length(const V& p) {
  return std::sqrt(dot(p, p));
}

class LoopRules : public MutantRules {
 public:
  LoopRules(std::string_view mutation, Weights weights, bool refined)
      : MutantRules(mutation),
        weights_(is("warren_declared") ? Weights::kLoop : weights),
        limit_weights_(is("warren_limit_of_loop") ? Weights::kLoop : weights_),
        refined_(refined) {}

  Points refine(const Topology& topology, const Points& points, int, int depth) const override {
    Points out = reference::refine_once<double>(topology, points, weights_);
    for (std::size_t v = 0; v < points.size(); ++v)
      out[v] = vertex_point(topology, points, static_cast<std::int32_t>(v), out[v]);
    for (std::size_t k = 0; k < topology.edges().size(); ++k) {
      V& p = out[points.size() + k];
      const Edge& e = topology.edges()[k];
      p = depth == 1 && is("midpoints_at_depth_1") ? (points[e.a] + points[e.b]) * .5
                                                   : edge_point(topology, points, e, p);
    }
    return out;
  }
  Limit limit(const MutantRing& ring, int depth) const override {
    const auto right =
        reference::vertex_limit<double>(ring.point, ring.edge_span(), ring.on_boundary, limit_weights_);
    return {position(ring, depth, right.position), normal(ring, right.tangents)};
  }

 private:
  // `right` where nothing is changed.
  V vertex_point(const Topology& topology, const Points& points, std::int32_t v, const V& right) const;
  V edge_point(const Topology& topology, const Points& points, const Edge& edge, const V& right) const;
  V position(const MutantRing& ring, int depth, const V& right) const;
  V normal(const MutantRing& ring, const Tangents& right) const;
  Tangents tangents(const MutantRing& ring, const Tangents& right) const;
  // Of all neighbours together, where it is another.
  std::optional<double> alpha(int n) const;
  bool taken_as_vanishing(const Tangents& t, const V& p) const;

  Weights weights_, limit_weights_;
  bool refined_;
};

std::optional<double> LoopRules::alpha(int n) const {
  const double s = 3 + 2 * std::cos(turn((is("half_angle") ? .5 : 1.) / n));
  if (is("warren_weights") && n > 3) return 3. / 8;
  if (is("square_forgotten")) return 5. / 8 - s / 64;
  if (is("half_angle")) return 5. / 8 - s * s / 64;
  if (is("valence_one_less") && n > 3) return reference::loop_a<double>(n - 1);
  if (is("weights_of_16") && n > 16) return reference::ring_weight<double>(16, weights_);
  if (is("weights_of_32") && n > 32) return reference::ring_weight<double>(32, weights_);
  if (is("weight_at_infinity") && n >= 20) return 15. / 64;
  if (is("vertices_stay") || (is("weights_below_64") && n == 64) || (is("valence_in_8_bits") && n % 256 == 0))
    return 0;
  if (is("weight_1e-6_at_valence_5") && n == 5) return reference::ring_weight<double>(n, weights_) + 1e-6;
  return std::nullopt;
}

V LoopRules::vertex_point(const Topology& topology, const Points& points, std::int32_t v,
                          const V& right) const {
  const Sector sector = topology.sector(v);
  const V& p = points[v];
  const auto difference = [&](std::int32_t r) { return points[r] - p; };
  if (sector.faces.empty()) return right;
  const V first = difference(sector.neighbours.front()), last = difference(sector.neighbours.back());
  if (!sector.closed) return is("boundary_vertex_5_8") ? p + (first + last) * (3. / 16) : right;
  V sum{};
  if (is("ring_off_by_one")) sum += first - last;
  if (is("valence_3_pairs") && sector.faces.size() == 3)
    for (const std::int32_t r : sector.neighbours)
      if (!topology.on_boundary(r) && topology.ring(r).size() == 3) sum += difference(r);
  const auto n = static_cast<int>(sector.faces.size());
  const double a = reference::ring_weight<double>(n, weights_);
  if (const auto other = alpha(n)) return p + (right - p) * (*other / a);
  return right + sum * (a / n);
}

V LoopRules::edge_point(const Topology& topology, const Points& points, const Edge& e, const V& right) const {
  const V &a = points[e.a], &b = points[e.b];
  const std::int32_t left = opposite(topology, e, e.left_face), other = opposite(topology, e, e.right_face);
  if (e.on_boundary()) return is("boundary_edge_flap") ? (a + b) * (3. / 8) + points[left] * .25 : right;
  if (is("midpoints")) return (a + b) * .5;
  const V &c = points[left], &d = points[other];
  if (is("one_flap")) return (a + b) * (3. / 8) + c * .25;
  if (is("indices_modulo_n")) {
    const std::int32_t last = topology.ring(e.a).back();  // v_n, seen from v_0 = a
    return reference::interior_edge_point(a, b, last == left ? a : c, last == other ? a : d);
  }
  if (is("edge_weight_1e-6")) return right + (a - b) * 1e-6;
  if (is("lower_end")) return right + (e.a < e.b ? a - b : b - a) * 1e-9;
  if (is("left_flap")) return right + (c - d) * 1e-9;
  if (is("biermann_edges") && topology.on_boundary(e.a) != topology.on_boundary(e.b)) {
    const bool first = topology.on_boundary(e.a);
    const auto faces = static_cast<double>(topology.ring(first ? e.a : e.b).size()) - 1;
    const double g = .5 - std::cos(turn(.5 / faces)) / 4;
    if (faces != 3) return (first ? a : b) * (.75 - g) + (first ? b : a) * g + (c + d) * (1. / 8);
  }
  return right;
}

V LoopRules::position(const MutantRing& ring, int depth, const V& right) const {
  const V& p = ring.point;
  const auto& e = ring.edges;
  const std::size_t count = e.size();
  if (refined_ || is("no_limit") || (is("no_limit_at_depth_0") && depth == 0) ||
      (is("no_limit_from_depth_5") && depth >= 5) || (is("valence_in_8_bits") && count == 256))
    return p;
  if (ring.on_boundary) {
    if (is("boundary_limit_hoppe")) return p * .6 + (e.front() + e.back()) * .2;
    return is("corners_stay") && count == 2 ? p : right;
  }
  const auto n = static_cast<double>(count);
  const double a = reference::loop_a<double>(static_cast<int>(count));
  if (is("limits_in_float")) {
    V sum{};
    for (const V& r : e) sum = in_float(sum + in_float(r - p));
    return p + sum * (8 * a / (n * (3 + 8 * a)));
  }
  double weight = 3 * n / (8 * a);
  if (is("limit_mask_of_six"))
    weight = n;
  else if (is("limit_weight_misread"))
    weight = 3 * n / 8 * a;
  else if (is("limit_weight_at_valence_3") && count == 3)
    weight *= 1.1;
  else if (is("limit_weights_1e-4"))
    weight *= 1.0001;
  else
    return right;
  return std::accumulate(e.begin(), e.end(), p * weight) * (1 / (weight + n));
}

bool LoopRules::taken_as_vanishing(const Tangents& t, const V& p) const {
  const double a = length(t.first), b = length(t.second), sine = length(cross(t.first, t.second));
  const auto square = static_cast<float>(a) * static_cast<float>(a);
  return (is("fixed_epsilon") && sine < 1e-15) || (is("epsilon_of_coordinates") && a < 1e-4 * length(p)) ||
         (is("thin_is_none") && sine < 1e-3 * a * b) || (is("squares_underflow") && square == 0) ||
         (is("squares_overflow") && !std::isfinite(square));
}

// Directions, the first crossed with the second outward, and what mutants make of them.
Tangents LoopRules::tangents(const MutantRing& ring, const Tangents& right) const {
  const V& p = ring.point;
  const auto& e = ring.edges;
  const std::size_t n = e.size();
  Tangents t = right;
  if (ring.on_boundary && n > 4 && is("boundary_tangent_trap")) {
    const double theta = std::numbers::pi / static_cast<double>(n - 1);
    t.second = (e.front() + e.back()) * (std::sin(theta) / (2 * std::cos(theta) - 2));
    for (std::size_t i = 1; i + 1 < n; ++i) t.second += e[i] * std::sin(static_cast<double>(i) * theta);
  }
  if (ring.on_boundary && is("boundary_tangent_mean")) {
    t.second = {};
    for (const V& r : e) t.second += r - p;
  }
  if (!ring.on_boundary && (is("sines_of_n_plus_1") || is("divided_tangents"))) {
    const auto period = static_cast<double>(n + (is("sines_of_n_plus_1") ? 1 : 0));
    t = {};
    double sum1 = 0, sum2 = 0;
    for (std::size_t i = 1; i <= n; ++i) {
      const auto k = static_cast<double>(i);
      const double w1 = std::cos(turn(k / period)), w2 = std::cos(turn((k - 1) / period));
      t.first += (e[i - 1] - p) * w2;
      t.second += (e[i - 1] - p) * w1;
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
  return t;
}

V LoopRules::normal(const MutantRing& ring, const Tangents& right) const {
  if (is("first_facet_normal"))
    return reference::unit(cross(ring.edges[0] - ring.point, ring.edges[1] - ring.point));
  if (is("mean_facet_normals")) return reference::unit(facets(ring));
  const Tangents t = tangents(ring, right);
  const V across = cross(t.first, t.second);
  if (is("nan_where_tangents_vanish")) return across * (1 / length(across));
  if (is("float_squares")) {
    const auto size = static_cast<float>(length(across));
    if (!std::isfinite(size * size)) return {};
  }
  if (is("zero_where_tangents_vanish") && length(across) == 0) return {};
  if (taken_as_vanishing(t, ring.point)) return {0, 0, 1};
  if (is("quick_root")) {  // 1 / sqrt(x) by the bits of x, with one step of Newton's
    const auto x = static_cast<float>(dot(across, across));
    const auto y = std::bit_cast<float>(0x5f3759dfU - (std::bit_cast<std::uint32_t>(x) >> 1));
    if (x > 0) return across * static_cast<double>(y * (1.5F - .5F * x * y * y));
  }
  return reference::unit_normal<double>(t, facets(ring)).direction;
}

}  // namespace

std::unique_ptr<MutantRules> loop_rules(std::string_view mutation, Weights weights, bool refined) {
  return std::make_unique<LoopRules>(mutation, weights, refined);
}

}  // namespace limitcheck::verify
