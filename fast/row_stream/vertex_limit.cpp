// SPDX-License-Identifier: MIT
#include "fast/row_stream/vertex_limit.h"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace limitcheck::fast::row_stream {

namespace {

Vec cross(const Vec& a, const Vec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

double length(const Vec& a) {
  return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
}

// Twice the area-weighted normal of the faces round v. Shifting to v first keeps a far origin out of the
// product.
Vec area_normal(const Vec& v, const std::vector<Vec>& ring, bool closed) {
  Vec sum;
  const std::size_t faces = closed ? ring.size() : ring.size() - 1;
  for (std::size_t k = 0; k < faces; ++k) sum = sum + cross(ring[k] - v, ring[(k + 1) % ring.size()] - v);
  return sum;
}

// a x b as a unit vector or, if they are parallel or zero, the area-weighted normal of the ring, or (0, 0,
// 1).
void set_normal(VertexLimit& limit, const Vec& a, const Vec& b, const Vec& v, const std::vector<Vec>& ring,
                bool closed) {
  Vec n = cross(a, b);
  double size = length(n);
  if (!(size > 1e-12 * length(a) * length(b))) {
    limit.degenerate = true;
    n = area_normal(v, ring, closed);
    size = length(n);
    double scale = 0;
    for (const Vec& r : ring) scale = std::fmax(scale, length(r - v));
    if (!(size > 1e-12 * scale * scale)) n = {0, 0, 1}, size = 1;
  }
  limit.normal = (1 / size) * n;
}

}  // namespace

const std::vector<ValenceTables::Angle>& ValenceTables::angles(int n) {
  const auto index = static_cast<std::size_t>(n);
  if (index >= tables_.size()) {
    tables_.resize(index + 1);
    weights_.resize(index + 1);
  }
  auto& table = tables_[index];
  if (table.empty()) {
    for (int k = 0; k < n; ++k) {
      const double t = 2 * std::numbers::pi * k / n;
      table.push_back({std::cos(t), std::sin(t)});
    }
    const double b = 3 + 2 * table[1 % index].cos;
    weights_[index] = 5. / 8 - b * b / 64;
  }
  return table;
}

VertexLimit interior_limit(const Vec& v, const std::vector<Vec>& ring, ValenceTables& tables) {
  const int n = static_cast<int>(ring.size());
  const auto& angles = tables.angles(n);
  const double a = tables.weight(n);

  VertexLimit limit;
  limit.recursion = {8 * a / n, 5 - 8 * a};
  Vec along, across;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec d = ring[k] - v;
    limit.difference = limit.difference + d;
    along = along + angles[k].cos * d;
    across = across + angles[k].sin * d;
  }
  const double w = 3. * n / (8 * a);
  limit.position = v + (1 / (w + n)) * limit.difference;
  set_normal(limit, along, across, v, ring, true);
  return limit;
}

VertexLimit boundary_limit(const Vec& v, const std::vector<Vec>& ring) {
  const std::size_t faces = ring.size() - 1;
  VertexLimit limit;
  limit.recursion = {1, 2};
  limit.difference = (ring.front() - v) + (ring.back() - v);
  limit.position = v + (1. / 6) * limit.difference;

  Vec across;
  if (faces == 1) {
    across = (ring[0] - v) + (ring[1] - v);
  } else {
    // Weights of the ends and inside; the centre's is minus their sum, so offsets from v do without it.
    const double theta = std::numbers::pi / static_cast<double>(faces);
    const double c = faces == 2 ? 0 : std::cos(theta), s = std::sin(theta);
    across = -c * (1 + c) / ((1 + 2 * c) * s) * ((ring.front() - v) + (ring.back() - v));
    for (std::size_t k = 1; k < faces; ++k)
      across = across + std::sin(static_cast<double>(k) * theta) * (ring[k] - v);
  }
  set_normal(limit, ring.front() - ring.back(), across, v, ring, false);
  return limit;
}

}  // namespace limitcheck::fast::row_stream
