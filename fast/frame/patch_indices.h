// SPDX-License-Identifier: MIT
// The index patterns of patches, each made once: grids and halves of a depth, fans, faces with stitched rings.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "fast/frame/patch.h"
#include "fast/frame/patch_mesh.h"
#include "fast/plan/depth.h"

namespace limitcheck::fast {

struct QuadPatch;

/// Where the points of a patch lie in its block of vertices: rows as the kernel delivers them, the last
/// column first. Rows and columns as in patch.h.
struct GridBlock {  // (k + 1)^2 points of both halves
  int k;
  std::uint32_t at(int row, int column) const {
    return static_cast<std::uint32_t>(row * (k + 1) + k - column);
  }
  std::int32_t size() const { return (k + 1) * (k + 1); }
};
struct HalfBlock {  // (k + 1) (k + 2) / 2 points of one half, in its own frame
  int k;
  std::uint32_t at(int row, int column) const {
    return static_cast<std::uint32_t>(row * (k + 1) - row * (row - 1) / 2 + k - row - column);
  }
  std::int32_t size() const { return (k + 1) * (k + 2) / 2; }
};

struct PartBlock {  // (m + 1)^2 points of each part of a face of Catmull-Clark's, row by row from the top
  int cells;
  std::uint32_t at(PartPoint p) const {
    return static_cast<std::uint32_t>(p.part * size() + (cells - p.j) * (cells + 1) + cells - p.i);
  }
  std::int32_t size() const { return (cells + 1) * (cells + 1); }
};

/// A pattern: indices first .. first + count - 1.
struct IndexPattern {
  std::uint32_t first = 0, count = 0;
  std::int32_t triangles = 0;
};

/// Makes patterns where they are asked for first; they are appended to a list.
class PatchIndices {
 public:
  /// Both halves of a grid, face0's triangles first; one half; a fan: its centre, then `border` points, then
  /// the triangles between them, the last of which ends at the first point.
  IndexPattern grid(int depth, IndexForm form, std::vector<std::uint32_t>& out);
  IndexPattern half(int depth, IndexForm form, std::vector<std::uint32_t>& out);
  IndexPattern fan(int border, std::vector<std::uint32_t>& out);
  /// A half whose interior is kept and whose outer ring is stitched to its border, the points of which
  /// follow the HalfBlock: those of edge e = 0, 1, 2 of the face but for the end of each.
  IndexPattern stitched(const Half& half, int depth, const LoopFaces& faces, const CrackPlan& plan,
                        std::vector<std::uint32_t>& out);

  /// Of Catmull-Clark's scheme: quads of each part, whose points lie row by row as the kernel delivers them,
  /// from the last on; the corners of a face by themselves; and a face with a stitched ring, whose points are
  /// followed by those of its border, side by side.
  IndexPattern quads(int parts, int cells, IndexForm form, std::vector<std::uint32_t>& out);
  IndexPattern corners(int sides, std::vector<std::uint32_t>& out);
  IndexPattern stitched(const QuadPatch& patch, const QuadFaces& faces, const CrackPlan& plan,
                        std::vector<std::uint32_t>& out);

 private:
  std::array<std::array<IndexPattern, 2>, kDeepest + 1> grids_, halves_;  // by depth and form
  std::vector<IndexPattern> fans_, corners_;                              // by number of points
  std::map<std::array<int, 3>, IndexPattern> quads_;
  std::map<std::vector<int>, IndexPattern>
      stitched_;  // by depth, the half's edge or -1, and the depths of sides
};

}  // namespace limitcheck::fast
