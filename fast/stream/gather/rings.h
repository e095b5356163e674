// SPDX-License-Identifier: MIT
// What the grids or quads around a control vertex need of it, computed once per vertex in an order that does not
// depend on the grid or quad.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "data/control_mesh.h"
#include "fast/mesh/adjacency.h"
#include "fast/mesh/cut_mesh.h"
#include "fast/rules/vertex_limit.h"
#include "fast/stream/kernel/layout.h"
#include "fast/stream/kernel/number.h"

namespace limitcheck::fast {
template <class W>
class OwnQuadStar;
}

namespace limitcheck::fast::row_stream {

/// Whether parts of a depth have origins of their own, see Part: true, false, or both where it depends on the mesh.
inline std::vector<bool> origins_at(int depth) {
  if (depth == 0 || depth >= kLocalFrom) return {depth > 0};
  return {false, true};
}

/// x y z 0
template <class T>
using ControlPoint = std::array<T, 4>;

/// A control mesh in the kernel's coordinates.
template <class T>
struct PlacedPoints {
  std::vector<ControlPoint<T>> points;
  Placement<T> placement;
  int local_from = kLocalFrom;  // depth from which every part has an origin of its own: 1 at least
  std::vector<std::uint8_t> faces_local_from;  // sooner, per face; or empty
};

/// From which depth on faces and control edges have origins of their own, see Part. An edge asks the faces on both of
/// its sides: so these agree.
class LocalOrigins {
 public:
  LocalOrigins() = default;
  /// K corners to a face. across(h): the face on the other side of a half-edge, or -1.
  template <int K, class T, class Across>
  static LocalOrigins of(const PlacedPoints<T>& placed, Across&& across) {
    LocalOrigins all;
    all.least_ = all.all_ = placed.local_from;
    const auto& faces = placed.faces_local_from;
    all.from_.resize((K + 2) * faces.size());
    std::uint8_t* its = all.from_.data();
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(faces.size()); ++f, its += K + 2) {
      its[0] = its[1] = faces[f];
      for (int k = 0; k < K; ++k) {
        const std::int32_t other = across(K * f + k);
        its[2 + k] = other < 0 ? faces[f] : std::min(faces[f], faces[other]);
        its[0] = std::min(its[0], its[2 + k]);
      }
      all.least_ = std::min<int>(all.least_, its[0]);
    }
    return all;
  }

  bool none(int depth) const { return depth < least_; }
  bool all(int depth) const { return depth >= all_; }
  /// Of a face, of the edge that a half-edge is, and of whatever of a face and its edges is the first.
  template <int K>
  int of_face(std::int32_t f) const {
    return at<K>(f, 1);
  }
  template <int K>
  int of_edge(std::int32_t h) const {
    return at<K>(h / K, 2 + h % K);
  }
  template <int K>
  int first(std::int32_t f) const {
    return at<K>(f, 0);
  }

 private:
  template <int K>
  int at(std::int32_t f, int k) const {
    return from_.empty() ? all_ : from_[static_cast<std::size_t>((K + 2) * f + k)];
  }

  int least_ = kLocalFrom, all_ = kLocalFrom;
  std::vector<std::uint8_t> from_;  // of each face: what is first, itself, its edges; or empty
};

/// A mesh of size 1 about the origin, T float or double. The centre is one for the whole mesh, or shared
/// points would differ: the middle of its box, rounded to float, in each coordinate in which the middle is
/// farther than a quarter of the size from 0; else 0, so that the coordinates are not rounded again. (The
/// sliding window has a rule of its own, by which representable control points stay exact; it would change
/// the bits of this engine.)
template <class T>
PlacedPoints<T> place_points(std::span<const std::array<double, 3>> positions);

/// The same for triangles, with local origins sooner where some are low.
template <class T>
PlacedPoints<T> place(const data::ControlMesh& mesh);

/// Rings and limits of all control vertices, for a number N of the kernel (see number.h). Needs
/// NumberTraits<Scalar> of fast/rules/masks.h: Wide, Scalar, widen, narrow; and of NumberTraits of that
/// Scalar cosine(1, n), or cosine(k, n) and sine(k, n). Topology alone decides which operations are done, but
/// for the start of the rings in floating point and for degenerate normals.
///
/// Order in floating point: an interior ring starts at its lexicographically smallest neighbour (position,
/// then the positions that follow it), a boundary ring at the first boundary edge. So what is computed here
/// depends on positions alone: not on the numbering of vertices and faces nor on the rotation of corners.
/// Numbers without rounding start at adjacency.outgoing. [claim D14]
///
/// Boundary: the open ring r_0 .. r_K goes on at both ends so that the interior rules, applied to it, give
/// the B-spline boundary curve: r_{-k} = q_k - r_k with q = 2 r_0, v + r_0, v + r_K, 2 r_K, v + r_K, v + r_0
/// (period 6), and likewise from r_K. r_{-1} = v + r_0 - r_1 is the ghost of claim D10; the others follow
/// from its being invariant at every level. At a vertex that is held
/// q = 2 v + 2 cos(k pi / 3) (r_0 - v): 2 r_0, v + r_0, 3 v - r_0, 4 v - 2 r_0, 3 v - r_0, v + r_0.
template <class N>
class BasicLoopRings {
 public:
  using T = typename N::Scalar;
  using Wide = typename NumberTraits<T>::Wide;
  using Block = CornerBlock;

  /// One point per vertex of the adjacency; throws data::ArgumentError otherwise. Of darts only the limits are
  /// right: their rings do not follow the corner recurrence that the kernel assumes. Keeps references to the
  /// adjacency and the kinds, which must outlive it.
  BasicLoopRings(const Adjacency& adjacency, PlacedPoints<T> points, VertexKinds kinds = {});
  BasicLoopRings(const data::ControlMesh& mesh, const Adjacency& adjacency, VertexKinds kinds = {})
      : BasicLoopRings(adjacency, place<T>(mesh), kinds) {}

  /// Other points: what depends on the topology alone stays.
  ///   throws   data::ArgumentError: not one point per vertex
  void move_points(PlacedPoints<T> points);

  const Adjacency& adjacency() const { return *adjacency_; }

  /// What a grid needs of a vertex, in one piece, three numbers to a point: k0, k1, c, d, limit position, limit
  /// normal (or N::tangent), which are the head of a CornerBlock; then the ring. That goes on at both ends, so
  /// that windows do not wrap: a closed one by kReach entries, enough to depth 5, an open one by kOpenReach,
  /// which are ghosts.
  const T* numbers() const { return numbers_.data(); }
  const T* head(std::int32_t v) const { return numbers() + 3 * static_cast<std::size_t>(heads_[v]); }
  static constexpr int kReach = 8, kOpenReach = kMaxDepth + 3, kHeadPoints = 5;
  static constexpr bool reaches(int depth) { return depth + 3 <= kReach; }

  /// How a grid finds one of its corners, by the half-edge that leaves there, in points: its head, and the
  /// entry of its ring to which the half-edge leads.
  struct Corner {
    std::int32_t head, entry;
  };
  const Corner& corner(std::int32_t h) const { return corners_[h]; }
  /// Whether an edge is regular, see kPatchWindow.
  bool is_regular(std::int32_t h) const { return regular_[h] != 0; }

  const Placement<T>& placement() const { return placement_; }
  const LocalOrigins& local() const { return local_; }
  /// The number of vertices whose two limit tangents are parallel or vanish. [D12]
  std::int64_t degenerate_normals() const { return degenerate_normals_; }

 private:
  using Weight = typename NumberTraits<Wide>::Scalar;
  struct Scratch {
    std::vector<ControlPoint<T>> placed;  // all control points
    std::vector<std::int32_t> vertices;
    std::vector<Vec3<Wide>> points, continued;
  };

  void lay_out();
  void find_regular_edges();
  void make_vertex(std::int32_t v, VertexKind kind, Scratch& scratch);
  static void continue_ring(const Vec3<Wide>& v, bool held, std::span<const Vec3<Wide>> r, T* to,
                            Scratch& scratch);
  void put_head(std::int32_t v, const Weight& k0, const Weight& k1, const VertexLimit<Wide>& limit,
                const Vec3<Wide>& normal);
  T* head_of(std::int32_t v) { return numbers_.data() + 3 * static_cast<std::size_t>(heads_[v]); }

  const Adjacency* adjacency_;
  VertexKinds kinds_;
  std::vector<T> numbers_;
  std::vector<std::int32_t> heads_;    // per vertex, in points
  std::vector<Corner> corners_;        // per half-edge
  std::vector<std::uint8_t> regular_;  // per half-edge
  Placement<T> placement_;
  LocalOrigins local_;
  RingWeightTable<Weight> weights_;
  DartWeightTable<Weight> darts_;
  std::int64_t degenerate_normals_ = 0;
};

using LoopRings = BasicLoopRings<ScalarNumber<float>>;
using Rings = LoopRings;  // its name until 0.2

/// How the vertices of a quad let it be evaluated; grids of triangles are regular, open, or semi-sharp where a cut touches them.
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
/// linear maps alone (rings_impl.h).
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

  const Placement<T>& placement() const { return placement_; }
  const LocalOrigins& local() const { return local_; }
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
  Placement<T> placement_;
  LocalOrigins local_;
  int tangent_;
  std::int64_t degenerate_normals_ = 0;
};

/// As the kernels take them.
using QuadRings = BasicQuadRings<float>;

}  // namespace limitcheck::fast::row_stream
