// SPDX-License-Identifier: MIT
// Quads one by one, as the engine's kernels compute them: a lattice per level, and the rings of the four
// corners beside it. In double; with one fault of a kernel, if asked for.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "data/control_mesh.h"
#include "fast/mesh/cut_mesh.h"
#include "fast/rules/quad_limit.h"
#include "fast/rules/quad_star.h"
#include "fast/rules/surface_vertex.h"
#include "verify/mutants/models/model_rules.h"

namespace limitcheck::verify {

/// Faults that only a kernel of quads can have: lattices, rings, borders and bits.
std::span<const Mutation> quad_kernel_mutations();

/// Every rule has the same bits under quarter turns, so points that quads share are equal: all corners come
/// from the star of the vertex, all others from the lattice.
class QuadKernelModel {
 public:
  using Point = fast::Vec3<double>;
  using Vertex = fast::SurfaceVertex<double>;

  /// Throws SubjectError: something is semi-sharp, which row streaming leaves to the rules of the sliding window.
  QuadKernelModel(const data::ControlMesh& mesh, std::string_view mutation);

  /// Point (i, j) of n = 2^level steps of a control face, or of the sub-quad at `part` of one that is no quad,
  /// whose steps are n / 2; level is one more than is displayed. The points of a face are computed at once and
  /// kept.
  Vertex at(std::size_t face, std::int32_t part, std::int64_t i, std::int64_t j, int level);

 private:
  struct Grid {
    int depth = -1;
    std::vector<Vertex> points;  // row by row
  };
  class Lattice;

  bool is(std::string_view name) const { return mutation_ == name; }
  const Grid& grid(std::int32_t quad, int depth);

  std::string_view mutation_;
  fast::QuadMesh mesh_;
  std::vector<std::size_t> first_corner_;  // of each control face, and its number of corners
  std::vector<std::size_t> corners_;
  std::vector<Grid> grids_;
};

}  // namespace limitcheck::verify
