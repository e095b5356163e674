// SPDX-License-Identifier: MIT
// Control meshes with sharp edges and vertices, of both schemes. For tests.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "data/generators/bumpy_sphere.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "data/shapes.h"

namespace limitcheck::verify::test {

struct SharpMesh {
  std::string name;
  data::ControlMesh mesh;
  data::Scheme scheme;
};

inline std::vector<SharpMesh> sharp_meshes() {
  constexpr auto kLoop = data::Scheme::kLoop, kQuads = data::Scheme::kCatmullClark;
  std::vector<SharpMesh> all;
  const auto add = [&](std::string name, data::ControlMesh mesh, data::Scheme scheme) {
    all.push_back({std::move(name), std::move(mesh), scheme});
  };
  const auto sharpened = [](data::ControlMesh mesh, float sharpness) {
    for (data::SharpEdge& e : mesh.sharpness.edges) e.sharpness = sharpness;
    return mesh;
  };
  for (const int s : {1, 2, 10}) add("cube " + std::to_string(s), data::creased_cube(s), kQuads);
  for (const float s : {.5F, 1.5F, 3.F})
    add("cube " + std::to_string(s), sharpened(data::creased_cube(1), s), kQuads);
  for (const int n : {3, 4, 5, 7}) {
    add("dart " + std::to_string(n), data::dart(n, false), kQuads);
    add("dart " + std::to_string(n) + " of triangles", data::dart(n, true), kLoop);
  }
  for (const int k : {2, 3}) {
    add("corner " + std::to_string(k), data::corner(k, false), kQuads);
    add("corner " + std::to_string(k) + " of triangles", data::corner(k, true), kLoop);
  }
  for (const float s : {.5F, 2.25F})
    add("dart of triangles " + std::to_string(s), sharpened(data::dart(5, true), s), kLoop);
  add("ring 10", data::crease_ring(10), kQuads);
  add("ring 2.3", data::crease_ring(2, 3), kQuads);
  data::ControlMesh cone = data::quad_cube();
  cone.sharpness.vertices.push_back({0, 10});
  add("cone", cone, kQuads);
  data::ControlMesh fan = data::quad_fan(1, 1);
  fan.sharpness.boundary = data::Boundary::kEdgeAndCorner;
  add("corners kept", fan, kQuads);
  data::ControlMesh prism = data::with_random_sharpness(data::polygon_prism(5), 3);
  add("random prism", prism, kQuads);
  for (const int seed : {1, 2}) {
    add("random quads " + std::to_string(seed),
        data::with_random_sharpness(data::dual(data::bumpy_sphere(40, 1)), seed), kQuads);
    add("random triangles " + std::to_string(seed),
        data::with_random_sharpness(data::bumpy_sphere(40, 1), seed), kLoop);
  }
  return all;
}

}  // namespace limitcheck::verify::test
