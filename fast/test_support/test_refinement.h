// SPDX-License-Identifier: MIT
// The slow way, for the tests of this folder: refine the whole mesh in double, then take the limit of each
// vertex.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "data/control_mesh.h"
#include "fast/mesh/adjacency.h"

namespace limitcheck::fast::row_stream {

struct RefinedMesh {
  struct Lattice {
    std::int32_t face;
    std::array<std::array<int, 2>, 3> at;  // (i, j) of each corner: l1 = i / 2^depth, l2 = j / 2^depth
  };
  data::ControlMesh mesh;
  std::vector<Lattice> lattice;  // per refined face
};

inline RefinedMesh start_refinement(const data::ControlMesh& mesh) {
  RefinedMesh refined{mesh, {}};
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    refined.lattice.push_back({static_cast<std::int32_t>(f), {{{0, 0}, {1, 0}, {0, 1}}}});
  return refined;
}

/// One step of Loop's rules, boundary edges by the B-spline rule.
inline RefinedMesh refine_once(const RefinedMesh& old) {
  using P = std::array<double, 3>;
  const auto& mesh = old.mesh;
  const auto edge = [](std::int32_t a, std::int32_t b) { return std::pair(std::min(a, b), std::max(a, b)); };
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::int32_t>> opposite;
  for (const auto& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) opposite[edge(t[k], t[(k + 1) % 3])].push_back(t[(k + 2) % 3]);
  }

  std::vector<std::vector<std::int32_t>> ring(mesh.positions.size()), ends(mesh.positions.size());
  for (const auto& [e, apexes] : opposite) {
    ring[e.first].push_back(e.second);
    ring[e.second].push_back(e.first);
    if (apexes.size() == 1) ends[e.first].push_back(e.second), ends[e.second].push_back(e.first);
  }

  RefinedMesh out;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const bool boundary = !ends[v].empty();
    const double n = static_cast<double>(ring[v].size());
    const double b = 3 + 2 * std::cos(2 * std::numbers::pi / n);
    const double a = boundary ? .25 : 5. / 8 - b * b / 64;
    P p{};
    for (int c = 0; c < 3; ++c) {
      for (const auto r : boundary ? ends[v] : ring[v]) p[c] += mesh.positions[r][c] * a / (boundary ? 2 : n);
      p[c] += (1 - a) * mesh.positions[v][c];
    }
    out.mesh.positions.push_back(p);
  }
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middle;
  for (const auto& [e, apexes] : opposite) {
    P p{};
    for (int c = 0; c < 3; ++c) {
      const double sum = mesh.positions[e.first][c] + mesh.positions[e.second][c];
      p[c] = apexes.size() == 1
                 ? sum / 2
                 : 3 * sum / 8 + (mesh.positions[apexes[0]][c] + mesh.positions[apexes[1]][c]) / 8;
    }
    middle[e] = static_cast<std::int32_t>(out.mesh.positions.size());
    out.mesh.positions.push_back(p);
  }

  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const auto& t = mesh.triangles[f];
    const auto& at = old.lattice[f].at;
    std::array<std::int32_t, 3> m;
    std::array<std::array<int, 2>, 3> twice, half;
    for (int k = 0; k < 3; ++k) {
      m[k] = middle[edge(t[k], t[(k + 1) % 3])];
      twice[k] = {2 * at[k][0], 2 * at[k][1]};
      half[k] = {at[k][0] + at[(k + 1) % 3][0], at[k][1] + at[(k + 1) % 3][1]};
    }
    for (int k = 0; k < 3; ++k) {
      out.mesh.triangles.push_back({t[k], m[k], m[(k + 2) % 3]});
      out.lattice.push_back({old.lattice[f].face, {twice[k], half[k], half[(k + 2) % 3]}});
    }
    out.mesh.triangles.push_back({m[0], m[1], m[2]});
    out.lattice.push_back({old.lattice[f].face, {half[0], half[1], half[2]}});
  }
  return out;
}

struct LimitPoint {
  std::array<double, 3> position, normal;
};

/// Limit points of the refined vertices: eq. (3), tangents sum cos and sum sin; D1 and D2 on the boundary.
inline std::vector<LimitPoint> limit_points(const data::ControlMesh& mesh) {
  using std::numbers::pi;
  const Adjacency adjacency(mesh);
  std::vector<LimitPoint> out(mesh.positions.size());
  for (std::int32_t v = 0; v < adjacency.vertex_count(); ++v) {
    std::vector<std::int32_t> ring;
    for (std::int32_t h = adjacency.outgoing(v); h >= 0;) {
      ring.push_back(adjacency.target(h));
      const std::int32_t next = adjacency.rotate(h);
      if (next < 0) ring.push_back(adjacency.origin(Adjacency::prev(h)));
      h = next == adjacency.outgoing(v) ? -1 : next;
    }
    const bool boundary = adjacency.on_boundary(v);
    const auto n = static_cast<double>(ring.size());
    std::vector<double> limit(ring.size()), along(ring.size()), across(ring.size());
    double centre = 0, across_centre = 0;
    if (boundary) {
      const std::size_t last = ring.size() - 1;
      const double theta = pi / static_cast<double>(last), c = std::cos(theta), s = std::sin(theta);
      limit.front() = limit.back() = 1. / 6;
      centre = 4. / 6;
      along.front() = 1, along.back() = -1;
      if (last == 1) {
        across = {1, 1}, across_centre = -2;
      } else {
        for (std::size_t k = 1; k < last; ++k) across[k] = std::sin(static_cast<double>(k) * theta);
        across.front() = across.back() = -c * (1 + c) / ((1 + 2 * c) * s);
        across_centre = (2 * c - 1) * across.front() - s;
      }
    } else {
      const double b = 3 + 2 * std::cos(2 * pi / n), w = 3 * n / (8 * (5. / 8 - b * b / 64));
      centre = w / (w + n);
      for (std::size_t k = 0; k < ring.size(); ++k) {
        limit[k] = 1 / (w + n);
        along[k] = std::cos(2 * pi * static_cast<double>(k) / n);
        across[k] = std::sin(2 * pi * static_cast<double>(k) / n);
      }
    }
    std::array<double, 3> p{}, a{}, b{};
    for (int c = 0; c < 3; ++c) {
      p[c] = centre * mesh.positions[v][c], b[c] = across_centre * mesh.positions[v][c];
      for (std::size_t k = 0; k < ring.size(); ++k) {
        p[c] += limit[k] * mesh.positions[ring[k]][c];
        a[c] += along[k] * mesh.positions[ring[k]][c];
        b[c] += across[k] * mesh.positions[ring[k]][c];
      }
    }
    std::array<double, 3> normal{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                 a[0] * b[1] - a[1] * b[0]};
    const double size = std::hypot(normal[0], normal[1], normal[2]);
    for (double& x : normal) x /= size;
    out[v] = {p, normal};
  }
  return out;
}

/// (face, i, j) -> limit point at l1 = i / 2^depth, l2 = j / 2^depth.
inline std::map<std::array<int, 3>, LimitPoint> slow_limit(const data::ControlMesh& mesh, int depth) {
  RefinedMesh refined = start_refinement(mesh);
  for (int d = 0; d < depth; ++d) refined = refine_once(refined);
  const auto points = limit_points(refined.mesh);
  std::map<std::array<int, 3>, LimitPoint> out;
  for (std::size_t f = 0; f < refined.lattice.size(); ++f) {
    const auto& lattice = refined.lattice[f];
    for (int k = 0; k < 3; ++k)
      out[{lattice.face, lattice.at[k][0], lattice.at[k][1]}] = points[refined.mesh.triangles[f][k]];
  }
  return out;
}

}  // namespace limitcheck::fast::row_stream
