// SPDX-License-Identifier: MIT
// The points around an extraordinary vertex after any number of steps, without taking the steps.
//
// After one step all that is near a vertex c is regular but c itself. Its two-ring has six points a sector,
// seen in the frame with c = (0, 0), e_i = (1, 0), e_{i+1} = (0, 1):
//
//      p_{i+1} --- h_i --- r_i        e   the neighbours of c        p   beyond them, (2, 0)
//         |         |       |         f   opposite c, (1, 1)         r   beyond those, (2, 2)
//      e_{i+1} --- f_i --- g_i        g   (2, 1)                     h   (1, 2)
//         |         |       |
//         c ------ e_i --- p_i
//
// One step is a linear map of these points. Two things make its powers cheap and accurate:
//   - All points are taken as differences from c. What is left of the map has no eigenvalue 1, so that a
//     point's distance from c keeps its relative accuracy however close they come.
//   - Around an interior vertex, Fourier's transform in i takes the map apart into one 6 x 6 block for each
//     frequency [Stam 1998]; its J-th power comes by repeated squaring. No eigenvector is needed, and no case
//     distinction where eigenvalues coincide. A sector on the boundary keeps its one map of 6 K + 2 points.
// Everything is divided by growth^J, so that nothing underflows: growth is the largest eigenvalue.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "reference/mesh/sharp_tags.h"
#include "reference/number/vec3.h"

namespace limitcheck::reference::catmull_clark {

/// The points around one sector that the next step's patches need, as differences from c, and c itself as
/// difference from the limit. Outside an open sector they are zero, and `before`, `after` say so.
template <class N>
struct TwoRingSector {
  /// What lies on the other side of edge c - e_i (before) or c - e_{i+1} (after).
  enum class Side { kBoundary, kFaceThenBoundary, kFaces };

  std::array<Vec3<N>, 6> e;  ///< e_{i-2} .. e_{i+3}
  std::array<Vec3<N>, 5> f;  ///< f_{i-2} .. f_{i+2}
  std::array<Vec3<N>, 2> p;  ///< p_i, p_{i+1}
  Vec3<N> g, h, r;
  Vec3<N> h_before, g_after;  ///< h_{i-1}, g_{i+1}
  Vec3<N> c_after;            ///< c after one more step
  Vec3<N> c_to_limit;         ///< limit - c
  Side before = Side::kFaces, after = Side::kFaces;
};

/// The two-ring of a vertex as it is given, in its own coordinates.
template <class N>
struct TwoRingPoints {
  Vec3<N> c;
  std::vector<Vec3<N>> e, p;        ///< n, on the boundary K + 1
  std::vector<Vec3<N>> f, g, h, r;  ///< n or K
};

/// All that a vertex of n faces has in common with others; n other than 4, if it is not held: the tip of a
/// cone.
template <class N>
class InteriorKind {
 public:
  InteriorKind(int n, VertexState state);
  int faces() const { return faces_; }
  bool is_held() const { return held_; }
  const N& growth() const { return growth_; }

  struct Complex {
    N re{}, im{};
  };
  using Block = std::array<std::array<Complex, 6>, 6>;  ///< of e, f, p, g, h, r
  /// The J-th power of each frequency's block, over growth^J: frequencies 0 .. n / 2.
  std::vector<Block> power(long exponent) const;
  const std::vector<Block>& power(long exponent, std::vector<Block>& buffer) const;

 private:
  int faces_;
  bool held_;
  N growth_;
  std::vector<Block> step_;
  std::vector<std::vector<Block>> table_;  ///< of small exponents
};

/// The same of a sector of K faces on the boundary: an ordinary one, K other than 2; a held one, K other than
/// 1; a dart.
template <class N>
class BoundaryKind {
 public:
  BoundaryKind(int faces, VertexState state);
  int faces() const { return faces_; }
  const N& growth() const { return growth_; }
  /// Takes J steps, over growth^J. The points are e_0 .. e_K, p_0 .. p_K, then f, g, h, r.
  std::vector<Vec3<N>> advance(std::vector<Vec3<N>> points, long steps) const;
  /// What such points add to c: in one step, and in the limit.
  Vec3<N> after(const std::vector<Vec3<N>>& points) const;
  Vec3<N> to_limit(const std::vector<Vec3<N>>& points) const;

 private:
  using Matrix = std::vector<N>;  ///< row by row
  Matrix times(const Matrix& a, const Matrix& b) const;
  int faces_;
  VertexState state_;
  std::size_t size_;
  N growth_;
  std::vector<Matrix> squares_;  ///< the map to the powers 1, 2, 4, .. that were asked for
};

/// The two-ring of one vertex.
template <class N>
class TwoRing {
 public:
  TwoRing(const InteriorKind<N>& kind, const TwoRingPoints<N>& points);
  TwoRing(const BoundaryKind<N>& kind, const TwoRingPoints<N>& points);

  const N& growth() const { return interior_ != nullptr ? interior_->growth() : boundary_->growth(); }
  const Vec3<N>& limit() const { return limit_; }
  /// The largest coordinate of the points given: what their rounding is relative to.
  const N& size() const { return size_; }
  /// Sector i after J steps, over growth^J.
  void sector(int i, long steps, TwoRingSector<N>& s) const;

 private:
  using Amplitude = std::array<Vec3<N>, 2>;  ///< real and imaginary part
  void interior_sector(int i, long steps, TwoRingSector<N>& s) const;
  void boundary_sector(int i, long steps, TwoRingSector<N>& s) const;

  const InteriorKind<N>* interior_ = nullptr;
  const BoundaryKind<N>* boundary_ = nullptr;
  Vec3<N> limit_;
  N size_{};
  std::vector<std::array<Amplitude, 6>> amplitudes_;  ///< interior: of each frequency
  std::vector<Vec3<N>> points_;                       ///< boundary: differences
};

}  // namespace limitcheck::reference::catmull_clark
