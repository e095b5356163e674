// SPDX-License-Identifier: MIT
#include "verify/mutants/quad_models/quad_model_ring.h"

#include <cmath>
#include <map>
#include <numbers>

#include "verify/mutants/models/model_dart.h"

namespace limitcheck::verify {
namespace {

using V = QuadRing::V;

double four_lambda_minus_one(double t) {
  return (1 + std::cos(t) + std::cos(t / 2) * std::sqrt(18 + 2 * std::cos(t))) / 4;
}

// Of a sector of K faces, into the surface.
V across(const QuadRing& ring) {
  const std::size_t count = ring.f.size();
  if (count == 1) return (ring.e.front() - ring.c) + (ring.e.back() - ring.c);
  const double t = std::numbers::pi / static_cast<double>(count), mu = four_lambda_minus_one(t);
  const auto sine = [t](std::size_t i) { return std::sin(static_cast<double>(i) * t); };
  const double cotangent = 1 / std::tan(t / 2);
  const double end = ((mu + 1) * std::sin(t) - (2 * mu + 1) * cotangent) / (mu * mu);
  V sum = ((ring.e.front() - ring.c) + (ring.e.back() - ring.c)) * end;
  for (std::size_t i = 1; i < count; ++i) sum += (ring.e[i] - ring.c) * (4 * sine(i));
  for (std::size_t i = 0; i < count; ++i) sum += (ring.f[i] - ring.c) * ((sine(i) + sine(i + 1)) / mu);
  return sum;
}

// The points of a dart's ring as one list: c, all e, all f.
const RingMasks& dart_masks(std::size_t n) {
  static std::map<std::size_t, RingMasks> known;
  const auto [at, is_new] = known.try_emplace(n);
  if (!is_new) return at->second;
  const auto e = [n](std::size_t i) { return 1 + i % n; };
  const auto f = [n](std::size_t i) { return 1 + n + i % n; };
  const auto step = [&](const std::vector<double>& p) {
    std::vector<double> q(p.size());
    const auto count = static_cast<double>(n);
    double near = 0, far = 0;
    for (std::size_t i = 0; i < n; ++i) near += p[e(i)], far += p[f(i)];
    q[0] = p[0] * (1 - 7 / (4 * count)) + near * (3 / (2 * count * count)) + far / (4 * count * count);
    for (std::size_t i = 0; i < n; ++i) {
      q[e(i)] =
          (6 * (p[0] + p[e(i)]) + p[e(i + 1)] + p[e(i + n - 1)] + p[f(i)] + p[f(i + n - 1)]) * (1. / 16);
      q[f(i)] = (p[0] + p[e(i)] + p[f(i)] + p[e(i + 1)]) / 4;
    }
    q[e(0)] = (p[0] + p[e(0)]) / 2;
    return q;
  };
  const auto mirror = [n](std::size_t k) {
    if (k == 0) return k;
    return k <= n ? 1 + (n - (k - 1)) % n : 1 + n + (2 * n - 1 - (k - 1 - n)) % n;
  };
  std::vector<double> even(2 * n + 1, 0.), odd(2 * n + 1, 0.);
  for (std::size_t i = 0; i < n; ++i) {
    const double t = 2 * std::numbers::pi / static_cast<double>(n), at_e = t * static_cast<double>(i);
    even[e(i)] = std::cos(at_e), odd[e(i)] = std::sin(at_e);
    even[f(i)] = std::cos(at_e + t / 2), odd[f(i)] = std::sin(at_e + t / 2);
  }
  return at->second = ring_masks(2 * n + 1, step, mirror, even, odd);
}

V weighted(const QuadRing& ring, const std::vector<double>& weights) {
  V sum{};
  for (std::size_t i = 0; i < ring.e.size(); ++i) sum += (ring.e[i] - ring.c) * weights[1 + i];
  for (std::size_t i = 0; i < ring.f.size(); ++i)
    sum += (ring.f[i] - ring.c) * weights[1 + ring.e.size() + i];
  return sum;
}

}  // namespace

QuadTangents quad_tangents(const QuadRing& ring) {
  if (!ring.closed) return {ring.e.front() - ring.e.back(), across(ring)};
  const double t = 2 * std::numbers::pi / static_cast<double>(ring.f.size()),
               share = 1 / four_lambda_minus_one(t);
  QuadTangents result{};
  for (std::size_t i = 0; i < ring.f.size(); ++i) {
    const double here = t * static_cast<double>(i), next = here + t;
    const V to_e = ring.e[i] - ring.c, to_f = ring.f[i] - ring.c;
    result.first += to_e * (4 * std::cos(here)) + to_f * ((std::cos(here) + std::cos(next)) * share);
    result.second += to_e * (4 * std::sin(here)) + to_f * ((std::sin(here) + std::sin(next)) * share);
  }
  return result;
}

V dart_limit(const QuadRing& ring) {
  return ring.c + weighted(ring, dart_masks(ring.f.size()).limit);
}

QuadTangents dart_tangents(const QuadRing& ring) {
  const RingMasks& masks = dart_masks(ring.f.size());
  return {weighted(ring, masks.first), weighted(ring, masks.second)};
}

}  // namespace limitcheck::verify
