// SPDX-License-Identifier: MIT
// Crack prevention between faces of different depth. [mueller2000, section 5]
#pragma once

#include <cstdint>
#include <vector>

namespace limitcheck::fast {

/// How faces with deeper neighbours are repaired.
enum class Repair : std::uint8_t {
  kFan,     // the paper's: a fan around the centre, no interior points
  kStitch,  // ours: keep the interior points, stitch the outer ring (a fan below depth 2, which has none)
  kNone     // leave the cracks
};

/// Where the middle of a fan lies.
enum class FanCentre : std::uint8_t {
  kLimit,       // the limit position of (1/3, 1/3, 1/3)
  kFlatLimit,   // centroid of the three corners' limit positions
  kFlatControl  // centroid of the control triangle [C62]
};

/// How cracks are closed; the defaults leave none.
struct CrackOptions {
  Repair repair = Repair::kFan;
  FanCentre centre = FanCentre::kLimit;
};

/// How a face is displayed.
enum class Display : std::uint8_t {
  kNothing,  // it is culled, or nobody's partner
  kStrips,   // in strips of its whole lattice
  kFan,      // as Repair::kFan says
  kStitch    // as Repair::kStitch says
};

/// How each face is displayed, and the depth of each of its edges.
struct CrackPlan {
  std::vector<std::int8_t> edge_depth;  // one per side of each face, from corner k to k + 1; -1 if culled
  std::vector<Display> display;         // per face
  std::int64_t fans = 0, stitched = 0;
};

}  // namespace limitcheck::fast
