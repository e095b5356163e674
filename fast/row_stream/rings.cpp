// SPDX-License-Identifier: MIT
#include "fast/row_stream/rings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "fast/row_stream/vertex_limit.h"

namespace limitcheck::fast::row_stream {

namespace {

struct Box {
  std::array<double, 3> low, high;
};

Box bounding_box(const data::ControlMesh& mesh) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box box{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (const auto& p : mesh.positions) {
    for (int c = 0; c < 3; ++c) {
      box.low[c] = std::min(box.low[c], p[c]);
      box.high[c] = std::max(box.high[c], p[c]);
    }
  }
  return box;
}

// The centre is one for the whole mesh, or shared points would differ; a mesh about the origin stays where it
// is, so that its coordinates are not rounded again. The unit is the power of two that makes the largest
// extent 1 to 2.
Placement<double> choose_placement(const data::ControlMesh& mesh) {
  Placement<double> placement{{0, 0, 0}, 1};
  if (mesh.positions.empty()) return placement;
  const Box box = bounding_box(mesh);
  double extent = 0;
  for (int c = 0; c < 3; ++c) extent = std::max(extent, box.high[c] - box.low[c]);
  for (int c = 0; c < 3; ++c) {
    const double middle = box.low[c] / 2 + box.high[c] / 2;
    if (std::abs(middle) > extent / 4) placement.centre[c] = static_cast<float>(middle);
  }
  if (extent > 0 && std::isfinite(extent))
    placement.unit = std::ldexp(1., std::clamp(std::ilogb(extent), -120, 120));
  return placement;
}

// Where the ring, read from there on, is lexicographically smallest.
std::size_t canonical_start(std::span<const std::int32_t> ring, const std::vector<Rings::Point>& points) {
  const std::size_t n = ring.size();
  std::size_t best = 0;
  for (std::size_t k = 1; k < n; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      const auto& a = points[static_cast<std::size_t>(ring[(k + i) % n])];
      const auto& b = points[static_cast<std::size_t>(ring[(best + i) % n])];
      if (a < b) best = k;
      if (a != b) break;
    }
  }
  return best;
}

Vec to_vec(const Rings::Point& p) {
  return {p[0], p[1], p[2]};
}

// The open ring continued by kReach entries at either end: index k of the ring is at [k + kReach].
std::vector<Vec> continued_ring(const Vec& v, const std::vector<Vec>& ring) {
  const int last = static_cast<int>(ring.size()) - 1;
  std::vector<Vec> all(ring.size() + 2 * Rings::kReach);
  const auto at = [&](int k) -> Vec& { return all[static_cast<std::size_t>(k + Rings::kReach)]; };
  for (int k = 0; k <= last; ++k) at(k) = ring[static_cast<std::size_t>(k)];
  const auto sum = [&](int k, const Vec& near, const Vec& far) {
    switch (k % 6) {
      case 0:
        return near + near;
      case 3:
        return far + far;
      case 1:
      case 5:
        return v + near;
      default:
        return v + far;
    }
  };
  for (int k = 1; k <= Rings::kReach; ++k) {
    at(-k) = sum(k, ring.front(), ring.back()) - at(k);
    at(last + k) = sum(k, ring.back(), ring.front()) - at(last - k);
  }
  return all;
}

}  // namespace

Rings::Rings(const data::ControlMesh& mesh, const Adjacency& adjacency) {
  const Placement<double> placement = choose_placement(mesh);
  for (int c = 0; c < 3; ++c) placement_.centre[c] = static_cast<float>(placement.centre[c]);
  placement_.unit = static_cast<float>(placement.unit);

  const auto vertices = static_cast<std::size_t>(adjacency.vertex_count());
  points_.resize(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    for (int c = 0; c < 3; ++c)
      points_[v][c] = static_cast<float>((mesh.positions[v][c] - placement.centre[c]) / placement.unit);
    points_[v][3] = 0;
  }

  rings_.resize(vertices);
  corners_.resize(vertices);
  slot_.resize(3 * static_cast<std::size_t>(adjacency.face_count()));
  entries_.reserve(slot_.size());
  std::vector<std::int32_t> ring, half_edges;
  std::vector<Vec> geometry;
  ValenceTables tables;
  for (std::int32_t v = 0; v < adjacency.vertex_count(); ++v) {
    const std::int32_t start = adjacency.outgoing(v);
    if (start < 0) {
      rings_[static_cast<std::size_t>(v)] = {0, 1};
      continue;
    }
    // Neighbours counter-clockwise, and the half-edges to them.
    ring.clear();
    half_edges.clear();
    std::int32_t h = start;
    do {
      half_edges.push_back(h);
      ring.push_back(adjacency.target(h));
      const std::int32_t last = Adjacency::prev(h);
      h = adjacency.rotate(h);
      if (h < 0) ring.push_back(adjacency.origin(last));
    } while (h >= 0 && h != start);
    const bool boundary = h < 0;
    if (!boundary) {
      const auto first = static_cast<std::ptrdiff_t>(canonical_start(ring, points_));
      std::rotate(ring.begin(), ring.begin() + first, ring.end());
      std::rotate(half_edges.begin(), half_edges.begin() + first, half_edges.end());
    }
    for (std::size_t k = 0; k < half_edges.size(); ++k)
      slot_[static_cast<std::size_t>(half_edges[k])] = static_cast<std::int32_t>(k);

    const Vec centre = to_vec(points_[static_cast<std::size_t>(v)]);
    geometry.clear();
    for (const std::int32_t r : ring) geometry.push_back(to_vec(points_[static_cast<std::size_t>(r)]));

    if (boundary) {
      const std::vector<Vec> all = continued_ring(centre, geometry);
      rings_[static_cast<std::size_t>(v)] = {static_cast<std::int32_t>(entries_.size()) + kReach, kOpen};
      for (std::size_t k = 0; k < all.size(); ++k) {
        if (k >= kReach && k < kReach + ring.size()) {
          entries_.push_back(ring[k - kReach]);
          continue;
        }
        entries_.push_back(static_cast<std::int32_t>(points_.size()));
        points_.push_back(
            {static_cast<float>(all[k].x), static_cast<float>(all[k].y), static_cast<float>(all[k].z), 0});
      }
    } else {
      rings_[static_cast<std::size_t>(v)] = {static_cast<std::int32_t>(entries_.size()),
                                             static_cast<std::int32_t>(ring.size())};
      entries_.insert(entries_.end(), ring.begin(), ring.end());
    }

    const VertexLimit limit =
        boundary ? boundary_limit(centre, geometry) : interior_limit(centre, geometry, tables);
    degenerate_normals_ += limit.degenerate ? 1 : 0;
    auto& head = corners_[static_cast<std::size_t>(v)].head;
    for (int k = 0; k < 2; ++k) head[static_cast<std::size_t>(k)] = static_cast<float>(limit.recursion[k]);
    const auto put = [&](int at, const Vec& x) {
      head[static_cast<std::size_t>(at)] = static_cast<float>(x.x);
      head[static_cast<std::size_t>(at + 1)] = static_cast<float>(x.y);
      head[static_cast<std::size_t>(at + 2)] = static_cast<float>(x.z);
    };
    put(CornerBlock::kCentre, centre);
    put(CornerBlock::kDifference, limit.difference);
    const Vec origin{placement.centre[0], placement.centre[1], placement.centre[2]};
    put(CornerBlock::kLimit, placement.unit * limit.position + origin);
    put(CornerBlock::kLimit + 3, limit.normal);
  }
}

}  // namespace limitcheck::fast::row_stream
