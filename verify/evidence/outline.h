// SPDX-License-Identifier: MIT
// The boundary that the visible faces of a control mesh must have.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "verify/evidence/evidence.h"

namespace limitcheck::verify {

/// The control edges with one visible face. Faces that meet in a control vertex only, because those between
/// them are culled, are no fault: such a vertex counts once for each fan of visible faces.
class Outline {
 public:
  /// The evidence's lattice outlives this.
  explicit Outline(const Evidence& e);

  /// One visible face along one control edge, in the direction in which the face runs along it. The depth of
  /// the side is at least that of the face and at most that of the deepest visible neighbour.
  struct Side {
    std::int32_t face;
    int corner;  // the side begins here
    int least, most;
  };
  const std::vector<Side>& sides() const { return sides_; }

  /// All steps a side may take: sorted by from, to.
  struct Step {
    Lattice::Id from, to;
    std::int32_t side;
    int depth;
  };
  const std::vector<Step>& steps() const { return steps_; }

  /// Closed walks along the sides.
  std::int64_t loops() const { return loops_; }

  /// Which fan round its corner k a visible face belongs to: 0, or 1, 2 .. if culled faces part them.
  int fan(std::int32_t face, int k) const { return fan_[lattice_.corner_number(face, k)]; }

 private:
  void find_fans(const Evidence& e);
  void count_loops();

  const Lattice& lattice_;
  std::vector<Side> sides_;
  std::vector<Step> steps_;
  std::int64_t loops_ = 0;
  std::vector<std::int32_t> fan_;  // of each corner of a face
};

}  // namespace limitcheck::verify
