// SPDX-License-Identifier: MIT
// OpenSubdiv's Bfr as fast as its own interface lets it be, for comparison: no door, no output arrays to
// fill.
#pragma once

#include <cstdint>
#include <memory>

#include "data/control_mesh.h"

namespace limitcheck::bench {

/// Position and unit normal in float of the points l1 = i/2^depth, l2 = j/2^depth of each face, into one
/// row-sized buffer that the next face overwrites. Points are counted per pair of faces, as row streaming
/// computes them: (2^depth + 1)^2 for two faces; Bfr evaluates (2^depth + 1)(2^depth + 2) for them.
class BfrPeer {
 public:
  explicit BfrPeer(const data::ControlMesh& mesh);
  ~BfrPeer();

  /// Surface of a face made, its points evaluated, all forgotten. `first`: from scratch, refiner and factory
  /// included.
  void stream(int depth);
  /// Limit stencils of all points, made once and kept.
  void cache_stencils(int depth);
  void apply_stencils();
  std::size_t stencil_bytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace limitcheck::bench
