// SPDX-License-Identifier: MIT
#include "verify/files/schemes.h"

#include <algorithm>
#include <map>

#include "reference/masks.h"
#include "reference/topology.h"
#include "verify/projection/triangle.h"

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
    next.push_back(linear || e.on_boundary() ? .5 * ends
                                             : .375 * ends + .125 * (points[e.left] + points[e.right]));
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

// One step of Catmull and Clark (1978).
void catmull_clark(std::vector<Vector>& points, Polygons& polygons) {
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
  for (std::size_t f = 0; f < polygons.size(); ++f) {
    const auto& p = polygons[f];
    const std::size_t n = p.size();
    const auto edge_at = [&](std::size_t k) {
      const std::int32_t a = p[k % n], b = p[(k + 1) % n];
      return first_edge + edges.number.at({std::min(a, b), std::max(a, b)});
    };
    for (std::size_t k = 0; k < n; ++k)
      quads.push_back({p[k], edge_at(k), first_face + static_cast<std::int32_t>(f), edge_at(k + n - 1)});
  }
  points = std::move(next);
  points.insert(points.end(), edge.begin(), edge.end());
  points.insert(points.end(), face.begin(), face.end());
  polygons = std::move(quads);
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
  std::vector<Vector> points = mesh.positions;
  if (scheme == Scheme::kCatmullClark) {
    Polygons polygons;
    for (const auto& t : mesh.triangles) polygons.push_back({t[0], t[1], t[2]});
    for (int step = 0; step < steps; ++step) catmull_clark(points, polygons);
    return limit && steps > 0 ? catmull_clark_limits(points, polygons) : points;
  }
  Triangles triangles = mesh.triangles;
  for (int step = 0; step < steps; ++step) refine(points, triangles, scheme);
  return limit && scheme != Scheme::kLinear ? limits(points, triangles, scheme) : points;
}

std::string name_of(Scheme scheme) {
  switch (scheme) {
    case Scheme::kLoop:
      return "Loop's rule";
    case Scheme::kWarren:
      return "Loop's rule with Warren's simplified weights";
    case Scheme::kLinear:
      return "linear interpolation";
    case Scheme::kCatmullClark:
      return "Catmull and Clark's rule";
  }
  return "";
}

}  // namespace limitcheck::verify
