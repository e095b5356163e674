// SPDX-License-Identifier: MIT
// The index patterns of patches, each made once: the strips of a depth, fans, faces with stitched rings.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "fast/frame/patch.h"
#include "fast/frame/patch_mesh.h"
#include "fast/plan/depth.h"

namespace limitcheck::fast {

/// A pattern: indices first .. first + count - 1.
struct IndexPattern {
  std::uint32_t first = 0, count = 0;
  std::int32_t triangles = 0;
};

/// Makes patterns where they are asked for first; they are appended to a list.
class PatchIndices {
 public:
  /// The parts of a face; or both halves of a grid, face0's triangles first.
  IndexPattern strips(const ShownFace& shown, int depth, IndexForm form, std::vector<std::uint32_t>& out);
  /// The centre, then `border` points, then the triangles between them, the last of which ends at the first point.
  IndexPattern fan(int border, std::vector<std::uint32_t>& out);
  /// The corners of a face by themselves.
  IndexPattern corners(int sides, std::vector<std::uint32_t>& out);
  /// A face of a patch whose inside is kept and whose outer ring is stitched to its border, the points of which follow
  /// those of its parts: side by side, but for the end of each.
  template <class Patch, class Faces>
  IndexPattern stitched(const Patch& patch, int s, const Faces& faces, const CrackPlan& plan,
                        std::vector<std::uint32_t>& out);

 private:
  std::array<std::array<IndexPattern, 2>, kDeepest + 1> grids_, halves_;  // by depth and form
  std::vector<IndexPattern> fans_, corners_;                              // by number of points
  std::map<std::array<int, 3>, IndexPattern> quads_;
  std::map<std::vector<int>, IndexPattern> stitched_;  // by depth, the half's edge, and the depths of sides
};

}  // namespace limitcheck::fast
