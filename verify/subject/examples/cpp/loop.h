// SPDX-License-Identifier: MIT
// A tessellator such as yours may be: Loop subdivision of a whole mesh, one step after another. Slow, short
// and right, boundaries included. It knows nothing of limitcheck; subject.cpp does.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <utility>
#include <vector>

using Vec = std::array<double, 3>;
using Triangle = std::array<int, 3>;

inline const double kPi = std::acos(-1.0);

inline void add(Vec& to, double w, const Vec& p) {
  for (std::size_t k = 0; k < 3; ++k) to[k] += w * p[k];
}

struct Mesh {
  std::vector<Vec> positions{};
  std::vector<Triangle> triangles{};
  std::map<std::pair<int, int>, int> after{};  // (v, a) -> b for each triangle (v, a, b)
  std::map<int, int> start{};                  // a neighbour; the first, counter-clockwise, at a boundary

  Mesh() = default;
  Mesh(const double* points, std::int64_t vertex_count, const std::int32_t* corners,
       std::int64_t triangle_count) {
    for (std::int64_t v = 0; v < vertex_count; ++v, points += 3)
      positions.push_back({points[0], points[1], points[2]});
    for (std::int64_t t = 0; t < triangle_count; ++t, corners += 3)
      triangles.push_back({corners[0], corners[1], corners[2]});
  }

  /// Finds the neighbours. Returns what is wrong with the mesh, or a null pointer.
  const char* connect() {
    if (triangles.empty()) return "there are no triangles";
    for (const Vec& p : positions)
      for (const double x : p)
        if (!std::isfinite(x)) return "a coordinate is not finite";
    for (const Triangle& t : triangles)
      for (const int v : t)
        if (v < 0 || v >= static_cast<int>(positions.size()))
          return "a triangle names a vertex that does not exist";
    std::map<int, int> faces;
    for (const Triangle& t : triangles)
      for (std::size_t k = 0; k < 3; ++k, ++faces[t[k % 3]])
        if (!after.try_emplace({t[k], t[(k + 1) % 3]}, t[(k + 2) % 3]).second)
          return "two triangles run along an edge in the same direction";
    for (const auto& [edge, next] : after)
      if (after.count({edge.second, edge.first}) == 0 || start.count(edge.first) == 0)
        start[edge.first] = edge.second;
    for (const auto& [v, count] : faces) {
      bool boundary = false;
      const int around = static_cast<int>(ring(v, boundary).size()) - boundary;
      if (around != count) return "the triangles at a vertex form more than one fan";
    }
    return nullptr;
  }

  std::vector<int> ring(int v, bool& boundary) const {
    std::vector<int> r{start.at(v)};
    boundary = after.count({r[0], v}) == 0;
    for (auto next = after.find({v, r[0]}); next != after.end(); next = after.find({v, next->second})) {
      if (next->second == r[0]) break;
      r.push_back(next->second);
    }
    return r;
  }

  /// Vertex v after one step (normal == nullptr), or its limit position and normal.
  Vec moved(int v, Vec* normal) const {
    bool boundary = false;
    const std::vector<int> r = ring(v, boundary);
    const auto n = static_cast<double>(r.size());
    const double faces = n - 1, c = std::cos(kPi / faces), s = std::sin(kPi / faces);
    Vec p = positions[v], sum{}, t{}, u{};
    for (std::size_t i = 0; i < r.size(); ++i) {
      const bool end = boundary && (i == 0 || i + 1 == r.size());
      const auto x = static_cast<double>(i);
      Vec d = positions[r[i]];
      add(d, -1, p);
      if (!boundary || end) add(sum, 1, d);
      const double across = faces == 1 ? 1
                            : end      ? -c * (1 + c) / ((1 + 2 * c) * s)
                                       : std::sin(x * kPi / faces);
      add(t, boundary ? (i == 0 ? 1 : end ? -1 : 0) : std::cos(2 * kPi * x / n), d);
      add(u, boundary ? across : std::sin(2 * kPi * x / n), d);
    }
    const double b = 3 + 2 * std::cos(2 * kPi / n), a = 5.0 / 8 - b * b / 64;
    add(p,
        normal == nullptr ? (boundary ? 1.0 / 8 : a / n) : (boundary ? 1.0 / 6 : 8 * a / (n * (3 + 8 * a))),
        sum);
    if (normal == nullptr) return p;
    *normal = {t[1] * u[2] - t[2] * u[1], t[2] * u[0] - t[0] * u[2], t[0] * u[1] - t[1] * u[0]};
    const double length = std::hypot((*normal)[0], (*normal)[1], (*normal)[2]);
    if (length > 0) {
      for (double& x : *normal) x /= length;
    } else {
      *normal = {0, 0, 1};
    }
    return p;
  }

  Mesh refined(int steps) const {
    if (steps == 0) return *this;
    Mesh fine;
    for (int v = 0; v < static_cast<int>(positions.size()); ++v) fine.positions.push_back(moved(v, nullptr));
    std::map<std::pair<int, int>, int> middle;
    for (const Triangle& old : triangles) {
      Triangle inner = old;
      for (std::size_t k = 0; k < 3; ++k) {
        const int a = old[k], b = old[(k + 1) % 3];
        const auto [place, is_new] =
            middle.try_emplace(std::minmax(a, b), static_cast<int>(fine.positions.size()));
        inner[k] = place->second;
        if (!is_new) continue;
        const auto other = after.find({b, a});
        Vec p{};
        for (const int end : {a, b}) add(p, other == after.end() ? 1.0 / 2 : 3.0 / 8, positions[end]);
        if (other != after.end())
          for (const int side : {old[(k + 2) % 3], other->second}) add(p, 1.0 / 8, positions[side]);
        fine.positions.push_back(p);
      }
      for (std::size_t k = 0; k < 3; ++k) fine.triangles.push_back({old[k], inner[k], inner[(k + 2) % 3]});
      fine.triangles.push_back(inner);
    }
    fine.connect();
    return fine.refined(steps - 1);
  }
};
