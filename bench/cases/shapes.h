// SPDX-License-Identifier: MIT
// The control meshes that benchmarks time, by the names that their cases carry.
#pragma once

#include <string>

#include "data/control_mesh.h"

namespace limitcheck::bench {

struct Shape {
  std::string
      name;   // bumpy: triangles; quads, half-regular, regular: quads of which none, half, all are regular
  int faces;  // at most a few fewer
};

/// Made when first asked for, and kept. Not by several threads at once.
const data::ControlMesh& mesh_of(const Shape& shape);

/// "row-stream/avx2/steady/bumpy/faces:1000/depth:3/threads:1"
std::string full_name(const std::string& route, const std::string& use, const Shape& shape, int depth,
                      int threads);

}  // namespace limitcheck::bench
