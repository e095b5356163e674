// SPDX-License-Identifier: MIT
#include "verify/audit/schemes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "reference/loop/refine.h"
#include "verify/subject/face_domain.h"

namespace limitcheck::verify {
namespace {

using Polygons = std::vector<std::vector<std::int32_t>>;

Vector mean(const std::vector<Vector>& points, std::span<const std::int32_t> list) {
  Vector sum{};
  for (const std::int32_t v : list) sum = sum + points[v];
  return (1. / static_cast<double>(list.size())) * sum;
}

// Loop's rule and Warren's by the reference, linear interpolation by the lattice itself.
SchemePoints triangle_points(const data::ControlMesh& mesh, Scheme scheme, int steps, bool limit) {
  const auto weights = scheme == Scheme::kWarren ? reference::Weights::kWarren : reference::Weights::kLoop;
  const auto refined = reference::refine<double>(mesh, steps, weights);
  SchemePoints result;
  result.place.assign(refined.positions().size(), {0, 0, 0, 0});
  for (const auto& p : limit ? refined.limits().positions : refined.positions())
    result.position.push_back(vector_of(p));
  const std::uint32_t n = 1U << steps;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    FaceDomain().for_each_point(n, [&](FaceDomain::Point p) {
      const std::int32_t v = refined.vertex(f, static_cast<int>(p.i), static_cast<int>(p.j));
      result.place[v] = {static_cast<std::int32_t>(f), static_cast<std::uint32_t>(p.i),
                         static_cast<std::uint32_t>(p.j), n};
      if (scheme != Scheme::kLinear) return;
      const auto [a, b, c] = mesh.triangles[f];
      const double l1 = static_cast<double>(p.i) / n, l2 = static_cast<double>(p.j) / n;
      result.position[v] =
          (1 - l1 - l2) * mesh.positions[a] + l1 * mesh.positions[b] + l2 * mesh.positions[c];
    });
  return result;
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
  if (scheme != Scheme::kCatmullClark) return triangle_points(mesh, scheme, steps, limit);
  std::vector<Vector> points = mesh.positions;
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
