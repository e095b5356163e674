// SPDX-License-Identifier: MIT
#include "verify/audit/schemes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "reference/loop/masks.h"
#include "reference/loop/triangles.h"

namespace limitcheck::verify {
namespace {

using Triangles = std::vector<std::array<std::int32_t, 3>>;
using Polygons = std::vector<std::vector<std::int32_t>>;

double weight_a(Scheme scheme, std::size_t n) {
  if (scheme == Scheme::kLoop) return reference::loop_a<double>(static_cast<int>(n));
  return n == 3 ? 9. / 16 : 3. / 8;
}

Vector mean(const std::vector<Vector>& points, std::span<const std::int32_t> list) {
  Vector sum{};
  for (const std::int32_t v : list) sum = sum + points[v];
  return (1. / static_cast<double>(list.size())) * sum;
}

// One step of a scheme on triangles.
void refine(std::vector<Vector>& points, Triangles& triangles, Scheme scheme) {
  const reference::Topology topology(points.size(), triangles);
  const bool linear = scheme == Scheme::kLinear;
  std::vector<Vector> next = points;
  for (std::size_t k = 0; k < points.size() && !linear; ++k) {
    const auto v = static_cast<std::int32_t>(k);
    const auto ring = topology.ring(v);
    if (ring.empty()) continue;
    if (topology.on_boundary(v)) {
      next[k] = .75 * points[k] + .125 * (points[ring.front()] + points[ring.back()]);
    } else {
      const double a = weight_a(scheme, ring.size());
      next[k] = (1 - a) * points[k] + a * mean(points, ring);
    }
  }
  for (const reference::Edge& e : topology.edges()) {
    const Vector ends = points[e.a] + points[e.b];
    if (linear || e.on_boundary()) {
      next.push_back(.5 * ends);
      continue;
    }
    const auto flap = [&](std::int32_t face) { return points[opposite(topology, e, face)]; };
    next.push_back(.375 * ends + .125 * (flap(e.left_face) + flap(e.right_face)));
  }
  Triangles fine;
  const auto first = static_cast<std::int32_t>(points.size());
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const auto t = triangles[f];
    const std::array<std::int32_t, 3> m{first + topology.edge(f, 0), first + topology.edge(f, 1),
                                        first + topology.edge(f, 2)};
    fine.push_back({t[0], m[0], m[2]});
    fine.push_back({m[0], t[1], m[1]});
    fine.push_back({m[2], m[1], t[2]});
    fine.push_back(m);
  }
  points = std::move(next);
  triangles = std::move(fine);
}

std::vector<Vector> limits(const std::vector<Vector>& points, const Triangles& triangles, Scheme scheme) {
  const reference::Topology topology(points.size(), triangles);
  std::vector<Vector> result = points;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto v = static_cast<std::int32_t>(k);
    const auto ring = topology.ring(v);
    if (ring.empty()) continue;
    if (topology.on_boundary(v)) {
      result[k] = 2. / 3 * points[k] + 1. / 6 * (points[ring.front()] + points[ring.back()]);
    } else {
      const double a8 = 8 * weight_a(scheme, ring.size());
      result[k] = 1 / (3 + a8) * (3. * points[k] + a8 * mean(points, ring));
    }
  }
  return result;
}

// Each triangle of the control mesh has become 4^steps, in the order in which refine() makes them.
std::vector<lc_provenance> places(std::size_t vertices, const Triangles& triangles, int steps) {
  std::vector<lc_provenance> place(vertices, {0, 0, 0, 0});
  const std::uint32_t n = 1U << steps;
  using Corners = std::array<std::array<std::uint32_t, 2>, 3>;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    Corners c{{{0, 0}, {n, 0}, {0, n}}};
    for (int step = steps - 1; step >= 0; --step) {
      Corners m;  // middles of the edges 01, 12, 20
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t axis = 0; axis < 2; ++axis) m[k][axis] = (c[k][axis] + c[(k + 1) % 3][axis]) / 2;
      const std::array<Corners, 4> child{{{c[0], m[0], m[2]}, {m[0], c[1], m[1]}, {m[2], m[1], c[2]}, m}};
      c = child[(t >> (2 * step)) & 3U];
    }
    const auto face = static_cast<std::int32_t>(t >> (2 * steps));
    for (std::size_t k = 0; k < 3; ++k) place[triangles[t][k]] = {face, c[k][0], c[k][1], n};
  }
  return place;
}

// Who is next to whom in a mesh of polygons.
struct PolygonEdges {
  struct Edge {
    std::int32_t a, b;
    std::vector<std::int32_t> faces;
  };
  std::vector<Edge> edges;
  std::vector<std::vector<std::int32_t>> faces_at, edges_at;  // of vertices
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> number;

  PolygonEdges(std::size_t vertices, const Polygons& polygons) : faces_at(vertices), edges_at(vertices) {
    for (std::size_t f = 0; f < polygons.size(); ++f)
      for (std::size_t k = 0; k < polygons[f].size(); ++k) {
        const std::int32_t a = polygons[f][k], b = polygons[f][(k + 1) % polygons[f].size()];
        faces_at[a].push_back(static_cast<std::int32_t>(f));
        const auto [it, is_new] =
            number.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<std::int32_t>(edges.size()));
        if (is_new) {
          edges.push_back({a, b, {}});
          edges_at[a].push_back(it->second);
          edges_at[b].push_back(it->second);
        }
        edges[it->second].faces.push_back(static_cast<std::int32_t>(f));
      }
  }
  std::int32_t other(std::int32_t edge, std::int32_t v) const {
    return edges[edge].a == v ? edges[edge].b : edges[edge].a;
  }
  // The two neighbours along the boundary; empty inside.
  std::vector<std::int32_t> boundary(std::int32_t v) const {
    std::vector<std::int32_t> list;
    for (const std::int32_t e : edges_at[v])
      if (edges[e].faces.size() == 1) list.push_back(other(e, v));
    return list;
  }
};

// Where the corners of a polygon lie in its control face.
struct PolygonPlaces {
  std::int32_t face;
  std::vector<std::array<double, 2>> l;  // l1, l2
};

// One step of Catmull and Clark (1978).
void catmull_clark(std::vector<Vector>& points, Polygons& polygons, std::vector<PolygonPlaces>& places) {
  const PolygonEdges edges(points.size(), polygons);
  std::vector<Vector> face, middle, edge;
  for (const auto& p : polygons) face.push_back(mean(points, p));
  for (const auto& e : edges.edges) {
    middle.push_back(.5 * (points[e.a] + points[e.b]));
    edge.push_back(e.faces.size() == 2 ? .5 * middle.back() + .25 * (face[e.faces[0]] + face[e.faces[1]])
                                       : middle.back());
  }
  std::vector<Vector> next = points;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto v = static_cast<std::int32_t>(k);
    if (edges.faces_at[k].empty()) continue;
    const auto ends = edges.boundary(v);
    if (!ends.empty()) {
      next[k] = .75 * points[k] + .125 * (points[ends[0]] + points[ends[1]]);
      continue;
    }
    const auto n = static_cast<double>(edges.faces_at[k].size());
    next[k] = (1 / n) *
              (mean(face, edges.faces_at[k]) + 2. * mean(middle, edges.edges_at[k]) + (n - 3) * points[k]);
  }
  const auto first_edge = static_cast<std::int32_t>(points.size());
  const auto first_face = first_edge + static_cast<std::int32_t>(edge.size());
  Polygons quads;
  std::vector<PolygonPlaces> quad_places;
  for (std::size_t f = 0; f < polygons.size(); ++f) {
    const auto& p = polygons[f];
    const auto& l = places[f].l;
    const auto between = [](const std::array<double, 2>& a, const std::array<double, 2>& b) {
      return std::array<double, 2>{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
    };
    std::array<double, 2> centre{};
    for (const auto& at : l)
      for (std::size_t axis = 0; axis < 2; ++axis) centre[axis] += at[axis] / static_cast<double>(l.size());
    const std::size_t n = p.size();
    const auto edge_at = [&](std::size_t k) {
      const std::int32_t a = p[k % n], b = p[(k + 1) % n];
      return first_edge + edges.number.at({std::min(a, b), std::max(a, b)});
    };
    for (std::size_t k = 0; k < n; ++k) {
      quads.push_back({p[k], edge_at(k), first_face + static_cast<std::int32_t>(f), edge_at(k + n - 1)});
      quad_places.push_back(
          {places[f].face, {l[k], between(l[k], l[(k + 1) % n]), centre, between(l[k], l[(k + n - 1) % n])}});
    }
  }
  points = std::move(next);
  points.insert(points.end(), edge.begin(), edge.end());
  points.insert(points.end(), face.begin(), face.end());
  polygons = std::move(quads);
  places = std::move(quad_places);
}

std::vector<Vector> catmull_clark_limits(const std::vector<Vector>& points, const Polygons& quads) {
  const PolygonEdges edges(points.size(), quads);
  std::vector<Vector> result = points;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto v = static_cast<std::int32_t>(k);
    const auto ends = edges.boundary(v);
    if (!ends.empty()) {
      result[k] = 2. / 3 * points[k] + 1. / 6 * (points[ends[0]] + points[ends[1]]);
      continue;
    }
    const auto n = static_cast<double>(edges.faces_at[k].size());
    Vector sum = n * n * points[k];
    for (const std::int32_t e : edges.edges_at[k]) sum = sum + 4. * points[edges.other(e, v)];
    for (const std::int32_t f : edges.faces_at[k]) {
      const auto& q = quads[f];
      const auto at = std::find(q.begin(), q.end(), v) - q.begin();
      sum = sum + points[q[(at + 2) % 4]];
    }
    result[k] = 1 / (n * (n + 5)) * sum;
  }
  return result;
}

}  // namespace

std::vector<Vector> scheme_points(const data::ControlMesh& mesh, Scheme scheme, int steps, bool limit) {
  return placed_scheme_points(mesh, scheme, steps, limit).position;
}

SchemePoints placed_scheme_points(const data::ControlMesh& mesh, Scheme scheme, int steps, bool limit) {
  std::vector<Vector> points = mesh.positions;
  if (scheme != Scheme::kCatmullClark) {
    Triangles triangles = mesh.triangles;
    for (int step = 0; step < steps; ++step) refine(points, triangles, scheme);
    auto place = places(points.size(), triangles, steps);
    if (limit && scheme != Scheme::kLinear) points = limits(points, triangles, scheme);
    return {std::move(points), std::move(place)};
  }
  Polygons polygons;
  std::vector<PolygonPlaces> of_polygons;
  for (const auto& t : mesh.triangles) {
    polygons.push_back({t[0], t[1], t[2]});
    of_polygons.push_back({static_cast<std::int32_t>(of_polygons.size()), {{0, 0}, {1, 0}, {0, 1}}});
  }
  for (int step = 0; step < steps; ++step) catmull_clark(points, polygons, of_polygons);
  std::vector<lc_provenance> place(points.size(), {0, 0, 0, 0});
  const double n = std::ldexp(1, steps);
  for (std::size_t f = 0; f < polygons.size(); ++f)
    for (std::size_t k = 0; k < polygons[f].size(); ++k) {
      const double i = n * of_polygons[f].l[k][0], j = n * of_polygons[f].l[k][1];
      if (std::floor(i) == i && std::floor(j) == j)  // dyadic, and so exact
        place[polygons[f][k]] = {of_polygons[f].face, static_cast<std::uint32_t>(i),
                                 static_cast<std::uint32_t>(j), 1U << steps};
    }
  if (limit && steps > 0) points = catmull_clark_limits(points, polygons);
  return {std::move(points), std::move(place)};
}

std::string describe(Scheme scheme, int steps, bool limit) {
  const char* rule = "";
  switch (scheme) {
    case Scheme::kLoop:
      rule = "Loop's rule";
      break;
    case Scheme::kWarren:
      rule = "Loop's rule with Warren's simplified weights";
      break;
    case Scheme::kLinear:
      rule = "linear interpolation";
      break;
    case Scheme::kCatmullClark:
      rule = "Catmull and Clark's rule";
      break;
  }
  return fmt::format("the {} {} ({} step{})",
                     scheme == Scheme::kLinear ? "flat control mesh itself, by"
                     : limit                   ? "limit points of"
                                               : "vertices of the control mesh refined by",
                     rule, steps, steps == 1 ? "" : "s");
}

}  // namespace limitcheck::verify
