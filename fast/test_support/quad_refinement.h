// SPDX-License-Identifier: MIT
// For the tests of fast/: a whole mesh of polygons with sharp edges refined at once, by Catmull and Clark's
// rules as they are written down, through maps, in long double. It shares no code with the kernels.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "data/control_mesh.h"
#include "fast/test_support/global_refinement.h"

namespace limitcheck::fast {

struct RefinedPolygons {
  using Edge = std::pair<int, int>;                      // the smaller vertex first
  using EdgeEnds = std::pair<long double, long double>;  // sharpness of its halves at the smaller, larger
  static constexpr long double kInfinite = std::numeric_limits<long double>::infinity();

  std::vector<Point> points;
  std::vector<std::vector<int>> faces;
  std::map<Edge, long double> sharp_edges;
  std::map<int, long double> sharp_vertices;
  bool chaikin = false, smooth_triangles = false;

  static Edge edge(int a, int b) { return std::minmax(a, b); }

  static RefinedPolygons of(const data::ControlMesh& mesh) {
    RefinedPolygons out;
    for (const auto& p : mesh.positions) out.points.push_back({p[0], p[1], p[2]});
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      out.faces.emplace_back(mesh.faces[f].begin(), mesh.faces[f].end());
    const auto sharpness = [](float s) { return s >= 10 ? kInfinite : static_cast<long double>(s); };
    for (const auto& [a, b, s] : mesh.sharpness.edges)
      if (s > 0) out.sharp_edges[edge(a, b)] = sharpness(s);
    for (const auto& [v, s] : mesh.sharpness.vertices)
      if (s > 0) out.sharp_vertices[v] = sharpness(s);
    const auto at = out.faces_of_edges();
    std::set<int> boundary;
    for (const auto& [e, list] : at)
      if (list.size() == 1)
        out.sharp_edges[e] = kInfinite, boundary.insert(e.first), boundary.insert(e.second);
    if (mesh.sharpness.boundary == data::Boundary::kEdgeAndCorner)
      for (const int v : boundary)
        if (out.faces_at(v).size() == 1) out.sharp_vertices[v] = kInfinite;
    out.chaikin = mesh.sharpness.creasing == data::Creasing::kChaikin;
    out.smooth_triangles = mesh.sharpness.triangles == data::TriangleRule::kSmooth;
    return out;
  }

  std::map<Edge, std::vector<int>> faces_of_edges() const {
    std::map<Edge, std::vector<int>> at;
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (std::size_t k = 0; k < faces[f].size(); ++k)
        at[edge(faces[f][k], faces[f][(k + 1) % faces[f].size()])].push_back(static_cast<int>(f));
    return at;
  }
  std::vector<int> faces_at(int v) const {
    std::vector<int> result;
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (std::find(faces[f].begin(), faces[f].end(), v) != faces[f].end())
        result.push_back(static_cast<int>(f));
    return result;
  }

  /// New vertices: old ones, edges in the order of the map, faces; faces (V, E, F, E') corner by corner.
  RefinedPolygons step() const {
    RefinedPolygons out{.chaikin = chaikin};
    const auto at = faces_of_edges();
    std::map<Edge, int> number;
    int next = static_cast<int>(points.size());
    for (const auto& entry : at) number[entry.first] = next++;
    const int first_face = next;
    std::vector<Point> centroid;
    for (const auto& face : faces) {
      Point sum{};
      for (const int v : face) sum = sum + points[v];
      centroid.push_back(1.L / static_cast<long double>(face.size()) * sum);
    }
    std::map<int, std::vector<int>> around, neighbours;
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (const int v : faces[f]) around[v].push_back(static_cast<int>(f));
    for (const auto& entry : at) {
      neighbours[entry.first.first].push_back(entry.first.second);
      neighbours[entry.first.second].push_back(entry.first.first);
    }
    const auto sharp = [&](const Edge& e) {
      const auto found = sharp_edges.find(e);
      return found == sharp_edges.end() ? 0.L : found->second;
    };

    // One half of an edge at its end v: 1 less, with Chaikin's mean over the other semi-sharp edges at v.
    const auto child = [&](int v, const Edge& e) -> long double {
      long double s = sharp(e);
      if (s == 0 || s == kInfinite) return s;
      std::vector<long double> others;
      for (const int w : neighbours.at(v))
        if (edge(v, w) != e && sharp(edge(v, w)) > 0 && sharp(edge(v, w)) < kInfinite)
          others.push_back(sharp(edge(v, w)));
      if (chaikin && !others.empty()) {
        long double mean = 0;
        for (const long double o : others) mean += o / static_cast<long double>(others.size());
        s = .75L * s + .25L * mean;
      }
      return std::max(0.L, s - 1);
    };

    enum Rule { kSmooth, kDart, kCrease, kCorner };
    for (int v = 0; v < static_cast<int>(points.size()); ++v) {
      if (around.count(v) == 0) {
        out.points.push_back(points[v]);
        continue;
      }
      const auto n = static_cast<long double>(neighbours[v].size());
      const auto held = sharp_vertices.find(v);
      const long double own = held == sharp_vertices.end() ? 0 : held->second,
                        own_child = own == kInfinite ? own : std::max(0.L, own - 1);
      std::vector<int> now, then;
      long double vanishing = own > 0 && own_child == 0 ? own : 0, count = own > 0 && own_child == 0 ? 1 : 0;
      for (const int w : neighbours[v]) {
        const long double s = sharp(edge(v, w)), c = child(v, edge(v, w));
        if (s > 0) now.push_back(w);
        if (c > 0) then.push_back(w);
        if (s > 0 && c == 0) vanishing += s, count += 1;
      }
      const auto rule = [](long double s, const std::vector<int>& edges) {
        return s > 0 || edges.size() > 2 ? kCorner : static_cast<Rule>(edges.size());
      };
      const auto apply = [&](Rule r, const std::vector<int>& edges) -> Point {
        if (r == kCorner) return points[v];
        if (r == kCrease) return .75L * points[v] + .125L * (points[edges[0]] + points[edges[1]]);
        Point sum{};
        for (const int w : neighbours[v]) sum = sum + points[w];
        for (const int f : around[v]) sum = sum + centroid[f];
        return ((n - 2) / n) * points[v] + (1 / (n * n)) * sum;
      };
      const Rule p = rule(own, now), c = rule(own_child, then);
      Point point = apply(p, now);
      if (p >= kCrease && p != c && count > 0) {
        const long double w = std::min(1.L, vanishing / count);
        point = w * point + (1 - w) * apply(c, then);
      }
      out.points.push_back(point);
      if (own_child > 0) out.sharp_vertices[v] = own_child;
    }

    for (const auto& [e, list] : at) {
      const Edge& ends = e;
      const Point middle = .5L * (points[ends.first] + points[ends.second]);
      const long double s = sharp(ends), a = child(ends.first, ends), b = child(ends.second, ends);
      Point point = middle;
      if (s < 1 && !(a > 0 && b > 0)) {
        const int f = list[0], g = list[1];
        const auto weight = [&](int face) {
          return smooth_triangles && faces[face].size() == 3 ? .47L : .25L;
        };
        const long double w = (weight(f) + weight(g)) / 2;
        const Point smooth = (1 - 2 * w) * middle + w * (centroid[f] + centroid[g]);
        point = s * middle + (1 - s) * smooth;
      }
      out.points.push_back(point);
      if (a > 0) out.sharp_edges[edge(ends.first, number[ends])] = a;
      if (b > 0) out.sharp_edges[edge(ends.second, number[ends])] = b;
    }
    for (const Point& c : centroid) out.points.push_back(c);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const std::size_t m = faces[f].size();
      for (std::size_t k = 0; k < m; ++k)
        out.faces.push_back({faces[f][k], number[edge(faces[f][k], faces[f][(k + 1) % m])],
                             first_face + static_cast<int>(f),
                             number[edge(faces[f][(k + m - 1) % m], faces[f][k])]});
    }
    return out;
  }

  /// The limit of a vertex that no semi-sharp edge touches and that is no dart; nothing for others.
  std::optional<Point> limit(int v) const {
    int sharp = 0;
    Point ends{}, edges{}, diagonals{};
    long double n = 0;
    for (const auto& [e, s] : sharp_edges) {
      if (e.first != v && e.second != v) continue;
      if (s != kInfinite) return std::nullopt;
      ends = ends + points[e.first == v ? e.second : e.first];
      ++sharp;
    }
    if (const auto held = sharp_vertices.find(v); held != sharp_vertices.end())
      return held->second == kInfinite ? std::optional<Point>(points[v]) : std::nullopt;
    if (sharp == 1) return std::nullopt;
    if (sharp > 2) return points[v];
    if (sharp == 2) return 2.L / 3 * points[v] + 1.L / 6 * ends;
    for (const auto& face : faces) {
      for (std::size_t k = 0; k < 4; ++k) {
        if (face[k] != v) continue;
        edges = edges + points[face[(k + 1) % 4]];
        diagonals = diagonals + points[face[(k + 2) % 4]];
        n += 1;
      }
    }
    return n / (n + 5) * points[v] + 4 / (n * (n + 5)) * edges + 1 / (n * (n + 5)) * diagonals;
  }
};

/// The vertex at a place of the mesh after enough steps: level[l] is the mesh after l of them.
inline int vertex_at(const std::vector<RefinedPolygons>& level, const LatticePoint& at) {
  int m = static_cast<int>(at.denominator), i = static_cast<int>(at.i), j = static_cast<int>(at.j);
  std::size_t l = 0;
  int face = at.face;
  if (level[0].faces[face].size() != 4) {
    int first = at.corner;
    for (int f = 0; f < at.face; ++f) first += static_cast<int>(level[0].faces[f].size());
    face = first;
    l = 1;
  }
  for (; m > 1; m /= 2, ++l) {
    const int h = m / 2, k = j <= h ? (i <= h ? 0 : 1) : i > h ? 2 : 3;
    const std::array<std::pair<int, int>, 4> in{{{i, j}, {j, m - i}, {m - i, m - j}, {m - j, i}}};
    std::tie(i, j) = in[k];
    if (l > 0) {
      face = 4 * face + k;
      continue;
    }
    int first = k;
    for (int f = 0; f < face; ++f) first += static_cast<int>(level[0].faces[f].size());
    face = first;
  }
  return level[l].faces[face][j == 0 ? i : 3 - i];
}

/// A mesh of quads without sharp edges after some steps: limits with their normals.
struct RefinedQuads {
  struct Limit {
    Point position, normal;
  };

  static RefinedQuads of(const data::ControlMesh& mesh, int depth) {
    RefinedQuads out{{RefinedPolygons::of(mesh)}, {}};
    for (int d = 0; d < depth; ++d) out.level.push_back(out.level.back().step());
    out.incident.resize(out.points().size());
    const auto& faces = out.level.back().faces;
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (const int v : faces[f]) out.incident[v].push_back(static_cast<int>(f));
    return out;
  }

  const std::vector<Point>& points() const { return level.back().points; }
  /// At (i, j) / 2^depth of a control face.
  Limit limit(std::size_t face, int i, int j) const {
    return limit(vertex_at(level, {static_cast<std::int32_t>(face), static_cast<std::uint32_t>(i),
                                   static_cast<std::uint32_t>(j), 1u << (level.size() - 1)}));
  }

  std::vector<RefinedPolygons> level;
  std::vector<std::vector<int>> incident;

 private:
  Limit limit(int v) const {
    const Ring ring = ring_of(v);
    const std::size_t faces_here = ring.face.size();
    const Point c = points()[v];
    const auto n = static_cast<long double>(faces_here), pi = std::numbers::pi_v<long double>;
    const auto e = [&](std::size_t k) { return points()[ring.edge[k]]; };
    const auto f = [&](std::size_t k) { return points()[ring.face[k]]; };
    Point position{}, u{}, w{};
    if (ring.open) {
      position = (1.L / 6) * (4.L * c + e(0) + e(faces_here));
      u = e(0) - e(faces_here);
      if (faces_here == 1) {
        w = e(0) + e(1) - 2.L * c;
      } else {
        const long double t = pi / n;
        const long double lambda =
            (5 + std::cos(t) + std::cos(t / 2) * std::sqrt(2 * (9 + std::cos(t)))) / 16;
        const long double cot = 1 / std::tan(t / 2), q = 4 * lambda - 1;
        const long double end = (4 * lambda * std::sin(t) - (8 * lambda - 1) * cot) / (q * q);
        w = end * (e(0) + e(faces_here)) + (-2 * end - cot * (16 * lambda - 2) / q) * c;
        for (std::size_t k = 1; k < faces_here; ++k) w = w + 4 * std::sin(k * t) * e(k);
        for (std::size_t k = 0; k < faces_here; ++k)
          w = w + (std::sin(k * t) + std::sin((k + 1) * t)) / q * f(k);
      }
    } else {
      const long double t = 2 * pi / n;
      const long double lambda = (5 + std::cos(t) + std::cos(t / 2) * std::sqrt(2 * (9 + std::cos(t)))) / 16;
      position = n / (n + 5) * c;
      for (std::size_t k = 0; k < faces_here; ++k) {
        position = position + 4 / (n * (n + 5)) * e(k) + 1 / (n * (n + 5)) * f(k);
        u = u + 4 * std::cos(k * t) * e(k) +
            (std::cos(k * t) + std::cos((k + 1) * t)) / (4 * lambda - 1) * f(k);
        w = w + 4 * std::sin(k * t) * e(k) +
            (std::sin(k * t) + std::sin((k + 1) * t)) / (4 * lambda - 1) * f(k);
      }
    }
    const Point normal = cross_product(u, w);
    return {position, 1 / norm(normal) * normal};
  }

  struct Ring {  // counter-clockwise; open: one more edge neighbour than face neighbours
    std::vector<int> edge, face;
    bool open = false;
  };

  Ring ring_of(int v) const {
    std::map<int, std::pair<int, int>> next;  // edge neighbour -> face neighbour, edge neighbour after it
    std::set<int> second;
    for (const int f : incident[v]) {
      const auto& q = level.back().faces[f];
      for (std::size_t k = 0; k < 4; ++k) {
        if (q[k] != v) continue;
        next[q[(k + 1) % 4]] = {q[(k + 2) % 4], q[(k + 3) % 4]};
        second.insert(q[(k + 3) % 4]);
      }
    }
    Ring ring;
    int first = next.begin()->first;
    for (const auto& entry : next)
      if (second.count(entry.first) == 0) first = entry.first, ring.open = true;
    int at = first;
    do {
      ring.edge.push_back(at);
      const auto found = next.find(at);
      if (found == next.end()) break;
      ring.face.push_back(found->second.first);
      at = found->second.second;
    } while (at != first);
    return ring;
  }
};

}  // namespace limitcheck::fast
