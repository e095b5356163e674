// SPDX-License-Identifier: MIT
// For the tests of fast/: a whole mesh with sharp edges refined at once, by Loop's rules or by Catmull and Clark's as
// they are written down, through maps, in long double. It shares no code with the kernels.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "data/control_mesh.h"
#include "data/scheme.h"

namespace limitcheck::fast {

using Point = std::array<long double, 3>;

inline Point operator+(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point operator*(long double s, const Point& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
inline Point cross_product(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline long double norm(const Point& a) {
  return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

struct RefinedMesh {
  using Edge = std::pair<int, int>;  // the smaller vertex first
  static constexpr long double kInfinite = std::numeric_limits<long double>::infinity();

  data::Scheme scheme;
  bool chaikin = false, smooth_triangles = false;
  std::vector<Point> points{};
  std::vector<std::vector<int>> faces{};
  std::vector<std::vector<int>> around{};  // the faces at each vertex
  std::map<Edge, long double> sharp_edges{};
  std::map<int, long double> sharp_vertices{};

  static Edge edge(int a, int b) { return std::minmax(a, b); }
  long double sharpness(const Edge& e) const {
    const auto found = sharp_edges.find(e);
    return found == sharp_edges.end() ? 0 : found->second;
  }
  long double sharpness(int v) const {
    const auto found = sharp_vertices.find(v);
    return found == sharp_vertices.end() ? 0 : found->second;
  }

  static RefinedMesh of(const data::ControlMesh& mesh, data::Scheme scheme) {
    RefinedMesh out{scheme, mesh.sharpness.creasing == data::Creasing::kChaikin,
                    mesh.sharpness.triangles == data::TriangleRule::kSmooth};
    for (const auto& p : mesh.positions) out.points.push_back({p[0], p[1], p[2]});
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      out.faces.emplace_back(mesh.faces[f].begin(), mesh.faces[f].end());
    out.find_faces_around();
    const auto in_long = [](float s) { return s >= 10 ? kInfinite : static_cast<long double>(s); };
    for (const auto& [a, b, s] : mesh.sharpness.edges)
      if (s > 0) out.sharp_edges[edge(a, b)] = in_long(s);
    for (const auto& [v, s] : mesh.sharpness.vertices)
      if (s > 0) out.sharp_vertices[v] = in_long(s);
    for (const auto& [e, list] : out.faces_of_edges()) {
      if (list.size() != 1) continue;
      out.sharp_edges[e] = kInfinite;
      for (const int v : {e.first, e.second})
        if (mesh.sharpness.boundary == data::Boundary::kEdgeAndCorner && out.around[v].size() == 1)
          out.sharp_vertices[v] = kInfinite;
    }
    return out;
  }

  std::map<Edge, std::vector<int>> faces_of_edges() const {
    std::map<Edge, std::vector<int>> at;
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (std::size_t k = 0; k < faces[f].size(); ++k)
        at[edge(faces[f][k], faces[f][(k + 1) % faces[f].size()])].push_back(static_cast<int>(f));
    return at;
  }

  /// New vertices: old ones, edges in the order of the map, Catmull and Clark's faces. Loop's faces: those at the
  /// corners, the middle one; Catmull and Clark's (V, E, F, E') corner by corner.
  RefinedMesh step() const {
    RefinedMesh out{scheme, chaikin, smooth_triangles};
    const bool loop = scheme == data::Scheme::kLoop;
    const auto at = faces_of_edges();
    std::map<Edge, int> number;
    int next = static_cast<int>(points.size());
    std::vector<std::vector<int>> neighbours(points.size());
    for (const auto& entry : at) {
      const auto& [a, b] = entry.first;
      number[entry.first] = next++;
      neighbours[a].push_back(b), neighbours[b].push_back(a);
    }
    const int first_face = next;
    std::vector<Point> centroid;
    for (const auto& face : faces) {
      Point sum{};
      for (const int v : face) sum = sum + points[v];
      centroid.push_back(1.L / static_cast<long double>(face.size()) * sum);
    }

    // One half of an edge at its end v: 1 less, with Chaikin's mean over the other semi-sharp edges at v.
    const auto child = [&](int v, const Edge& e) -> long double {
      long double s = sharpness(e);
      if (s == 0 || s == kInfinite) return s;
      std::vector<long double> others;
      for (const int w : neighbours[v])
        if (const long double o = sharpness(edge(v, w)); edge(v, w) != e && o > 0 && o < kInfinite)
          others.push_back(o);
      if (chaikin && !others.empty()) {
        long double mean = 0;
        for (const long double o : others) mean += o / static_cast<long double>(others.size());
        s = .75L * s + .25L * mean;
      }
      return std::max(0.L, s - 1);
    };

    enum Rule { kSmooth, kDart, kCrease, kCorner };
    for (int v = 0; v < static_cast<int>(points.size()); ++v) {
      if (around[v].empty()) {
        out.points.push_back(points[v]);
        continue;
      }
      const auto n = static_cast<long double>(neighbours[v].size());
      const long double own = sharpness(v), own_child = own == kInfinite ? own : std::max(0.L, own - 1);
      std::vector<int> now, then;
      long double vanishing = own > 0 && own_child == 0 ? own : 0, count = own > 0 && own_child == 0 ? 1 : 0;
      for (const int w : neighbours[v]) {
        const long double s = sharpness(edge(v, w)), c = child(v, edge(v, w));
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
        if (loop) return (1 - loop_weight(n)) * points[v] + (loop_weight(n) / n) * sum;
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
      const long double s = sharpness(ends), a = child(ends.first, ends), b = child(ends.second, ends);
      Point point = middle;
      if (s < 1 && !(a > 0 && b > 0)) {
        // With 3/8 of each centroid the corners opposite get Loop's 1/8.
        const auto weight = [&](int face) {
          return loop ? .375L : smooth_triangles && faces[face].size() == 3 ? .47L : .25L;
        };
        const int f = list[0], g = list[1];
        const long double w = (weight(f) + weight(g)) / 2;
        const Point smooth = (1 - 2 * w) * middle + w * (centroid[f] + centroid[g]);
        point = s * middle + (1 - s) * smooth;
      }
      out.points.push_back(point);
      if (a > 0) out.sharp_edges[edge(ends.first, number[ends])] = a;
      if (b > 0) out.sharp_edges[edge(ends.second, number[ends])] = b;
    }
    if (!loop) out.points.insert(out.points.end(), centroid.begin(), centroid.end());
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const auto& face = faces[f];
      const std::size_t m = face.size();
      const auto side = [&](std::size_t k) { return number[edge(face[k % m], face[(k + 1) % m])]; };
      if (loop) {
        const int a = side(0), b = side(1), c = side(2);
        for (const std::vector<int>& part :
             {std::vector{face[0], a, c}, {a, face[1], b}, {c, b, face[2]}, {a, b, c}})
          out.faces.push_back(part);
      } else {
        for (std::size_t k = 0; k < m; ++k)
          out.faces.push_back({face[k], side(k), first_face + static_cast<int>(f), side(k + m - 1)});
      }
    }
    out.find_faces_around();
    return out;
  }

  /// The part of a smooth vertex of n neighbours that they share.
  static long double loop_weight(long double n) {
    return .625L - std::pow(3 + 2 * std::cos(2 * std::numbers::pi_v<long double> / n), 2) / 64;
  }

 private:
  void find_faces_around() {
    around.resize(points.size());
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (const int v : faces[f]) around[v].push_back(static_cast<int>(f));
  }
};

}  // namespace limitcheck::fast
