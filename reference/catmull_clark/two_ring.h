// SPDX-License-Identifier: MIT
// The points around an extraordinary vertex after any number of steps.
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
//     distinction where eigenvalues coincide.
// On the boundary, at darts, and where there are so many faces that the transform would be slow, the steps
// are taken, each with as many neighbours only as the sector that is asked for still hears of. Only c hears of
// all; how it moves is known beforehand, except at a dart. They are scaled by 2^J, so that weights are exact.
// Everything is divided by growth^J, so that nothing underflows: growth is the largest eigenvalue.
#pragma once

#include <array>
#include <cstddef>
#include <span>
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

/// From so many faces on, an interior vertex takes steps, too.
inline constexpr int kManyFaces = 65;

/// The same of a vertex that takes the steps: on the boundary an ordinary one of K faces, K other than 2, or
/// a held one, K other than 1; a dart, which has an open sector; inside one of many faces.
template <class N>
class SteppedRingKind {
 public:
  SteppedRingKind(int faces, bool closed, VertexState state);
  int faces() const { return faces_; }
  bool closed() const { return closed_; }
  VertexState state() const { return state_; }
  /// What the points are divided by in a step, exactly, and how they grow then.
  static N growth() { return N(1) / N(2); }
  const N& grown() const { return grown_; }

  /// What c hears of a ring: on the boundary e_0 + e_K, otherwise the means of all e_i and of all f_i.
  struct Heard {
    Vec3<N> e, f;
  };
  Heard heard(std::span<const Vec3<N>> e, std::span<const Vec3<N>> f) const;
  /// The same after a step, over the growth. A dart needs the ring itself.
  Heard next(const Heard& heard) const;
  /// What such a ring adds to c: in one step, and in the limit.
  Vec3<N> after(const Heard& heard) const;
  Vec3<N> to_limit(const Heard& heard, std::span<const Vec3<N>> e, std::span<const Vec3<N>> f) const;

 private:
  bool hears_ends() const { return !closed_ && state_ == VertexState::kOrdinary; }
  int faces_;
  bool closed_;
  VertexState state_;
  N grown_;
};

/// The two-ring of one vertex.
template <class N>
class TwoRing {
 public:
  TwoRing(const InteriorKind<N>& kind, const TwoRingPoints<N>& points);
  TwoRing(const SteppedRingKind<N>& kind, const TwoRingPoints<N>& points);

  N growth() const { return interior_ != nullptr ? interior_->growth() : stepped_->growth(); }
  const Vec3<N>& limit() const { return limit_; }
  /// What the rounding of the points after J steps is relative to, over growth^J: the largest coordinate of
  /// those given, grown as they are.
  N size(long steps) const;
  /// Sector i after J steps, over growth^J.
  void sector(int i, long steps, TwoRingSector<N>& s) const;

 private:
  using Amplitude = std::array<Vec3<N>, 2>;  ///< real and imaginary part
  void interior_sector(int i, long steps, TwoRingSector<N>& s) const;
  void stepped_sector(int i, long steps, TwoRingSector<N>& s) const;

  const InteriorKind<N>* interior_ = nullptr;
  const SteppedRingKind<N>* stepped_ = nullptr;
  Vec3<N> limit_;
  N size_{};
  std::vector<std::array<Amplitude, 6>> amplitudes_;  ///< interior: of each frequency
  TwoRingPoints<N> points_;                           ///< stepped: differences from c
  typename SteppedRingKind<N>::Heard heard_;
};

}  // namespace limitcheck::reference::catmull_clark
