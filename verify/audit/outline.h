// SPDX-License-Identifier: MIT
// The border that the visible faces of a control mesh must show, and no other.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "verify/audit/evidence.h"

namespace limitcheck::verify {

/// The control edges with one visible face. Faces that meet in a control vertex only, because those between
/// them are culled, are no fault: such a vertex counts once for each fan of visible faces.
class Outline {
 public:
  explicit Outline(const Evidence& e);

  /// The border of one visible face along one control edge, in the direction in which the face runs along it.
  /// Its depth is at least that of the face; it may be as large as that of a visible neighbour.
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
  int fan(std::int32_t face, int k) const { return fan_[3 * static_cast<std::size_t>(face) + k]; }

 private:
  void find_fans(const Evidence& e);
  void count_loops(const Evidence& e);

  std::vector<Side> sides_;
  std::vector<Step> steps_;
  std::int64_t loops_ = 0;
  std::vector<std::int32_t> fan_;  // three for each face
};

}  // namespace limitcheck::verify
