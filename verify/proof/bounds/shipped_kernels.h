// SPDX-License-Identifier: MIT
// The float kernels as they ship: with unit normals, and row streaming on every vector target of this machine.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "fast/rules/surface_vertex.h"
#include "verify/proof/bounds/bounds.h"

namespace limitcheck::verify {

using FloatPoints = std::vector<fast::Vec3<float>>;

/// What a kernel delivers of several control meshes of one topology.
struct Delivery {
  /// Of each mesh, in the order of LinearRuns; of row streaming from the scalar code.
  std::vector<std::vector<fast::SurfaceVertex<float>>> vertices;
  std::string targets;  ///< of row streaming: the names of all that ran, in the order of kernels()
  std::string unlike;   ///< the first whose bits are not those of the scalar code; empty: there is none
};

/// Runs the shipped code, without a placement. A batch has all meshes in its lanes, each block of four lanes in
/// another order, so that lanes and blocks that change places show.
///   meshes   positions of the neighbourhood's vertices, at least one mesh
Delivery deliver(BoundedKernel kernel, const Neighbourhood& neighbourhood,
                 std::span<const FloatPoints> meshes, int depth);

}  // namespace limitcheck::verify
