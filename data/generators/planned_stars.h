// SPDX-License-Identifier: MIT
// The stars of the audit without meshes: every kind of neighbourhood, as few meshes as possible.
#pragma once

#include <vector>

namespace limitcheck::data {

/// Mesh k is called "stars:k", from 1 on, or "quad-stars:k".
struct PlannedStars {
  const char* stars;   ///< as parse_stars() reads it (star_meshes.h)
  int depth;           ///< at which the audit asks for it ..
  const char* depths;  ///< .. and how the depths of its faces are chosen, as --depths takes it
};
/// Found by `limitcheck_make_plan` (verify/audit/cover.h).
const std::vector<PlannedStars>& planned_stars(bool triangles);

}  // namespace limitcheck::data
