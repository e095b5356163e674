// SPDX-License-Identifier: MIT
// For the tests of fast/: a whole mesh of quads refined at once by Catmull and Clark's rules, in long double.
// It shares no code with the kernels.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "data/control_mesh.h"
#include "fast/test_support/global_refinement.h"

namespace limitcheck::fast {

struct RefinedQuads {
  std::vector<Point> points;
  std::vector<std::array<int, 4>> faces;
  std::set<int> held;
  /// Vertex at (i, j) / 2^depth of each control face: [face][j * side + i].
  std::vector<std::vector<int>> lattice;
  int side = 2;

  struct Limit {
    Point position, normal;
  };

  static RefinedQuads of(const data::ControlMesh& mesh, int depth, std::set<int> held = {}) {
    RefinedQuads out;
    out.held = std::move(held);
    for (const auto& p : mesh.positions) out.points.push_back({p[0], p[1], p[2]});
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      const auto& q = mesh.faces[f];
      out.faces.push_back({q[0], q[1], q[2], q[3]});
      out.lattice.push_back({q[0], q[1], q[3], q[2]});
    }
    for (int d = 0; d < depth; ++d) out.step();
    out.find_incident();
    return out;
  }

  Limit limit(std::size_t face, int i, int j) const { return limit(lattice[face][j * side + i]); }

  Limit limit(int v) const {
    const Ring ring = ring_of(v);
    const std::size_t faces_here = ring.face.size();
    const Point c = points[v];
    const auto n = static_cast<long double>(faces_here), pi = std::numbers::pi_v<long double>;
    const auto e = [&](std::size_t k) { return points[ring.edge[k]]; };
    const auto f = [&](std::size_t k) { return points[ring.face[k]]; };
    Point position{}, u{}, w{};
    if (held.count(v) != 0) {
      position = c, u = e(0) - c, w = e(faces_here) - c;
    } else if (ring.open) {
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

 private:
  struct Ring {  // counter-clockwise; open: one more edge neighbour than face neighbours
    std::vector<int> edge, face;
    bool open = false;
  };

  Ring ring_of(int v) const {
    std::map<int, std::pair<int, int>> next;  // edge neighbour -> face neighbour, edge neighbour after it
    std::set<int> second;
    for (const int f : incident_[v]) {
      const auto& q = faces[f];
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

  void find_incident() {
    incident_.assign(points.size(), {});
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (const int v : faces[f]) incident_[v].push_back(static_cast<int>(f));
  }

  void step() {
    find_incident();
    std::vector<Point> refined;
    std::vector<Point> centre;
    std::map<std::pair<int, int>, std::vector<int>> edges;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const auto& q = faces[f];
      centre.push_back(.25L * (points[q[0]] + points[q[1]] + points[q[2]] + points[q[3]]));
      for (std::size_t k = 0; k < 4; ++k)
        edges[std::minmax(q[k], q[(k + 1) % 4])].push_back(static_cast<int>(f));
    }
    std::vector<std::vector<int>> boundary(points.size());
    for (const auto& [edge, around] : edges) {
      if (around.size() == 2) continue;
      boundary[edge.first].push_back(edge.second);
      boundary[edge.second].push_back(edge.first);
    }
    for (std::size_t v = 0; v < points.size(); ++v) {
      const int number = static_cast<int>(v);
      if (held.count(number) != 0 || incident_[v].empty()) {
        refined.push_back(points[v]);
      } else if (!boundary[v].empty()) {
        refined.push_back(.75L * points[v] + .125L * (points[boundary[v][0]] + points[boundary[v][1]]));
      } else {
        const auto n = static_cast<long double>(incident_[v].size());
        Point sum{};
        for (const int f : incident_[v]) sum = sum + centre[f];
        for (const int e : ring_of(number).edge) sum = sum + points[e];
        refined.push_back((n - 2) / n * points[v] + 1 / (n * n) * sum);
      }
    }
    std::map<std::pair<int, int>, int> middle;
    for (const auto& [edge, around] : edges) {
      const Point ends = points[edge.first] + points[edge.second];
      middle[edge] = static_cast<int>(refined.size());
      refined.push_back(around.size() == 2 ? .25L * (ends + centre[around[0]] + centre[around[1]])
                                           : .5L * ends);
    }
    std::vector<int> centre_at;
    for (const Point& p : centre) {
      centre_at.push_back(static_cast<int>(refined.size()));
      refined.push_back(p);
    }
    std::vector<std::array<int, 4>> split;
    std::map<std::array<int, 4>, int> number_of;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const auto& q = faces[f];
      for (std::size_t k = 0; k < 4; ++k) {
        split.push_back({q[k], middle[std::minmax(q[k], q[(k + 1) % 4])], centre_at[f],
                         middle[std::minmax(q[(k + 3) % 4], q[k])]});
      }
      std::array<int, 4> corners = q;
      std::sort(corners.begin(), corners.end());
      number_of[corners] = static_cast<int>(f);
    }
    const int finer_side = 2 * side - 1;
    for (auto& face : lattice) {
      std::vector<int> finer(static_cast<std::size_t>(finer_side) * finer_side);
      for (int j = 0; j < finer_side; ++j) {
        for (int i = 0; i < finer_side; ++i) {
          const auto at = [&](int x, int y) { return face[(j / 2 + y) * side + i / 2 + x]; };
          int& to = finer[j * finer_side + i];
          if (i % 2 == 0 && j % 2 == 0) {
            to = at(0, 0);
          } else if (i % 2 == 1 && j % 2 == 1) {
            std::array<int, 4> corners{at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
            std::sort(corners.begin(), corners.end());
            to = centre_at[number_of[corners]];
          } else {
            to = middle[std::minmax(at(0, 0), i % 2 == 1 ? at(1, 0) : at(0, 1))];
          }
        }
      }
      face = std::move(finer);
    }
    side = finer_side;
    points = std::move(refined);
    faces = std::move(split);
  }

  std::vector<std::vector<int>> incident_;
};

}  // namespace limitcheck::fast
