// SPDX-License-Identifier: MIT
// The options of a tessellator, and the statistics of a frame.
#pragma once

#include <cstdint>

#include "data/scheme.h"
#include "fast/plan/crack.h"
#include "fast/plan/depth.h"
#include "fast/plan/pairing.h"

namespace limitcheck::fast {

/// The options of a tessellator, the same for all frames of a mesh.
struct TessellatorOptions {
  CrackOptions cracks;
  int max_depth = 5;        // the largest depth a strategy assigns; depths given by hand may be deeper
  int threads = 0;          // at most so many, 0: all. The output does not depend on it.
  bool provenance = false;  // fill the provenance of every vertex
  data::Scheme scheme = data::Scheme::kLoop;
};

/// What one frame did, and how long it took.
struct FrameStats {
  std::int64_t faces = 0, culled = 0;
  std::int64_t pairs = 0, singletons = 0;  // pairs of two; faces without partner
  std::int64_t fans = 0, stitched = 0;     // faces repaired (their pairs count above as well)
  std::int64_t strips = 0, draws = 0;
  std::int64_t triangles = 0, vertices = 0;  // as delivered
  std::int64_t limit_points = 0;             // evaluated in windows, along edges and at centres
  std::int64_t zero_normals = 0;  // vertices whose normal came from the rule for vanishing tangents
  double seconds_heuristics = 0, seconds_pairing = 0, seconds_planning = 0, seconds_evaluation = 0;
  double seconds_total = 0;
};

}  // namespace limitcheck::fast
