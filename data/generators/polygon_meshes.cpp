// SPDX-License-Identifier: MIT
#include "data/generators/polygon_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "data/building_blocks.h"
#include "data/splitmix64.h"

namespace limitcheck::data {
namespace {

void require_faces(std::int64_t faces, int number, int least, const char* what) {
  require(number >= least, std::string(what) + " must be " + std::to_string(least) + " or more");
  require(faces <= kMostFaces, "more than 10 million faces");
}

ControlMesh with_rounded_positions(ControlMesh mesh) {
  for (auto& p : mesh.positions)
    for (double& x : p) x = rounded(x);
  return mesh;
}

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
  return with_rounded_positions(std::move(mesh));
}

// Profile of a pawn from the foot to the head: radius and height of each ring.
constexpr std::array<std::array<double, 2>, 13> kPawn{{{.55, 0},
                                                       {1, 0},
                                                       {1, .25},
                                                       {.8, .4},
                                                       {.6, .55},
                                                       {.4, 1},
                                                       {.32, 1.5},
                                                       {.6, 1.65},
                                                       {.6, 1.75},
                                                       {.34, 1.85},
                                                       {.5, 2.15},
                                                       {.5, 2.45},
                                                       {.28, 2.7}}};
constexpr int kRings = static_cast<int>(kPawn.size());
constexpr double kTop = 2.78;

// The rings of a pawn and the quads between them: vertex r * columns + i is in ring r.
ControlMesh lathe(int columns) {
  ControlMesh mesh;
  for (const auto& [radius, height] : kPawn)
    for (int i = 0; i < columns; ++i) {
      const double t = 2 * std::numbers::pi * i / columns;
      mesh.positions.push_back({radius * std::cos(t), radius * std::sin(t), height});
    }
  for (int r = 0; r + 1 < kRings; ++r)
    for (int i = 0; i < columns; ++i) {
      const int a = r * columns + i, b = r * columns + (i + 1) % columns;
      mesh.faces.push_back(std::array{a, b, b + columns, a + columns});
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
  require_faces(std::int64_t{around} * across, std::min(around, across), 3, "both numbers of quads");
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
  return with_rounded_positions(std::move(mesh));
}

ControlMesh quad_wheel(int n, std::uint64_t seed) {
  require_faces(std::int64_t{4} * n, n, 3, "the valence");
  return two_rings(n, false, seed);
}

ControlMesh quad_fan(int faces, std::uint64_t seed) {
  require_faces(std::int64_t{4} * faces, faces, 1, "the number of faces");
  return two_rings(faces, true, seed);
}

ControlMesh polygon_prism(int n) {
  require_faces(n, n, 3, "the number of sides");
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
  return with_rounded_positions(std::move(mesh));
}

ControlMesh dual(const ControlMesh& mesh) {
  ControlMesh result;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> face_of;  // of each directed edge
  std::vector<std::int32_t> some_edge(mesh.positions.size(), -1);  // the vertex that an edge from v leads to
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto face = mesh.faces[f];
    const std::size_t n = face.size();
    std::array<double, 3> middle{};
    for (std::size_t k = 0; k < n; ++k) {
      face_of[{face[k], face[(k + 1) % n]}] = static_cast<std::int32_t>(f);
      some_edge[static_cast<std::size_t>(face[k])] = face[(k + 1) % n];
      for (std::size_t c = 0; c < 3; ++c)
        middle[c] += mesh.positions[static_cast<std::size_t>(face[k])][c] / static_cast<double>(n);
    }
    result.positions.push_back(middle);
  }
  for (std::size_t v = 0; v < some_edge.size(); ++v) {
    if (some_edge[v] < 0) continue;
    const auto from = static_cast<std::int32_t>(v);
    std::vector<std::int32_t> corners;
    std::int32_t to = some_edge[v];
    do {
      const auto found = face_of.find({from, to});
      if (found == face_of.end()) throw ArgumentError("the dual is for closed meshes");
      corners.push_back(found->second);
      const auto face = mesh.faces[static_cast<std::size_t>(found->second)];
      const auto at = static_cast<std::size_t>(std::find(face.begin(), face.end(), from) - face.begin());
      to = face[(at + face.size() - 1) % face.size()];
    } while (to != some_edge[v]);
    result.faces.push_back(corners);
  }
  return with_rounded_positions(std::move(result));
}

ControlMesh pawn(int n) {
  require_faces(std::int64_t{2} * n * kRings, n, 3, "the valence of the poles");
  const int columns = 2 * n, last = (kRings - 1) * columns;
  ControlMesh mesh = lathe(columns);
  const auto foot = static_cast<std::int32_t>(mesh.positions.size()), head = foot + 1;
  mesh.positions.push_back({0, 0, 0});
  mesh.positions.push_back({0, 0, kTop});
  for (int i = 0; i < columns; i += 2) {
    const int middle = i + 1, next = (i + 2) % columns;
    mesh.faces.push_back(std::array{foot, next, middle, i});
    mesh.faces.push_back(std::array{head, last + i, last + middle, last + next});
  }
  return with_rounded_positions(std::move(mesh));
}

ControlMesh mixed_pawn(int n) {
  require_faces(std::int64_t{n} * kRings, n, 3, "the valence of the pole");
  const int last = (kRings - 1) * n;
  ControlMesh mesh = lathe(n);
  const auto head = static_cast<std::int32_t>(mesh.positions.size());
  mesh.positions.push_back({0, 0, kTop});
  std::vector<std::int32_t> foot;
  for (int i = 0; i < n; ++i) {
    foot.push_back(n - 1 - i);
    mesh.faces.push_back(std::array{head, last + i, last + (i + 1) % n});
  }
  mesh.faces.push_back(foot);
  return with_rounded_positions(std::move(mesh));
}

}  // namespace limitcheck::data
