// SPDX-License-Identifier: MIT
// Row streaming as compute shaders: their text, and the memory that a work group shares. No graphics library
// is needed.
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "fast/stream/kernel/layout.h"

namespace limitcheck::fast::gpu {

enum class Shader : std::uint8_t {
  kTriangleGrids,
  kTriangleEdges,
  kQuads,
  kQuadSides,
  kQuadPatches,
  kCopies
};

/// Where a work group puts its vertices and in which form: as many as it makes after those of the groups before it; or
/// from the place on that `Places` of common.glsl names; or there in 16 bytes (CompactVertex), but edges and sides.
enum class Output : std::uint8_t { kInOrder, kPlaced, kPlacedCompact };

/// At depth 8 a grid needs 27 KB of shared memory and a quad 30, at depth 9 it would be 52: OpenGL promises
/// 32.
inline constexpr int kMaxDepth = 8;
/// Each shader is there for all depths to 4, for 5, 6, and to 8: more memory than a depth needs leaves fewer groups at work.
constexpr int compiled_for(int depth) {
  return depth <= 4 ? 4 : depth <= 6 ? depth : kMaxDepth;
}
/// Lanes of a work group: a warp of one maker's, half a wave or a whole one of another's.
inline constexpr int kLanes = 32;

/// Where things lie in the memory that a work group shares, in floats; what is done with before the rows
/// begin, the windows of the corners, lies where the rows will be.
struct SharedMemory {
  int borders = 0;  // what each level takes from the corners
  int staged = 0;   // a row on its way out; of a side its polynomial
  int size = 0;

  static constexpr SharedMemory of(Shader shader, int depth) {
    const int n = 1 << depth, row = 6 * (n + 1);
    // Rows: three of each level, or two levels in turn; the windows; what each level takes from a corner.
    const auto laid_out = [&](int rows, int windows, int taken, int behind) {
      const int before = std::max(rows, windows);
      return SharedMemory{before, before + taken, before + taken + behind};
    };
    const int quad_window = 3 * row_stream::quad_window_width(depth);
    switch (shader) {
      case Shader::kTriangleGrids:
        return laid_out(9 * (2 * n - 1 + 3 * (depth + 1)), 12 * row_stream::window_width(0, depth),
                        4 * row_stream::kBorderSize * (depth + 1), row);
      case Shader::kTriangleEdges:
        return laid_out(18 * (n + 2), 6 * row_stream::edge_window_width(depth),
                        2 * row_stream::kBorderSize * (depth + 1), 0);
      case Shader::kQuads:
        return laid_out(9 * (2 * n - 2 + 3 * depth), 4 * quad_window, 4 * row_stream::kQuadBorder * depth,
                        row + 4 * row_stream::QuadCurve::kSize);
      case Shader::kQuadSides:
        return laid_out(18 * (n + 3), 2 * quad_window, 2 * row_stream::kQuadBorder * depth,
                        row_stream::QuadCurve::kSize);
      case Shader::kQuadPatches:
        return laid_out(48 + 4 * row_stream::QuadCurve::kSize + 24, 0, 0, row);
      case Shader::kCopies:
        return {0, 0, 6 * kLanes};
    }
    return {};
  }
};

/// Uniform buffer 0, as common.glsl declares it, of grids, edges or quads that lie side by side in what is
/// given.
struct alignas(16) BatchUniforms {
  std::array<float, 4> centre{};  // [3]: of quads the unit of polynomials
  float control_unit = 0, limit_unit = 0;
  std::int32_t given_stride = 0;
  std::int32_t sides = 0;  // of each quad that are evaluated
  std::array<std::int32_t, 4> period{};
  std::uint32_t open = 0, darts = 0, sharp = 0, some_polynomial = 0;
  std::int32_t depth = 0;
  std::int32_t first_group = 0;

  auto operator<=>(const BatchUniforms&) const = default;
  static BatchUniforms of(int depth, const Placement<float>& placement, int lanes);
  static BatchUniforms of(const row_stream::QuadBatch<float>& batch, const Placement<float>& placement,
                          int lanes, int sides);
};

/// A control edge: the corner blocks of its ends, and where in their windows the edge's entries begin; and where it is said
/// whether it has an origin of its own.
struct EdgeEnds {
  std::int32_t p, p_first, q, q_first, own;
};
/// The five edges of each grid of a batch, see Stream::refine_edge; and those of a batch of edges.
std::vector<EdgeEnds> edges_of_grids(int depth, int lanes);
std::vector<EdgeEnds> edges_by_themselves(int depth, int lanes);

/// A vertex of a frame that is no point of a whole grid: where it goes, and which three numbers of `given` are its position
/// and which its normal.
struct alignas(16) Copy {
  std::int32_t to, position, normal;
};

/// A shader as OpenGL and Vulkan take it.
///   most    the largest depth that its memory is enough for
///   local   edges and grids have origins of their own, see row_stream::Part
std::string source(Shader shader, int most, bool local, Output output = Output::kInOrder);

}  // namespace limitcheck::fast::gpu
