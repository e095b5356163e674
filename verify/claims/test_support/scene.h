// SPDX-License-Identifier: MIT
// A mesh with what the heuristics of section 4.1 need of it.
#pragma once

#include <cstdint>
#include <utility>

#include "data/generators/bumpy_sphere.h"
#include "fast/plan/depth.h"

namespace limitcheck::verify {

struct Scene {
  explicit Scene(data::ControlMesh m, int max_depth = 5)
      : mesh(std::move(m)), adjacency(mesh), heuristics(mesh, adjacency, max_depth) {}
  explicit Scene(int faces, std::uint64_t seed = 1, int max_depth = 5)
      : Scene(data::bumpy_sphere(faces, seed), max_depth) {}

  data::ControlMesh mesh;
  fast::Adjacency adjacency;
  fast::DepthHeuristics heuristics;
};

}  // namespace limitcheck::verify
