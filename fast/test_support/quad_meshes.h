// SPDX-License-Identifier: MIT
// For the tests of fast/: meshes of quads with every valence and boundary that row streaming tells apart.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "data/generators/polygon_meshes.h"
#include "fast/test_support/shared_points.h"

namespace limitcheck::fast::row_stream {

/// A closed mesh with two vertices of valence n, which are opposite corners of n quads each; 2n of valence 3.
inline data::ControlMesh trapezohedron(int n) {
  data::ControlMesh mesh;
  const double pi = std::numbers::pi;
  for (int k = 0; k < 2 * n; ++k) {
    const double t = pi * k / n;
    mesh.positions.push_back({std::cos(t), std::sin(t), k % 2 == 0 ? .2 : -.2});
  }
  mesh.positions.push_back({0, 0, 1});
  mesh.positions.push_back({0, 0, -1});
  for (int k = 0; k < 2 * n; k += 2) {
    const int a = k, b = (k + 1) % (2 * n), c = (k + 2) % (2 * n), d = (k + 3) % (2 * n);
    mesh.faces.push_back({2 * n, a, b, c});
    mesh.faces.push_back({b, 2 * n + 1, d, c});
  }
  return mesh;
}

/// rows x columns quads; without boundary in either direction if `closed`.
inline data::ControlMesh quad_sheet(int rows, int columns) {
  data::ControlMesh mesh;
  for (int i = 0; i <= rows; ++i) {
    for (int j = 0; j <= columns; ++j)
      mesh.positions.push_back({1. * j, 1. * i, .3 * std::sin(1. * j) * std::cos(1.3 * i)});
  }
  const auto at = [&](int i, int j) { return static_cast<std::int32_t>(i * (columns + 1) + j); };
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j)
      mesh.faces.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
  return mesh;
}

inline std::vector<NamedMesh> closed_meshes() {
  std::vector<NamedMesh> meshes{{"cube", data::quad_cube()},
                                {"shaken cube", shaken(data::quad_cube(), .3, 1)},
                                {"torus", data::quad_torus(4, 3)},
                                {"shaken torus", shaken(data::quad_torus(6, 4), .1, 2)}};
  for (const int n : {3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 20, 50})
    meshes.push_back({"trapezohedron " + std::to_string(n), shaken(trapezohedron(n), n > 12 ? .01 : .05, 3)});
  meshes.push_back({"pinched torus", pinched(shaken(data::quad_torus(9, 6), .1, 5))});
  for (const int n : {3, 5, 8})
    meshes.push_back({"pawn " + std::to_string(n), shaken(data::pawn(n), .01, 4)});
  return meshes;
}

inline std::vector<NamedMesh> open_meshes() {
  std::vector<NamedMesh> meshes{{"quad", shaken(quad_sheet(1, 1), .1, 1)},
                                {"strip", shaken(quad_sheet(1, 3), .1, 2)},
                                {"sheet", shaken(quad_sheet(4, 5), .1, 3)},
                                {"flat sheet", quad_sheet(3, 3)},
                                {"pinched sheet", pinched(shaken(quad_sheet(6, 7), .1, 4))}};
  for (const int n : {3, 4, 5, 9, 50})
    meshes.push_back({"wheel " + std::to_string(n), data::quad_wheel(n, 5)});
  for (const int n : {1, 2, 3, 4, 5}) meshes.push_back({"fan " + std::to_string(n), data::quad_fan(n, 6)});
  return meshes;
}

}  // namespace limitcheck::fast::row_stream
