// SPDX-License-Identifier: MIT
// A control mesh as the model keeps it, and its points and normals at one level. Private to it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "data/control_mesh.h"
#include "data/error.h"
#include "reference/loop/refine.h"
#include "reference/mesh/topology.h"
#include "verify/mutants/models/model_rules.h"
#include "verify/mutants/models/model_sides.h"

namespace limitcheck::verify {

struct ModelMesh {
  /// Throws data::ArgumentError: `control` has no faces or is no manifold.
  explicit ModelMesh(const data::ControlMesh& control);

  /// The face beyond the edge from corner k to the next, or -1.
  std::int32_t neighbour(std::size_t face, int k) const;
  /// The depth of that face; if there is none or it is culled, the depth of face f itself.
  int neighbour_depth(std::span<const std::int32_t> depth, std::size_t face, int k) const;

  data::ControlMesh control;
  reference::Topology topology;
  double size = 0, largest = 0;  // diagonal of the box, largest coordinate
};

/// Points and normals at the vertices of the deepest level.
struct ModelLevel {
  reference::RefinedMesh<double> mesh;  // where they are: its own points are not used
  std::vector<ModelRules::V> points, limits, normals;
  std::map<std::int32_t, ModelLimit> sides;  // of vertices that have more than one normal

  /// Of a lattice point at (i, j) of a face, seen from that face.
  const ModelRules::V& normal(std::size_t face, int i, int j) const;

  /// `shown` are the depths of the frame, -1 for culled faces.
  ModelLevel(const ModelMesh& from, const ModelRules& rules, int depth, std::span<const std::int32_t> shown);
};

}  // namespace limitcheck::verify
