// SPDX-License-Identifier: MIT
// What a frame is delivered to: strips and fans ready for OpenGL, or an indexed mesh with shared vertices.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "fast/plan/pairing.h"
#include "fast/rules/surface_vertex.h"

namespace limitcheck::fast {

/// What a triangle is part of: a strip of a pair of faces or of a quad, a strip of a face without partner, a
/// fan around a face's centre (section 5), or a face whose outer ring is stitched to finer borders.
enum class Kind : std::uint8_t { kPair, kSingleton, kFan, kStitched };

/// How the vertices of a draw make triangles, as in OpenGL.
enum class DrawMode : std::uint8_t { kStrip, kFan, kTriangles };

/// One call of the graphics library: `count` vertices from `first`, or all of them if they come by
/// themselves. The first `split` triangles belong to control face `face`, the rest to `face_after`. Of a
/// strip or fan they are count - 2.
struct Draw {
  std::int64_t first = 0;
  std::int32_t count = 0;
  std::int32_t split = 0;
  std::int32_t face = -1, face_after = -1;
  DrawMode mode = DrawMode::kStrip;
  Kind kind = Kind::kPair;
  std::int8_t depth = 0;  // of the grid

  std::int32_t triangle_count() const { return (mode == DrawMode::kTriangles ? count / 3 : count - 2); }
  /// The three vertices of triangle t, counted from the first vertex of the draw, counter-clockwise.
  std::array<std::int32_t, 3> triangle(std::int32_t t) const;
  std::int32_t face_of(std::int32_t t) const { return t < split ? face : face_after; }
};

/// A whole frame as strips and fans. `provenance` has one entry per vertex, or none.
template <class Real>
struct DrawList {
  std::vector<SurfaceVertex<Real>> vertices;
  std::vector<LatticePoint> provenance;
  std::vector<Draw> draws;
};

/// Takes the draws one after the other, in the order of the grids, always on the thread that called frame().
/// The vertices are the tessellator's own and last only for the call.
template <class Real>
class DrawSink {
 public:
  virtual ~DrawSink() = default;
  virtual void draw(const Draw& draw, std::span<const SurfaceVertex<Real>> vertices,
                    std::span<const LatticePoint> provenance) = 0;
};

/// A whole frame as one mesh: every point of a control vertex or control edge appears once.
///   triangles       vertex indices, counter-clockwise from outside
///   triangle_face   the control face that each triangle is part of
///   triangle_kind   what else it is part of
///   provenance      one entry per vertex (a shared vertex names any one of its faces), or none
template <class Real>
struct IndexedMesh {
  std::vector<SurfaceVertex<Real>> vertices;
  std::vector<LatticePoint> provenance;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::int32_t> triangle_face;
  std::vector<Kind> triangle_kind;
};

inline std::array<std::int32_t, 3> Draw::triangle(std::int32_t t) const {
  switch (mode) {
    case DrawMode::kFan:
      return {0, t + 1, t + 2};
    case DrawMode::kTriangles:
      return {3 * t, 3 * t + 1, 3 * t + 2};
    default:
      return t % 2 == 0 ? std::array{t, t + 1, t + 2} : std::array{t + 1, t, t + 2};
  }
}

}  // namespace limitcheck::fast
