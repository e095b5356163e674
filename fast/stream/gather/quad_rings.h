// SPDX-License-Identifier: MIT
// What the quads around a control vertex need of it, computed once per vertex in an order that does not
// depend on the quad.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "fast/mesh/cut_mesh.h"

#include "fast/stream/gather/rings.h"
#include "fast/stream/kernel/layout.h"

namespace limitcheck::fast {
template <class W>
class OwnQuadStar;
}

namespace limitcheck::fast::row_stream {

/// How the vertices of a quad let it be evaluated.
enum class QuadClass : std::uint8_t {
  kRegular,   ///< all interior, of four quads: a bicubic polynomial
  kClosed,    ///< all interior
  kOpen,      ///< some vertex on a boundary or a cut
  kSemiSharp  ///< some vertex with steps of SemiSharp: not for the kernels
};

/// place_points, with local origins sooner where two sides of a quad span a low triangle.
template <class T>
PlacedPoints<T> place(const QuadMesh& mesh);

/// Rings and limits of all control vertices of a mesh of quads, T float or double, or a number that knows
/// linear maps alone (quad_rings_impl.h).
///
/// Order in floating point: an interior ring starts at its lexicographically smallest edge neighbour
/// (position, then the positions that follow it), a boundary ring at the first boundary edge. So what is
/// computed here depends on positions alone: not on the numbering of vertices and faces nor on the rotation
/// of corners. Other numbers start where the adjacency does. [claim D14]
template <class T>
class BasicQuadRings {
 public:
  using Block = QuadCornerBlock;

  explicit BasicQuadRings(const QuadMesh& mesh) : BasicQuadRings(mesh, place<T>(mesh), 0) {}
  /// Points of the caller's, one per vertex of the adjacency.
  ///   tangent   of numbers without lengths: which limit tangent stands for a vertex's normal, 0 or 1
  BasicQuadRings(const QuadMesh& mesh, PlacedPoints<T> points, int tangent);

  /// The points around a vertex, three numbers each: e_0 f_0 e_1 f_1 ... A closed ring has 2 n entries and is
  /// there twice, an open one 2 K + 1.
  struct Ring {
    std::int32_t first;  // into numbers()
    std::int32_t entries;
  };
  Ring ring(std::int32_t v) const { return rings_[v]; }

  /// The head of a QuadCornerBlock.
  const T* head(std::int32_t v) const { return heads_[v].data(); }
  /// What a quad needs to find its way from one of its corners, by the half-edge that leaves there: a line of
  /// memory for all four.
  struct Corner {
    std::int32_t vertex;
    std::int32_t before;   // into numbers(), of e_{k-1}, where e_k is the point that the half-edge leads to;
                           // in a closed ring, of the first of the two that are there. -1: there is none
    std::int32_t entries;  // of the ring
    bool open;             // the ring
    bool sharp, polynomial;  // the side that the half-edge is
    bool semi_sharp;         // the vertex, or an edge at it
  };
  const Corner& corner(std::int32_t h) const { return corners_[h]; }
  /// Whether something at an end of a side is semi-sharp: such sides are not for the kernels.
  bool touches_semi_sharp(std::int32_t h) const {
    return corners_[h].semi_sharp || corners_[QuadAdjacency::next(h)].semi_sharp;
  }
  const T* numbers() const { return numbers_.data(); }

  /// How far the centre of a dart has moved in each level from 1 on since the level before, 4^level times too
  /// large; null for another vertex.
  using DartMoves = std::array<std::array<T, 3>, kMaxDepth>;
  const DartMoves* dart(std::int32_t v) const { return darts_.empty() ? nullptr : darts_[v].get(); }
  QuadClass kind(std::int32_t face) const { return kinds_[face]; }

  const KernelPlacement<T>& placement() const { return placement_; }
  /// The number of vertices whose two limit tangents are parallel or vanish. [D12]
  std::int64_t degenerate_normals() const { return degenerate_normals_; }

 private:
  using Wide = typename NumberTraits<T>::Wide;
  struct Scratch;
  void lay_out(const QuadAdjacency& adjacency);
  void make_vertex(const QuadMesh& mesh, std::int32_t v, Scratch& scratch);
  void make_dart(std::int32_t v, const OwnQuadStar<Wide>& own);
  void find_kinds(const QuadMesh& mesh);

  std::vector<T> numbers_;
  std::vector<Ring> rings_;
  std::vector<std::array<T, QuadCornerBlock::kHead>> heads_;
  std::vector<Corner> corners_;
  std::vector<QuadClass> kinds_;
  std::vector<std::unique_ptr<DartMoves>> darts_;  // per vertex, or empty
  KernelPlacement<T> placement_;
  int tangent_;
  std::int64_t degenerate_normals_ = 0;
};

/// As the kernels take them.
using QuadRings = BasicQuadRings<float>;

}  // namespace limitcheck::fast::row_stream
