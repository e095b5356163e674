// SPDX-License-Identifier: MIT
// Control meshes of either scheme, of all valences and boundaries, without and with sharp edges. For tests.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "data/generators/bumpy_sphere.h"
#include "data/generators/named_mesh.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "data/shapes.h"
#include "verify/projection/surface_lattice.h"

namespace limitcheck::verify::test {

struct TestMesh {
  std::string name;
  data::ControlMesh mesh;
  data::Scheme scheme;
};

/// Of names, each of the scheme that it is meant for.
inline std::vector<TestMesh> meshes_named(const std::vector<std::string>& names) {
  std::vector<TestMesh> all;
  for (const std::string& name : names) {
    data::ControlMesh mesh = data::named_mesh(name);
    const data::Scheme scheme = data::natural_scheme(mesh);
    all.push_back({name, std::move(mesh), scheme});
  }
  return all;
}

/// The stock shapes, and some more of triangles.
inline std::vector<TestMesh> loop_meshes() {
  std::vector<std::string> names = data::stock_shapes();
  names.insert(names.end(), {"bumpy:20", "bumpy:200", "wheel:17", "fan:9"});
  return meshes_named(names);
}

inline double largest_deviation(const SurfaceLattice& lattice) {
  double largest = 0;
  for (std::size_t t = 0; t < lattice.size(); ++t) largest = std::max(largest, lattice.deviation(t));
  return largest;
}

inline std::vector<TestMesh> quad_meshes() {
  constexpr auto kQuads = data::Scheme::kCatmullClark;
  std::vector<TestMesh> all{{"quad cube", data::quad_cube(), kQuads},
                            {"quad torus", data::quad_torus(4, 3), kQuads}};
  for (const int n : {3, 5, 6, 8, 12})
    all.push_back({"wheel " + std::to_string(n), data::quad_wheel(n, 1), kQuads});
  for (int k = 1; k <= 6; ++k) all.push_back({"fan " + std::to_string(k), data::quad_fan(k, 1), kQuads});
  for (const int n : {3, 5, 7}) all.push_back({"prism " + std::to_string(n), data::polygon_prism(n), kQuads});
  all.push_back({"triangles", data::octahedron(), kQuads});
  all.push_back({"dual", data::dual(data::bumpy_sphere(40, 1)), kQuads});
  return all;
}

inline std::vector<TestMesh> sharp_meshes() {
  constexpr auto kLoop = data::Scheme::kLoop, kQuads = data::Scheme::kCatmullClark;
  std::vector<TestMesh> all;
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
