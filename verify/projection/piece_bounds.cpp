// SPDX-License-Identifier: MIT
#include "verify/projection/piece_bounds.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>
#include <utility>

#include "reference/catmull_clark/recursion.h"
#include "reference/catmull_clark/ringed_quad.h"
#include "reference/loop/ringed_face.h"
#include "reference/mesh/cut_mesh.h"
#include "reference/mesh/topology.h"
#include "verify/projection/refine_tagged.h"

namespace limitcheck::verify {
namespace {

using reference::Topology, reference::VertexState;
using Point = reference::Vec3<double>;
using Points = std::span<const Point>;

// At worst (5/8)^14 = 1.4e-3 of the size of a triangle of the lattice, 0.6546^14 = 2.7e-3 of that of a quad.
constexpr int kSteps = 14;

double length(const Point& a) {
  return std::sqrt(dot(a, a));
}

// Of a face whose corners have all of their rings.
bool has_polynomial(const auto& ringed) {
  return ringed.is_regular() && std::ranges::none_of(ringed.corner, [](const auto& corner) {
           return corner.state == VertexState::kHeld;
         });
}

std::optional<double> bound_of_triangle(const Topology& topology, Points positions, std::size_t face,
                                        std::span<const VertexState> states) {
  const auto point = [&](std::int32_t v) { return positions[v]; };
  const auto ringed = reference::gather_triangle<Point>(topology, face, point, states);
  if (!has_polynomial(ringed)) return std::nullopt;
  const auto p = ringed.patch([](const Point& v, const Point& a, const Point& b) { return v + a - b; });
  // Three points of the patch in a row: four times along each of the edges.
  constexpr std::array<std::array<int, 3>, 12> kRows{{{0, 2, 5},
                                                      {1, 3, 6},
                                                      {3, 6, 9},
                                                      {4, 7, 10},
                                                      {0, 3, 7},
                                                      {2, 6, 10},
                                                      {3, 7, 11},
                                                      {1, 4, 8},
                                                      {2, 3, 4},
                                                      {5, 6, 7},
                                                      {6, 7, 8},
                                                      {9, 10, 11}}};
  double largest = 0;
  for (const auto& [before, centre, after] : kRows)
    largest = std::max(largest, length((p[before] - p[centre]) + (p[after] - p[centre])));
  return largest / 6;
}

std::optional<double> bound_of_quad(const Topology& topology, Points positions, std::size_t face,
                                    std::size_t first, std::span<const VertexState> states) {
  const auto point = [&](std::int32_t v) { return positions[v]; };
  reference::catmull_clark::RingedQuad<Point> ringed;
  for (std::size_t k = 0; k < 4; ++k)
    ringed.corner[k] =
        reference::catmull_clark::gather_corner<Point>(topology, face, (first + k) % 4, point, states);
  if (!has_polynomial(ringed)) return std::nullopt;
  const auto patch = ringed.patch([](const Point& edge, const Point& inside) { return edge * 2.0 - inside; });
  const auto p = [&](int i, int j) { return patch[4 * j + i]; };  // i along u, the quad's corners at 1 and 2
  double along_u = 0, along_v = 0, mixed = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      if (i == 1 || i == 2)
        along_u = std::max(along_u, length((p(i - 1, j) - p(i, j)) + (p(i + 1, j) - p(i, j))));
      if (j == 1 || j == 2)
        along_v = std::max(along_v, length((p(i, j - 1) - p(i, j)) + (p(i, j + 1) - p(i, j))));
      if (i < 3 && j < 3)
        mixed = std::max(mixed, length((p(i + 1, j + 1) - p(i + 1, j)) - (p(i, j + 1) - p(i, j))));
    }
  return (along_u + 2 * mixed + along_v) / 8;
}

// A vertex (number 0) with the faces around it and around all vertices of these, refined again and
// again on the spot; the others are numbered as they appear.
struct Surroundings {
  std::vector<Point> positions;
  data::Faces faces;
  reference::SharpTags tags;
};

// The edges of a face that stay sharp, as tags of a mesh in which it has the corners `named`.
void add_lasting_edges(reference::SharpTags& tags, const reference::Topology& topology,
                       const reference::Sharpness& sharpness, std::int32_t face,
                       std::span<const std::int32_t> named) {
  for (std::size_t k = 0; k < named.size(); ++k) {
    const std::int32_t e = topology.edge(static_cast<std::size_t>(face), k);
    if (topology.edges()[static_cast<std::size_t>(e)].on_boundary() ||
        !reference::Sharpness::is_infinite(sharpness.edge(e)))
      continue;
    tags.edges.push_back({named[k], named[(k + 1) % named.size()], 10.0});
  }
}

Surroundings surroundings(const Topology& topology, Points positions, std::int32_t vertex,
                          const SharpVertexOf& sharp = {}) {
  std::set<std::int32_t> faces;
  for (const std::int32_t near : topology.sector(vertex).faces)
    for (const std::int32_t v : topology.faces()[near])
      if (v != vertex)
        for (const std::int32_t f : topology.sector(v).faces) faces.insert(f);

  Surroundings s{{positions[vertex]}, {}, {}};
  std::unordered_map<std::int32_t, std::int32_t> number{{vertex, 0}};
  std::vector<std::int32_t> corners;
  for (const std::int32_t f : faces) {
    const auto face = topology.faces()[f];
    corners.assign(face.begin(), face.end());
    for (std::int32_t& v : corners) {
      const auto [at, is_new] = number.try_emplace(v, static_cast<std::int32_t>(s.positions.size()));
      if (is_new) s.positions.push_back(positions[v]);
      v = at->second;
    }
    s.faces.push_back(corners);
    if (sharp.sharpness != nullptr) add_lasting_edges(s.tags, topology, *sharp.sharpness, f, corners);
  }
  if (sharp.held) s.tags.vertices.push_back({0, 10.0});
  return s;
}

// What the steps around a vertex need to know of a scheme: the mesh, and the middles of the sides of the flat triangles
// that a face at the vertex is cut into, with the ends of these sides.
struct LoopPieces {
  using Mesh = reference::RefinedMesh<double>;
  static Mesh mesh_of(const Surroundings& s) {
    return {s.positions, data::Triangles(s.faces).to_vector(), reference::Weights::kLoop, s.tags};
  }
  template <class What>
  static void for_each_middle(const Mesh& fine, std::size_t f, std::span<const std::int32_t> t, What&& what) {
    what(fine.vertex(f, 1, 0), t[0], t[1]);
    what(fine.vertex(f, 1, 1), t[1], t[2]);
    what(fine.vertex(f, 0, 1), t[2], t[0]);
  }
};

struct QuadPieces {
  using Mesh = reference::catmull_clark::RefinedMesh<double>;
  static Mesh mesh_of(const Surroundings& s) { return {s.faces, s.positions, s.tags}; }
  template <class What>
  static void for_each_middle(const Mesh& fine, std::size_t f, std::span<const std::int32_t> quad,
                              What&& what) {
    what(fine.vertex(f, 0, 1, 0), quad[0], quad[1]);
    what(fine.vertex(f, 0, 2, 1), quad[1], quad[2]);
    what(fine.vertex(f, 0, 1, 2), quad[2], quad[3]);
    what(fine.vertex(f, 0, 0, 1), quad[3], quad[0]);
    what(fine.vertex(f, 0, 1, 1), 0,
         quad[static_cast<std::size_t>(std::ranges::find(quad, 0) - quad.begin() + 2) % 4]);
  }
};

template <class Pieces>
CornerBounds bounds_around(const Topology& topology, Points positions, std::int32_t vertex,
                           const SharpVertexOf& sharp) {
  const auto has_vertex = [](std::span<const std::int32_t> face) {
    return std::find(face.begin(), face.end(), 0) != face.end();
  };
  Surroundings now = surroundings(topology, positions, vertex, sharp);
  std::vector<Point> limits = Pieces::mesh_of(now).limits().positions;
  CornerBounds bounds;
  bounds.outer.assign(kSteps + 1, 0);
  std::vector<double> shift(kSteps + 1, 0);  // between a flat triangle and the next four, at their corners
  double last = 0;
  for (int step = 1; step <= kSteps; ++step) {
    auto fine = Pieces::mesh_of(now);
    const auto sharpness = refine_tagged(fine, now.tags, 1);
    std::optional<reference::CutMesh<double>> cut;
    if (sharpness) cut.emplace(reference::TaggedMesh<double>{fine.topology(), fine.positions(), *sharpness});
    const std::vector<Point> fine_limits = fine.limits().positions;
    for (std::size_t f = 0; f < now.faces.size(); ++f) {
      const auto face = std::as_const(now.faces)[f];
      if (!has_vertex(face)) continue;
      // The middle of a side on the surface against that of the flat triangle.
      Pieces::for_each_middle(fine, f, face, [&](std::int32_t middle, std::int32_t a, std::int32_t b) {
        const Point flat = (limits[a] + limits[b]) * .5;
        shift[step] = std::max(shift[step], length(fine_limits[middle] - flat));
      });
      for (std::size_t child = 4 * f; child < 4 * f + 4; ++child) {
        if (has_vertex(fine.topology().faces()[child])) continue;
        const auto bound = cut ? regular_bound(cut->topology, cut->positions, child, 0, cut->states)
                               : regular_bound(fine.topology(), fine.positions(), child);
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

}  // namespace

std::optional<double> regular_bound(const Topology& topology, Points positions, std::size_t face,
                                    std::size_t first, std::span<const VertexState> states) {
  return topology.faces()[face].size() == 3 ? bound_of_triangle(topology, positions, face, states)
                                            : bound_of_quad(topology, positions, face, first, states);
}

CornerBounds corner_bounds(data::Scheme scheme, const Topology& topology, Points positions,
                           std::int32_t vertex, const SharpVertexOf& sharp) {
  return scheme == data::Scheme::kLoop ? bounds_around<LoopPieces>(topology, positions, vertex, sharp)
                                       : bounds_around<QuadPieces>(topology, positions, vertex, sharp);
}

}  // namespace limitcheck::verify
