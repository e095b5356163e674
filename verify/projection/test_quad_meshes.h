// SPDX-License-Identifier: MIT
// Control meshes of quads and other polygons, of all valences and boundaries. For tests.
#pragma once

#include <string>
#include <vector>

#include "data/generators/bumpy_sphere.h"
#include "data/generators/polygon_meshes.h"
#include "data/shapes.h"

namespace limitcheck::verify::test {

struct QuadMesh {
  std::string name;
  data::ControlMesh mesh;
};

inline std::vector<QuadMesh> quad_meshes() {
  std::vector<QuadMesh> all{{"quad cube", data::quad_cube()}, {"quad torus", data::quad_torus(4, 3)}};
  for (const int n : {3, 5, 6, 8, 12}) all.push_back({"wheel " + std::to_string(n), data::quad_wheel(n, 1)});
  for (int k = 1; k <= 6; ++k) all.push_back({"fan " + std::to_string(k), data::quad_fan(k, 1)});
  for (const int n : {3, 5, 7}) all.push_back({"prism " + std::to_string(n), data::polygon_prism(n)});
  all.push_back({"triangles", data::octahedron()});
  all.push_back({"dual", data::dual(data::bumpy_sphere(40, 1))});
  return all;
}

}  // namespace limitcheck::verify::test
