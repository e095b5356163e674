// SPDX-License-Identifier: MIT
// A small control mesh whose topology and geometry the bytes of a fuzzer decide.
#pragma once

#include <fuzzer/FuzzedDataProvider.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "data/control_mesh.h"
#include "data/generators/random_mesh.h"
#include "data/shapes.h"

namespace limitcheck::verify {

inline data::ControlMesh shape_from_bytes(FuzzedDataProvider& bytes) {
  const int n = bytes.ConsumeIntegralInRange(0, 15);
  const int valence = n == 15 ? 80 : 3 + n;  // some vertices have very many faces
  switch (bytes.ConsumeIntegralInRange(0, 11)) {
    case 0:
      return data::tetrahedron();
    case 1:
      return data::icosahedron();
    case 2:
      return data::bipyramid(valence);
    case 3:
      return data::wheel(valence, 1);
    case 4:
      return data::fan(valence - 2, 1);
    case 5:
      return data::sheet(1 + n % 4, 1 + n / 4);
    case 6:
      return data::strip(1 + n);
    case 7:
      return data::triangle();
    case 8:
      return data::torus(3 + n % 4, 3 + n / 4);
    case 9:
      return data::cube();
    case 10:
      return data::two_components();
    default:
      return data::random_mesh(bytes.ConsumeIntegral<std::uint16_t>(), {.faces = 4 + 4 * n});
  }
}

/// Perhaps not valid: the caller asks data::validate.
inline data::ControlMesh mesh_from_bytes(FuzzedDataProvider& bytes) {
  data::ControlMesh mesh = shape_from_bytes(bytes);
  std::vector<std::array<std::int32_t, 3>> triangles = data::triangles_of(mesh).to_vector();

  // Faces go, are split in three or have an edge flipped.
  for (int edits = bytes.ConsumeIntegralInRange(0, 12); edits > 0 && triangles.size() > 1; --edits) {
    const auto f = bytes.ConsumeIntegralInRange<std::size_t>(0, triangles.size() - 1);
    const std::array<std::int32_t, 3> t = triangles[f];
    const int kind = bytes.ConsumeIntegralInRange(0, 2);
    if (kind == 0) {
      triangles.erase(triangles.begin() + static_cast<std::ptrdiff_t>(f));
    } else if (kind == 1) {
      const auto centre = static_cast<std::int32_t>(mesh.positions.size());
      std::array<double, 3> p{};
      for (int axis = 0; axis < 3; ++axis)
        p[axis] = (mesh.positions[t[0]][axis] + mesh.positions[t[1]][axis] + mesh.positions[t[2]][axis]) / 4;
      mesh.positions.push_back(p);
      triangles[f] = {t[0], t[1], centre};
      triangles.push_back({t[1], t[2], centre});
      triangles.push_back({t[2], t[0], centre});
    } else {
      for (std::array<std::int32_t, 3>& other : triangles)
        for (int k = 0; k < 3; ++k)
          if (other[k] == t[1] && other[(k + 1) % 3] == t[0]) {
            const std::int32_t beyond = other[(k + 2) % 3];
            other = {beyond, t[1], t[2]};
            triangles[f] = {t[0], beyond, t[2]};
            k = 3;
          }
    }
  }
  // Vertices without a face go, too.
  std::vector<std::int32_t> name(mesh.positions.size(), -1);
  std::vector<std::array<double, 3>> kept;
  for (std::array<std::int32_t, 3>& t : triangles)
    for (std::int32_t& v : t) {
      if (name[v] < 0) {
        name[v] = static_cast<std::int32_t>(kept.size());
        kept.push_back(mesh.positions[v]);
      }
      v = name[v];
    }
  mesh.positions = std::move(kept);
  mesh.faces = data::Faces(triangles);

  // Geometry: shaken, on a coarse grid, flat, far away, huge, tiny.
  const int kind = bytes.ConsumeIntegralInRange(0, 6);
  const bool shake = bytes.ConsumeBool();
  for (auto& p : mesh.positions)
    for (double& x : p) {
      if (shake) x += bytes.ConsumeIntegral<std::int8_t>() / 64.;
      if (kind == 1) x = std::round(x * 2) / 2;
      if (kind == 2) x = 0;
      if (kind == 3) x += 1000;
      if (kind == 4) x = std::ldexp(x, 60);
      if (kind == 5) x = std::ldexp(x, -60);
      x = static_cast<double>(static_cast<float>(x));
    }
  return mesh;
}

}  // namespace limitcheck::verify
