// SPDX-License-Identifier: MIT
#include "verify/projection/patch_bound.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "reference/loop/triangles.h"
#include "verify/projection/cut_mesh.h"

namespace limitcheck::verify {
namespace {

using reference::RefinedMesh;
using reference::Topology;
using reference::Triangle;
using reference::VertexState;
using Point = reference::Vec3<double>;

constexpr int kSteps = 14;  // (5/8)^14 = 1.4e-3 of the size of the lattice triangle

double length(const Point& a) {
  return std::sqrt(dot(a, a));
}

// The six neighbours of a regular vertex, linear ghosts [D10] completing those of a boundary vertex.
struct Ring {
  std::array<Point, 6> point;
  std::array<std::int32_t, 6> id;  // -1: ghost

  int find(std::int32_t v) const { return static_cast<int>(std::find(id.begin(), id.end(), v) - id.begin()); }
  const Point& operator[](int k) const { return point[(k + 12) % 6]; }
};

bool ring_of(const Topology& topology, std::span<const Point> positions, std::int32_t v,
             std::span<const VertexState> states, Ring& ring) {
  if (reference::state_of(states, v) != VertexState::kOrdinary) return false;
  const auto neighbours = topology.ring(v);
  const bool boundary = topology.on_boundary(v);
  if (neighbours.size() != (boundary ? 4U : 6U)) return false;
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    ring.id[k] = neighbours[k];
    ring.point[k] = positions[neighbours[k]];
  }
  if (boundary) {
    ring.id[4] = ring.id[5] = -1;
    ring.point[4] = positions[v] + ring.point[3] - ring.point[2];
    ring.point[5] = positions[v] + ring.point[0] - ring.point[1];
  }
  return true;
}

}  // namespace

std::optional<double> regular_bound(const Topology& topology, std::span<const Point> positions,
                                    const Triangle& triangle, std::span<const VertexState> states) {
  std::array<Ring, 3> rings;
  for (int k = 0; k < 3; ++k)
    if (!ring_of(topology, positions, triangle[k], states, rings[k])) return std::nullopt;
  double largest = 0;
  const auto look = [&](const Point& before, const Point& centre, const Point& after) {
    largest = std::max(largest, length((before - centre) + (after - centre)));
  };
  for (int k = 0; k < 3;
       ++k) {  // along the edge a - b: the rows through a and b, through c, and beyond the edge
    const std::int32_t a = triangle[k], b = triangle[(k + 1) % 3], c = triangle[(k + 2) % 3];
    const Ring &ra = rings[k], &rb = rings[(k + 1) % 3], &rc = rings[(k + 2) % 3];
    const int ab = ra.find(b), ba = rb.find(a), ca = rc.find(a);
    look(ra[ab], positions[a], ra[ab + 3]);
    look(rb[ba], positions[b], rb[ba + 3]);
    look(rc[ca + 2], positions[c], rc[ca + 5]);
    look(ra[ab - 2], ra[ab - 1], rb[ba + 2]);
  }
  return largest / 6;
}

namespace {

// A vertex (number 0) with the faces around it and around its neighbours.
Surroundings surroundings(const Topology& topology, std::span<const Point> positions, std::int32_t vertex,
                          const SharpVertexOf& sharp = {}) {
  std::vector<std::int32_t> faces;
  const auto add = [&](std::int32_t v) {
    for (const std::int32_t f : topology.sector(v).faces) faces.push_back(f);
  };
  add(vertex);
  for (const std::int32_t v : topology.ring(vertex)) add(v);
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return surroundings_of(topology, positions, vertex, faces, sharp);
}

RefinedMesh<double> mesh_of(const Surroundings& s) {
  return {s.positions, data::Triangles(s.faces).to_vector(), reference::Weights::kLoop, s.tags};
}

}  // namespace

CornerBounds corner_bounds(const Topology& topology, std::span<const Point> positions, std::int32_t vertex,
                           const SharpVertexOf& sharp) {
  Surroundings now = surroundings(topology, positions, vertex, sharp);
  std::vector<Point> limits = mesh_of(now).limits().positions;
  CornerBounds bounds;
  bounds.outer.assign(kSteps + 1, 0);
  std::vector<double> shift(kSteps + 1, 0);  // between a flat triangle and the next four, at their corners
  double last = 0;
  for (int step = 1; step <= kSteps; ++step) {
    RefinedMesh<double> fine = mesh_of(now);
    const auto sharpness = refine_tagged(fine, now.tags, 1);
    std::optional<CutMesh> cut;
    if (sharpness) cut.emplace(fine.topology(), fine.positions(), *sharpness);
    const std::vector<Point> fine_limits = fine.limits().positions;
    for (std::size_t f = 0; f < now.faces.size(); ++f) {
      const auto t = std::as_const(now.faces)[f];
      const int at = t[0] == 0 ? 0 : t[1] == 0 ? 1 : t[2] == 0 ? 2 : -1;
      if (at < 0) continue;
      for (int k = 0; k < 3; ++k) {  // the edge's middle on the surface against that of the flat triangle
        const auto middle = fine.vertex(f, k == 2 ? 0 : 1, k == 0 ? 0 : 1);
        const Point flat = (limits[t[k]] + limits[t[(k + 1) % 3]]) * .5;
        shift[step] = std::max(shift[step], length(fine_limits[middle] - flat));
      }
      for (std::size_t child = 4 * f; child < 4 * f + 4; ++child) {
        const Triangle& piece = fine.triangles()[child];
        if (std::find(piece.begin(), piece.end(), 0) != piece.end()) continue;
        const auto bound = cut ? regular_bound(cut->topology, cut->positions,
                                               triangle_of(cut->topology, child), cut->states)
                               : regular_bound(fine.topology(), fine.positions(), piece);
        bounds.outer[step] = std::max(bounds.outer[step], bound.value_or(1e300));
      }
    }
    // The control points of the pieces at the vertex: those of its two-ring.
    now = surroundings(fine.topology(), fine.positions(), 0, {sharpness ? &*sharpness : nullptr, sharp.held});
    limits = surroundings(fine.topology(), fine_limits, 0).positions;
    if (step < kSteps) continue;
    double hull = 0, flat = 0;
    for (const Point& p : now.positions) hull = std::max(hull, length(p - limits[0]));
    for (const std::int32_t v : fine.topology().ring(0))
      flat = std::max(flat, length(fine_limits[v] - limits[0]));
    last = hull + flat;
  }
  bounds.corner.assign(kSteps + 1, last);
  for (int step = kSteps - 1; step >= 0; --step)
    bounds.corner[step] = shift[step + 1] + std::max(bounds.outer[step + 1], bounds.corner[step + 1]);
  return bounds;
}

}  // namespace limitcheck::verify
