// SPDX-License-Identifier: MIT
// Control meshes for the tests of this folder, written out so that the door is tested on nothing but itself.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "data/control_mesh.h"

namespace limitcheck::verify::test {

inline data::ControlMesh tetrahedron() {
  return {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1.25}},
          {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
}

inline data::ControlMesh octahedron() {
  return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1.1}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

/// n triangles round an interior vertex; the rim has boundary vertices of two triangles.
inline data::ControlMesh disc(int n) {
  data::ControlMesh mesh{{{0, 0, 0.5}}, {}};
  for (int k = 0; k < n; ++k) {
    const double angle = 6.283185307179586 * k / n;
    mesh.positions.push_back({std::cos(angle), std::sin(angle), 0.1 * std::cos(3 * angle)});
    mesh.triangles.push_back({0, 1 + k, 1 + (k + 1) % n});
  }
  return mesh;
}

/// n triangles round a vertex of the boundary; the two ends have one triangle.
inline data::ControlMesh fan(int n) {
  data::ControlMesh mesh{{{0, 0, 0.25}}, {}};
  for (int k = 0; k <= n; ++k) {
    const double angle = 3.0 * k / n;
    mesh.positions.push_back({std::cos(angle), std::sin(angle), 0.1 * (k % 2)});
    if (k > 0) mesh.triangles.push_back({0, k, k + 1});
  }
  return mesh;
}

/// n triangles in a row, all vertices on the boundary, with one to three triangles each.
inline data::ControlMesh strip(int n) {
  data::ControlMesh mesh;
  for (int k = 0; k < n + 2; ++k) mesh.positions.push_back({0.5 * k, k % 2 == 0 ? 0.0 : 1.0, 0.1 * (k % 3)});
  for (int k = 0; k < n; ++k) {
    mesh.triangles.push_back(k % 2 == 0 ? std::array<std::int32_t, 3>{k, k + 2, k + 1}
                                        : std::array<std::int32_t, 3>{k, k + 1, k + 2});
  }
  return mesh;
}

inline std::vector<std::pair<std::string, data::ControlMesh>> shapes() {
  return {{"tetrahedron", tetrahedron()},
          {"octahedron", octahedron()},
          {"disc 7", disc(7)},
          {"disc 3", disc(3)},
          {"fan 5", fan(5)},
          {"strip 6", strip(6)},
          {"triangle", fan(1)}};
}

}  // namespace limitcheck::verify::test
