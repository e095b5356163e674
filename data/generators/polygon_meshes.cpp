// SPDX-License-Identifier: MIT
#include "data/generators/polygon_meshes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "data/splitmix64.h"

namespace limitcheck::data {
namespace {

/// Two rings of quads around a vertex: a full turn or, if open, 81 degrees a sector, but at most 324 in all.
ControlMesh two_rings(int sectors, bool open, std::uint64_t seed) {
  SplitMix64 random(seed);
  const auto varied = [&](double x) { return x + 0.3 * (2 * random.unit() - 1); };
  ControlMesh mesh;
  const double turn =
      open ? std::min(1.8, 0.45 * sectors) * std::numbers::pi / sectors : 2 * std::numbers::pi / sectors;
  const int spokes = open ? sectors + 1 : sectors;
  // Vertex (i, a, b): a steps along spoke i and b along spoke i + 1; on a spoke b = 0.
  mesh.positions.push_back({0, 0, varied(0)});
  const auto add = [&](int i, double a, double b) {
    const double t = turn * i, s = turn * (i + 1);
    mesh.positions.push_back({varied(a * std::cos(t) + b * std::cos(s)),
                              varied(a * std::sin(t) + b * std::sin(s)), varied(0.2 * (a + b))});
  };
  for (int i = 0; i < spokes; ++i) add(i, 1, 0), add(i, 2, 0);
  for (int i = 0; i < sectors; ++i) add(i, 1, 1), add(i, 2, 1), add(i, 1, 2), add(i, 2, 2);
  for (int i = 0; i < sectors; ++i) {
    const std::int32_t e = 1 + 2 * i, p = e + 1, e1 = 1 + 2 * ((i + 1) % spokes), p1 = e1 + 1;
    const std::int32_t f = 1 + 2 * spokes + 4 * i, g = f + 1, h = f + 2, r = f + 3;
    for (const auto& quad : {std::array{0, e, f, e1}, {e, p, g, f}, {f, g, r, h}, {e1, f, h, p1}})
      mesh.faces.push_back(quad);
  }
  return mesh;
}

}  // namespace

ControlMesh quad_cube() {
  ControlMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back({i & 1 ? 1. : -1., i & 2 ? 1. : -1., i & 4 ? 1. : -1.});
  for (const auto& quad :
       {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    mesh.faces.push_back(quad);
  return mesh;
}

ControlMesh quad_torus(int around, int across) {
  ControlMesh mesh;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
      mesh.positions.push_back(
          {(3 + std::cos(v)) * std::cos(u), (3 + std::cos(v)) * std::sin(u), std::sin(v)});
    }
  const auto at = [&](int i, int j) { return i % around * across + j % across; };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j)
      mesh.faces.push_back(std::array{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  return mesh;
}

ControlMesh quad_wheel(int n, std::uint64_t seed) {
  return two_rings(n, false, seed);
}

ControlMesh quad_fan(int faces, std::uint64_t seed) {
  return two_rings(faces, true, seed);
}

ControlMesh polygon_prism(int n) {
  ControlMesh mesh;
  for (int i = 0; i < 2 * n; ++i) {
    const double t = 2 * std::numbers::pi * (i % n) / n;
    mesh.positions.push_back({std::cos(t), std::sin(t), i < n ? -1. : 1.});
  }
  std::vector<std::int32_t> bottom, top;
  for (int i = 0; i < n; ++i) bottom.push_back(n - 1 - i), top.push_back(n + i);
  mesh.faces.push_back(bottom);
  mesh.faces.push_back(top);
  for (int i = 0; i < n; ++i) mesh.faces.push_back(std::array{i, (i + 1) % n, n + (i + 1) % n, n + i});
  return mesh;
}

ControlMesh dual(const ControlMesh& mesh) {
  ControlMesh result;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> face_of;  // of each directed edge
  const Triangles triangles = triangles_of(mesh);
  std::vector<std::int32_t> some_edge(mesh.positions.size(), -1);  // the vertex that an edge from v leads to
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto t = triangles[f];
    std::array<double, 3> middle{};
    for (std::size_t k = 0; k < 3; ++k) {
      face_of[{t[k], t[(k + 1) % 3]}] = static_cast<std::int32_t>(f);
      some_edge[static_cast<std::size_t>(t[k])] = t[(k + 1) % 3];
      for (std::size_t c = 0; c < 3; ++c) middle[c] += mesh.positions[static_cast<std::size_t>(t[k])][c] / 3;
    }
    result.positions.push_back(middle);
  }
  for (std::size_t v = 0; v < some_edge.size(); ++v) {
    if (some_edge[v] < 0) continue;
    const auto from = static_cast<std::int32_t>(v);
    std::vector<std::int32_t> corners;
    std::int32_t to = some_edge[v];
    do {
      const auto face = face_of.find({from, to});
      if (face == face_of.end()) throw ArgumentError("the dual is for closed meshes");
      corners.push_back(face->second);
      const auto t = triangles[static_cast<std::size_t>(face->second)];
      to = t[0] == from ? t[2] : t[1] == from ? t[0] : t[1];
    } while (to != some_edge[v]);
    result.faces.push_back(corners);
  }
  return result;
}

}  // namespace limitcheck::data
