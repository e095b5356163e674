// SPDX-License-Identifier: MIT
// Small control meshes for the unit tests of this folder.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "data/splitmix64.h"

namespace limitcheck::fast {

struct NamedMesh {
  std::string name;
  data::ControlMesh mesh;
};

/// Moves every vertex by up to `amount`, rounded to float.
inline data::ControlMesh shaken(data::ControlMesh mesh, double amount, std::uint64_t seed) {
  data::SplitMix64 random(seed);
  for (auto& p : mesh.positions) {
    for (double& x : p) x = static_cast<float>(x + amount * (2 * random.unit() - 1));
  }
  return mesh;
}

/// One depth for each face, uniform in least .. most.
inline std::vector<std::int32_t> random_depths(std::size_t faces, int least, int most,
                                               data::SplitMix64& random) {
  std::vector<std::int32_t> depth(faces);
  for (auto& d : depth)
    d = least + static_cast<std::int32_t>(random.next() % static_cast<std::uint64_t>(most - least + 1));
  return depth;
}
inline std::vector<std::int32_t> random_depths(std::size_t faces, int least, int most, std::uint64_t seed) {
  data::SplitMix64 random(seed);
  return random_depths(faces, least, most, random);
}

inline data::ControlMesh single_triangle() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
}

inline data::ControlMesh tetrahedron() {
  return {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
}

/// Two apexes over an n-gon; bipyramid(4) is the octahedron.
inline data::ControlMesh bipyramid(int n) {
  data::ControlMesh mesh;
  for (int i = 0; i < n; ++i) {
    const double t = 2 * std::numbers::pi * i / n;
    mesh.positions.push_back({std::cos(t), std::sin(t), 0});
  }
  mesh.positions.push_back({0, 0, 1});
  mesh.positions.push_back({0, 0, -1});
  for (std::int32_t i = 0; i < n; ++i) {
    const std::int32_t j = (i + 1) % n;
    mesh.faces.push_back({i, j, n});
    mesh.faces.push_back({j, i, n + 1});
  }
  return mesh;
}

inline data::ControlMesh octahedron() {
  return bipyramid(4);
}

/// A disc of n triangles round vertex n (z = height there).
inline data::ControlMesh wheel(int n, double height = 0) {
  data::ControlMesh mesh = bipyramid(n);
  mesh.positions.pop_back();
  mesh.positions.back() = {0, 0, height};
  data::ControlMesh upper{mesh.positions, {}};
  for (std::size_t i = 0; i < mesh.faces.size(); i += 2) upper.faces.push_back(mesh.faces[i]);
  return upper;
}

/// n triangles round the boundary vertex n + 1.
inline data::ControlMesh fan(int n) {
  data::ControlMesh mesh;
  for (int i = 0; i <= n; ++i) {
    const double t = std::numbers::pi * i / n;
    mesh.positions.push_back({std::cos(t), std::sin(t), .2 * std::sin(3 * t)});
  }
  mesh.positions.push_back({0, 0, 0});
  for (std::int32_t i = 0; i < n; ++i) mesh.faces.push_back({i, i + 1, n + 1});
  return mesh;
}

/// rows x columns quads, two triangles each, over z = .2 sin x cos y.
inline data::ControlMesh grid_sheet(int rows, int columns) {
  data::ControlMesh mesh;
  for (int i = 0; i <= rows; ++i) {
    for (int j = 0; j <= columns; ++j)
      mesh.positions.push_back({1. * j, 1. * i, .2 * std::sin(1. * j) * std::cos(1. * i)});
  }
  const auto at = [&](int i, int j) { return static_cast<std::int32_t>(i * (columns + 1) + j); };
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      mesh.faces.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      mesh.faces.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
  return mesh;
}

/// All valences 6, closed; rows, columns >= 3.
inline data::ControlMesh grid_torus(int rows, int columns) {
  data::ControlMesh mesh;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const double u = 2 * std::numbers::pi * i / rows, w = 2 * std::numbers::pi * j / columns;
      mesh.positions.push_back(
          {(2 + std::cos(u)) * std::cos(w), (2 + std::cos(u)) * std::sin(w), std::sin(u)});
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::int32_t>((i % rows) * columns + j % columns); };
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      mesh.faces.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      mesh.faces.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
  return mesh;
}

/// A grid_torus, or what was made of one, with each ninth diagonal the other way: regular pairs beside others.
inline data::ControlMesh flipped(const data::ControlMesh& torus) {
  data::ControlMesh mesh{torus.positions, {}};
  for (std::size_t f = 0; f < torus.faces.size(); f += 2) {
    const std::int32_t a = torus.faces[f][0], b = torus.faces[f][1], c = torus.faces[f][2],
                       d = torus.faces[f + 1][2];
    if (f % 18 == 0) {
      mesh.faces.push_back({a, b, d}), mesh.faces.push_back({b, c, d});
    } else {
      mesh.faces.push_back({a, b, c}), mesh.faces.push_back({a, c, d});
    }
  }
  return mesh;
}

}  // namespace limitcheck::fast
