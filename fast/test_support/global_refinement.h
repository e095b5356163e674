// SPDX-License-Identifier: MIT
// For the tests of fast/: the whole mesh refined at once, through maps, in long double. It shares no code
// with the kernels.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "data/control_mesh.h"
#include "fast/frame/sink.h"

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
  std::vector<Point> points;
  std::vector<std::array<int, 3>> faces;
  std::set<std::pair<int, int>> sharp;  // edges inside that stay sharp, the lesser end first
  std::set<int> held;                   // vertices that stay where they are
  /// Vertex at (l1, l2) = (i, j) / 2^depth of each control face.
  std::vector<std::map<std::pair<int, int>, int>> lattice;

  struct Limit {
    Point position, normal;
  };

  static RefinedMesh of(const data::ControlMesh& mesh, int depth) {
    RefinedMesh out;
    for (const auto& p : mesh.positions) out.points.push_back({p[0], p[1], p[2]});
    out.lattice.resize(mesh.faces.size());
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      const auto& t = triangles_of(mesh)[f];
      out.faces.push_back({t[0], t[1], t[2]});
      out.lattice[f] = {{{0, 0}, t[0]}, {{1, 0}, t[1]}, {{0, 1}, t[2]}};
    }
    for (const auto& e : mesh.sharpness.edges) out.sharp.insert(std::minmax(e.a, e.b));
    for (const auto& v : mesh.sharpness.vertices) out.held.insert(v.vertex);
    if (mesh.sharpness.boundary == data::Boundary::kEdgeAndCorner)
      for (std::size_t v = 0; v < out.points.size(); ++v)
        if (out.incident()[v].size() == 1) out.held.insert(static_cast<int>(v));
    for (int d = 0; d < depth; ++d) out.step();
    return out;
  }

  /// Neighbours counter-clockwise; first of pair: open (boundary).
  std::pair<bool, std::vector<int>> ring(int v) const {
    std::map<int, int> next;  // neighbour -> neighbour after it
    std::set<int> second;
    for (const int f : incident()[v]) {
      const auto& t = faces[f];
      for (int k = 0; k < 3; ++k) {
        if (t[k] != v) continue;
        next[t[(k + 1) % 3]] = t[(k + 2) % 3];
        second.insert(t[(k + 2) % 3]);
      }
    }
    int first = next.begin()->first;
    bool open = false;
    for (const auto& [from, to] : next)
      if (second.count(from) == 0) first = from, open = true;
    std::vector<int> result{first};
    for (auto at = next.find(first); at != next.end() && at->second != first; at = next.find(at->second))
      result.push_back(at->second);
    return {open, result};
  }

  /// The other ends of the sharp edges at a vertex, the boundary's among them.
  std::vector<int> sharp_neighbours(int v) const {
    const auto [open, r] = ring(v);
    std::vector<int> ends;
    for (std::size_t k = 0; k < r.size(); ++k)
      if ((open && (k == 0 || k + 1 == r.size())) || sharp.count(std::minmax(v, r[k])) > 0)
        ends.push_back(r[k]);
    return ends;
  }

  /// The limit position with sharp edges and held vertices; nothing for a dart, whose limit has no closed
  /// form.
  std::optional<Point> sharp_limit(int v) const {
    const std::vector<int> ends = sharp_neighbours(v);
    if (held.count(v) > 0 || ends.size() > 2) return points[v];
    if (ends.size() == 1) return std::nullopt;
    if (ends.empty()) return limit(v).position;
    return (1.L / 6) * (4.L * points[v] + points[ends[0]] + points[ends[1]]);
  }

  /// The limit of a point of a control face, whose denominator is 2^depth.
  Limit limit(const LatticePoint& at) const {
    return limit(lattice[at.face].at({static_cast<int>(at.i), static_cast<int>(at.j)}));
  }
  Limit limit(int v) const {
    const auto [open, r] = ring(v);
    const Point c = points[v];
    const int n = static_cast<int>(r.size());
    const auto p = [&, &rr = r](int i) { return points[rr[i]]; };
    const long double pi = std::numbers::pi_v<long double>;
    Point position{}, u{}, w{};
    if (!open) {
      const long double a = .625L - std::pow(3 + 2 * std::cos(2 * pi / n), 2) / 64;
      const long double w0 = 3 * n / (8 * a);
      for (int i = 0; i < n; ++i) {
        position = position + p(i);
        u = u + std::cos(2 * pi * i / n) * p(i);
        w = w + std::sin(2 * pi * i / n) * p(i);
      }
      position = 1 / (w0 + n) * (w0 * c + position);
    } else {
      const int k = n - 1;
      position = (1.L / 6) * (4.L * c + p(0) + p(k));
      u = p(0) - p(k);
      if (k == 1) {
        w = p(0) + p(1) - 2.L * c;
      } else {
        const long double t = pi / k, co = std::cos(t), si = std::sin(t);
        const long double end = -co * (1 + co) / ((1 + 2 * co) * si);
        w = end * (p(0) + p(k)) + ((2 * co - 1) * end - si) * c;
        for (int i = 1; i < k; ++i) w = w + std::sin(i * t) * p(i);
      }
    }
    const Point normal = cross_product(u, w);
    return {position, 1 / norm(normal) * normal};
  }

 private:
  const std::vector<std::vector<int>>& incident() const {
    if (incident_.size() != points.size()) {
      incident_.assign(points.size(), {});
      for (std::size_t f = 0; f < faces.size(); ++f)
        for (const int v : faces[f]) incident_[v].push_back(static_cast<int>(f));
    }
    return incident_;
  }

  void step() {
    std::map<std::pair<int, int>, std::vector<int>> opposite;
    for (const auto& t : faces)
      for (std::size_t k = 0; k < 3; ++k)
        opposite[std::minmax(t[k], t[(k + 1) % 3])].push_back(t[(k + 2) % 3]);
    const auto at = [&](int v) { return points[v]; };
    std::vector<Point> refined;
    for (std::size_t v = 0; v < points.size(); ++v) {
      const auto [open, r] = ring(static_cast<int>(v));
      const std::vector<int> ends = sharp_neighbours(static_cast<int>(v));
      if (held.count(static_cast<int>(v)) > 0 || ends.size() > 2) {
        refined.push_back(points[v]);
        continue;
      }
      if (ends.size() == 2) {
        refined.push_back(.75L * points[v] + .125L * (at(ends[0]) + at(ends[1])));
        continue;
      }
      const long double n = static_cast<long double>(r.size());
      const long double a =
          .625L - std::pow(3 + 2 * std::cos(2 * std::numbers::pi_v<long double> / n), 2) / 64;
      Point sum{};
      for (const int q : r) sum = sum + at(q);
      refined.push_back((1 - a) * points[v] + (a / n) * sum);
    }
    std::map<std::pair<int, int>, int> middle;
    std::set<std::pair<int, int>> halves;
    for (const auto& [edge, apexes] : opposite) {
      middle[edge] = static_cast<int>(refined.size());
      if (sharp.count(edge) > 0) {
        for (const int end : {edge.first, edge.second}) halves.insert({end, middle[edge]});
        refined.push_back(.5L * (at(edge.first) + at(edge.second)));
        continue;
      }
      refined.push_back(apexes.size() == 2 ? .375L * (at(edge.first) + at(edge.second)) +
                                                 .125L * (at(apexes[0]) + at(apexes[1]))
                                           : .5L * (at(edge.first) + at(edge.second)));
    }
    std::vector<std::array<int, 3>> split;
    for (const auto& t : faces) {
      const int a = middle[std::minmax(t[0], t[1])], b = middle[std::minmax(t[1], t[2])],
                c = middle[std::minmax(t[2], t[0])];
      for (const auto& s : {std::array{t[0], a, c}, {a, t[1], b}, {c, b, t[2]}, {a, b, c}})
        split.push_back(s);
    }
    for (auto& face : lattice) {
      std::map<std::pair<int, int>, int> finer;
      for (const auto& [ij, v] : face) {
        finer[{2 * ij.first, 2 * ij.second}] = v;
        for (const auto& [di, dj] : {std::pair{1, 0}, {0, 1}, {1, -1}}) {
          const auto other = face.find({ij.first + di, ij.second + dj});
          if (other != face.end())
            finer[{2 * ij.first + di, 2 * ij.second + dj}] = middle[std::minmax(v, other->second)];
        }
      }
      face = std::move(finer);
    }
    points = std::move(refined);
    faces = std::move(split);
    sharp = std::move(halves);
    incident_.clear();
  }

  mutable std::vector<std::vector<int>> incident_;
};

}  // namespace limitcheck::fast
