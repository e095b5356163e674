// SPDX-License-Identifier: MIT
#include "verify/projection/quad_bound.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "reference/catmull_clark/refined_mesh.h"
#include "verify/projection/cut_mesh.h"

namespace limitcheck::verify {
namespace {

using reference::Sector;
using reference::Topology;
using reference::VertexState;
using reference::catmull_clark::RefinedMesh;
using Point = reference::Vec3<double>;

constexpr int kSteps = 14;  // 0.6546^14 = 2.7e-3 of the size of the lattice quad

double length(const Point& a) {
  return std::sqrt(dot(a, a));
}

// The corner of a quad at a vertex of it.
int corner_of(std::span<const std::int32_t> quad, std::int32_t vertex) {
  return static_cast<int>(std::find(quad.begin(), quad.end(), vertex) - quad.begin());
}

// The nine points around and at a corner of a quad: [x][y], the corner at [1][1], the quad's next corner at
// [2][1] and the one before at [1][2]. Linear ghosts complete those of a boundary vertex.
using Nine = std::array<std::array<Point, 3>, 3>;

bool gather(const Topology& topology, std::span<const Point> positions, const Quad& quad, int corner,
            std::span<const VertexState> states, Nine& nine) {
  const std::int32_t v = quad[static_cast<std::size_t>(corner)];
  if (reference::state_of(states, v) != VertexState::kOrdinary) return false;
  const Sector sector = topology.sector(v);
  if (sector.faces.size() != (sector.closed ? 4U : 2U)) return false;
  const std::int32_t next = quad[static_cast<std::size_t>(corner + 1) % 4];
  const auto neighbour = [&](std::size_t i) { return positions[sector.neighbours[i]]; };
  const auto opposite = [&](std::size_t i) {
    const auto face = topology.faces()[sector.faces[i]];
    return positions[face[static_cast<std::size_t>(corner_of(face, v) + 2) % 4]];
  };
  const Point& centre = positions[v];
  nine[1][1] = centre;
  if (sector.closed) {
    const auto at = static_cast<std::size_t>(
        std::find(sector.neighbours.begin(), sector.neighbours.end(), next) - sector.neighbours.begin());
    nine[2][1] = neighbour(at), nine[1][2] = neighbour((at + 1) % 4);
    nine[0][1] = neighbour((at + 2) % 4), nine[1][0] = neighbour((at + 3) % 4);
    nine[2][2] = opposite(at), nine[0][2] = opposite((at + 1) % 4);
    nine[0][0] = opposite((at + 2) % 4), nine[2][0] = opposite((at + 3) % 4);
    return true;
  }
  const auto ghost = [](const Point& edge, const Point& inside) { return edge * 2.0 - inside; };
  if (sector.neighbours[0] == next) {  // the boundary runs along x
    for (const int x : {0, 1, 2}) nine[x][1] = x == 1 ? centre : neighbour(x == 2 ? 0 : 2);
    for (const int x : {0, 1, 2}) nine[x][2] = x == 1 ? neighbour(1) : opposite(x == 2 ? 0 : 1);
    for (const int x : {0, 1, 2}) nine[x][0] = ghost(nine[x][1], nine[x][2]);
  } else {  // along y
    for (const int y : {0, 1, 2}) nine[1][y] = y == 1 ? centre : neighbour(y == 0 ? 0 : 2);
    for (const int y : {0, 1, 2}) nine[2][y] = y == 1 ? neighbour(1) : opposite(y == 0 ? 0 : 1);
    for (const int y : {0, 1, 2}) nine[0][y] = ghost(nine[1][y], nine[2][y]);
  }
  return true;
}

}  // namespace

std::optional<double> regular_bound(const Topology& topology, std::span<const Point> positions,
                                    const Quad& quad, std::span<const VertexState> states) {
  std::array<std::array<Point, 4>, 4> p;  // [i][j], i along u, the quad's corners at 1 and 2
  constexpr std::array<std::array<int, 2>, 4> kCorner{{{1, 1}, {2, 1}, {2, 2}, {1, 2}}};
  for (int k = 0; k < 4; ++k) {
    Nine nine;
    if (!gather(topology, positions, quad, k, states, nine)) return std::nullopt;
    const auto [i, j] = kCorner[k];
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y) {
        // The axes of corner k are those of the quad turned by k quarter turns.
        const int du = k == 0 ? x : k == 1 ? -y : k == 2 ? -x : y;
        const int dv = k == 0 ? y : k == 1 ? x : k == 2 ? -y : -x;
        p[i + du][j + dv] = nine[x + 1][y + 1];
      }
  }
  double along_u = 0, along_v = 0, mixed = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      if (i == 1 || i == 2)
        along_u = std::max(along_u, length((p[i - 1][j] - p[i][j]) + (p[i + 1][j] - p[i][j])));
      if (j == 1 || j == 2)
        along_v = std::max(along_v, length((p[i][j - 1] - p[i][j]) + (p[i][j + 1] - p[i][j])));
      if (i < 3 && j < 3)
        mixed = std::max(mixed, length((p[i + 1][j + 1] - p[i + 1][j]) - (p[i][j + 1] - p[i][j])));
    }
  return (along_u + 2 * mixed + along_v) / 8;
}

namespace {

// A vertex (number 0) with the faces around it and around all vertices of these.
Surroundings surroundings(const Topology& topology, std::span<const Point> positions, std::int32_t vertex,
                          const SharpVertexOf& sharp = {}) {
  std::vector<std::int32_t> faces;
  for (const std::int32_t near : topology.sector(vertex).faces)
    for (const std::int32_t v : topology.faces()[near])
      if (v != vertex)
        for (const std::int32_t f : topology.sector(v).faces) faces.push_back(f);
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return surroundings_of(topology, positions, vertex, faces, sharp);
}

RefinedMesh<double> mesh_of(const Surroundings& s) {
  return {s.faces, s.positions, s.tags};
}

}  // namespace

CornerBounds quad_corner_bounds(const Topology& topology, std::span<const Point> positions,
                                std::int32_t vertex, const SharpVertexOf& sharp) {
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
      const auto quad = std::as_const(now.faces)[f];
      const int at = corner_of(quad, 0);
      if (at == 4) continue;
      // The middles of the sides and of the diagonal, on the surface against those of the flat triangles.
      const auto apart = [&](int i, int j, std::int32_t a, std::int32_t b) {
        const Point flat = (limits[a] + limits[b]) * .5;
        shift[step] = std::max(shift[step], length(fine_limits[fine.vertex(f, 0, i, j)] - flat));
      };
      apart(1, 0, quad[0], quad[1]);
      apart(2, 1, quad[1], quad[2]);
      apart(1, 2, quad[2], quad[3]);
      apart(0, 1, quad[3], quad[0]);
      apart(1, 1, 0, quad[static_cast<std::size_t>(at + 2) % 4]);
      for (std::size_t child = 4 * f; child < 4 * f + 4; ++child) {
        if (corner_of(fine.topology().faces()[child], 0) < 4) continue;
        const Topology& its = cut ? cut->topology : fine.topology();
        const auto corners = its.faces()[child];
        const Quad piece{corners[0], corners[1], corners[2], corners[3]};
        const auto bound = cut ? regular_bound(its, cut->positions, piece, cut->states)
                               : regular_bound(its, fine.positions(), piece);
        bounds.outer[step] = std::max(bounds.outer[step], bound.value_or(1e300));
      }
    }
    // The control points of the pieces at the vertex are among those of its faces and of the faces around.
    now = surroundings(fine.topology(), fine.positions(), 0, {sharpness ? &*sharpness : nullptr, sharp.held});
    limits = surroundings(fine.topology(), fine_limits, 0).positions;
    if (step < kSteps) continue;
    double hull = 0, flat = 0;
    for (const Point& p : now.positions) hull = std::max(hull, length(p - limits[0]));
    for (const std::int32_t f : fine.topology().sector(0).faces)
      for (const std::int32_t v : fine.topology().faces()[f])
        flat = std::max(flat, length(fine_limits[v] - limits[0]));
    last = hull + flat;
  }
  bounds.corner.assign(kSteps + 1, last);
  for (int step = kSteps - 1; step >= 0; --step)
    bounds.corner[step] = shift[step + 1] + std::max(bounds.outer[step + 1], bounds.corner[step + 1]);
  return bounds;
}

}  // namespace limitcheck::verify
