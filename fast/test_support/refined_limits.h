// SPDX-License-Identifier: MIT
// For the tests of fast/: limits of the vertices of a refined mesh by the masks as they are written down, in long
// double, and a frame against them.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "fast/frame/sink.h"
#include "fast/test_support/refined_mesh.h"

namespace limitcheck::fast {

/// The neighbours of a vertex of triangles or quads, counter-clockwise; open: one more edge neighbour than faces.
struct RefinedRing {
  std::vector<int> edge, far;  ///< far: the next corner but one of each face
  bool open = false;

  RefinedRing(const RefinedMesh& mesh, int v) {
    std::map<int, std::pair<int, int>> next;  // edge neighbour -> far corner, edge neighbour after it
    std::set<int> second;
    for (const int f : mesh.around[v]) {
      const auto& face = mesh.faces[f];
      const std::size_t m = face.size();
      for (std::size_t k = 0; k < m; ++k) {
        if (face[k] != v) continue;
        next[face[(k + 1) % m]] = {face[(k + 2) % m], face[(k + m - 1) % m]};
        second.insert(face[(k + m - 1) % m]);
      }
    }
    int first = next.begin()->first;
    for (const auto& entry : next)
      if (second.count(entry.first) == 0) first = entry.first, open = true;
    int at = first;
    do {
      edge.push_back(at);
      const auto found = next.find(at);
      if (found == next.end()) break;
      far.push_back(found->second.first);
      at = found->second.second;
    } while (at != first);
  }
};

struct SurfaceLimit {
  Point position, normal;
};

/// Of a vertex without sharp edges but the boundary.
inline SurfaceLimit smooth_limit(const RefinedMesh& mesh, int v) {
  const RefinedRing ring(mesh, v);
  const bool loop = mesh.scheme == data::Scheme::kLoop;
  const std::size_t faces = ring.far.size();
  const Point c = mesh.points[v];
  const auto e = [&](std::size_t k) { return mesh.points[ring.edge[k]]; };
  const auto f = [&](std::size_t k) { return mesh.points[ring.far[k]]; };
  const auto n = static_cast<long double>(faces), pi = std::numbers::pi_v<long double>;
  const long double t = ring.open ? pi / n : 2 * pi / n, co = std::cos(t), si = std::sin(t);
  const long double lambda = (5 + co + std::cos(t / 2) * std::sqrt(2 * (9 + co))) / 16;  // of quads
  Point position{}, u{}, w{};
  if (ring.open) {
    position = (1.L / 6) * (4.L * c + e(0) + e(faces));
    u = e(0) - e(faces);
    if (faces == 1) {
      w = e(0) + e(1) - 2.L * c;
    } else if (loop) {
      const long double end = -co * (1 + co) / ((1 + 2 * co) * si);
      w = end * (e(0) + e(faces)) + ((2 * co - 1) * end - si) * c;
      for (std::size_t k = 1; k < faces; ++k) w = w + std::sin(k * t) * e(k);
    } else {
      const long double cot = 1 / std::tan(t / 2), q = 4 * lambda - 1;
      const long double end = (4 * lambda * si - (8 * lambda - 1) * cot) / (q * q);
      w = end * (e(0) + e(faces)) + (-2 * end - cot * (16 * lambda - 2) / q) * c;
      for (std::size_t k = 1; k < faces; ++k) w = w + 4 * std::sin(k * t) * e(k);
      for (std::size_t k = 0; k < faces; ++k) w = w + (std::sin(k * t) + std::sin((k + 1) * t)) / q * f(k);
    }
  } else {
    const long double own = loop ? 3 * n / (8 * RefinedMesh::loop_weight(n)) : n * n;
    const long double edges = loop ? 1 : 4, quads = loop ? 0 : 1;
    position = own * c;
    for (std::size_t k = 0; k < faces; ++k) {
      position = position + edges * e(k) + quads * f(k);
      u = u + edges * std::cos(k * t) * e(k) +
          quads * (std::cos(k * t) + std::cos((k + 1) * t)) / (4 * lambda - 1) * f(k);
      w = w + edges * std::sin(k * t) * e(k) +
          quads * (std::sin(k * t) + std::sin((k + 1) * t)) / (4 * lambda - 1) * f(k);
    }
    position = 1 / (own + n * (edges + quads)) * position;
  }
  const Point normal = cross_product(u, w);
  return {position, 1 / norm(normal) * normal};
}

/// Nothing for a dart, which has no closed form, and where something is semi-sharp.
inline std::optional<Point> sharp_limit(const RefinedMesh& mesh, int v) {
  Point ends{};
  int sharp = 0;
  for (const int w : RefinedRing(mesh, v).edge) {
    const long double s = mesh.sharpness(RefinedMesh::edge(v, w));
    if (s == 0) continue;
    if (s != RefinedMesh::kInfinite) return std::nullopt;
    ends = ends + mesh.points[w];
    ++sharp;
  }
  if (const long double held = mesh.sharpness(v); held > 0)
    return held == RefinedMesh::kInfinite ? std::optional<Point>(mesh.points[v]) : std::nullopt;
  if (sharp == 0) return smooth_limit(mesh, v).position;
  if (sharp == 1) return std::nullopt;
  return sharp > 2 ? mesh.points[v] : 2.L / 3 * mesh.points[v] + 1.L / 6 * ends;
}

/// A mesh after 0, 1, .. `depth` steps: vertices keep their number from one to the next.
class RefinedLevels {
 public:
  RefinedLevels(const data::ControlMesh& mesh, data::Scheme scheme, std::size_t depth)
      : level_{RefinedMesh::of(mesh, scheme)} {
    while (level_.size() <= depth) level_.push_back(level_.back().step());
  }
  static RefinedLevels loop(const data::ControlMesh& mesh, std::size_t depth) {
    return {mesh, data::Scheme::kLoop, depth};
  }

  SurfaceLimit limit(const LatticePoint& at) const { return smooth_limit(level_.back(), vertex(at)); }
  const std::optional<Point>& position(const LatticePoint& at) const {
    const int v = vertex(at);
    const auto found = known_.find(v);
    return found != known_.end() ? found->second
                                 : known_.emplace(v, sharp_limit(level_.back(), v)).first->second;
  }

 private:
  /// The vertex at (i, j) / denominator, a power of two.
  int vertex(const LatticePoint& at) const {
    int m = static_cast<int>(at.denominator), i = static_cast<int>(at.i), j = static_cast<int>(at.j);
    std::size_t l = 0;
    int face = at.face;
    const auto first_part = [&](int f) {
      int first = 0;
      for (int before = 0; before < f; ++before) first += static_cast<int>(level_[0].faces[before].size());
      return first;
    };
    if (level_[0].scheme == data::Scheme::kLoop) {
      for (; m > 1; m /= 2, ++l) {
        const int h = m / 2, k = i + j <= h ? 0 : i >= h ? 1 : j >= h ? 2 : 3;
        const std::array<std::pair<int, int>, 4> in{{{i, j}, {i - h, j}, {i, j - h}, {i + j - h, h - i}}};
        std::tie(i, j) = in[k];
        face = 4 * face + k;
      }
      return level_[l].faces[face][i + 2 * j];
    }
    if (level_[0].faces[face].size() != 4) face = first_part(face) + at.corner, l = 1;
    for (; m > 1; m /= 2, ++l) {
      const int h = m / 2, k = j <= h ? (i <= h ? 0 : 1) : i > h ? 2 : 3;
      const std::array<std::pair<int, int>, 4> in{{{i, j}, {j, m - i}, {m - i, m - j}, {m - j, i}}};
      std::tie(i, j) = in[k];
      face = (l > 0 ? 4 * face : first_part(face)) + k;
    }
    return level_[l].faces[face][j == 0 ? i : 3 - i];
  }

  std::vector<RefinedMesh> level_;
  mutable std::map<int, std::optional<Point>> known_;  ///< by vertex of the finest mesh
};

/// All vertices of a frame but the centres of fans. Returns how many have been judged.
///   normals   bound, of a mesh without sharp edges
template <class Output>
int expect_on_the_limit(const RefinedLevels& exact, const Output& out, double bound, const std::string& what,
                        std::optional<double> normals = {}) {
  EXPECT_EQ(out.provenance.size(), out.vertices.size());
  int judged = 0;
  for (std::size_t i = 0; i < out.vertices.size(); ++i) {
    const LatticePoint& at = out.provenance[i];
    if (at.denominator == 3) continue;
    const auto& limit = exact.position(at);
    if (!limit) continue;
    ++judged;
    const auto &p = out.vertices[i].position, &n = out.vertices[i].normal;
    const long double error = norm(Point{p.x, p.y, p.z} - *limit);
    const long double turn = normals ? norm(Point{n.x, n.y, n.z} - exact.limit(at).normal) : 0;
    if (error <= bound && turn <= normals.value_or(0)) continue;
    ADD_FAILURE() << what << ", face " << at.face << ":" << at.corner << " (" << at.i << ", " << at.j
                  << ") / " << at.denominator << " is off by " << error << ", its normal by " << turn;
    return judged;
  }
  return judged;
}

}  // namespace limitcheck::fast
