// SPDX-License-Identifier: MIT
// The cost of a kernel, counted by running it: operations by kind, and vectors stored.
#pragma once

#include <cstdint>

#include "data/control_mesh.h"

namespace limitcheck::verify {

/// Arithmetic on coordinates. A fused multiply-add is one operation and two flops; comparisons, copies and
/// sign changes are none.
struct OperationCounts {
  std::int64_t additions = 0;  ///< and subtractions
  std::int64_t multiplications = 0, fused = 0, divisions = 0, roots = 0;

  std::int64_t operations() const { return additions + multiplications + fused + divisions + roots; }
  std::int64_t flops() const { return operations() + fused; }

  friend OperationCounts operator+(const OperationCounts& a, const OperationCounts& b) {
    return {a.additions + b.additions, a.multiplications + b.multiplications, a.fused + b.fused,
            a.divisions + b.divisions, a.roots + b.roots};
  }
  friend OperationCounts operator-(const OperationCounts& a, const OperationCounts& b) { return a + -1 * b; }
  friend OperationCounts operator*(std::int64_t k, const OperationCounts& a) {
    return {k * a.additions, k * a.multiplications, k * a.fused, k * a.divisions, k * a.roots};
  }
  friend bool operator==(const OperationCounts&, const OperationCounts&) = default;
};

/// The cost of one pair of faces, position and unit normal of its (2^depth + 1)^2 points. What is done once
/// per control vertex (the prepass) is apart.
struct KernelCost {
  OperationCounts operations;
  OperationCounts prepass;  ///< of all control vertices of the mesh
  std::int64_t points = 0;  ///< distinct limit points of the pair
  std::int64_t limits = 0;  ///< limit points evaluated
  /// Triples written on the way: points, copies in rings, and the points and normals that row streaming
  /// keeps.
  std::int64_t stored_vectors = 0;

  double flops_per_point() const {
    return static_cast<double>(operations.flops()) / static_cast<double>(points);
  }
  double vectors_per_point() const {
    return static_cast<double>(stored_vectors) / static_cast<double>(points);
  }
};

enum class CountedKernel : std::uint8_t {
  kSlidingWindow,         ///< as shipped: the limits of a row are carried to the next strip
  kSlidingWindowPrinted,  ///< as the paper prints it: both rows of every strip are evaluated [C51]
  kRowStream
};

/// Runs the shipped kernel on the pair of half-edge 0, which needs a twin. Exact and the same on every
/// machine: it depends on the topology and the depth alone (positions must not make tangents vanish).
KernelCost count_operations(CountedKernel kernel, const data::ControlMesh& mesh, int depth);

}  // namespace limitcheck::verify
