// SPDX-License-Identifier: MIT
// The parameter domain of a mesh of triangles or of quads: its faces as unit triangles or unit squares,
// joined at the edges.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "reference/mesh/sharp_tags.h"
#include "verify/evidence/faces_around.h"
#include "verify/subject/lattice.h"

namespace limitcheck::verify {

/// Coordinates >= 0 with sum 1 from ones that are so up to rounding.
inline std::array<double, 3> clamped(std::array<double, 3> l) {
  for (double& x : l) x = std::clamp(x, 0.0, 1.0);
  const double sum = l[0] + l[1] + l[2];
  if (sum != 1)
    for (double& x : l) x /= sum;
  return l;
}

/// Points are given by three affine coordinates with sum 1, so that the same code measures areas, clips and
/// interpolates in both shapes; steps by three with sum 0.
///   triangle   barycentric coordinates: l1 and l2 of Loop's scheme are the second and the third
///   square     (1 - u - v, u, v), of which the first is negative beyond the diagonal; only u and v count
///
/// A side goes counter-clockwise. Side k lies opposite corner k of a triangle, and begins at corner k of a
/// square.
class Chart {
 public:
  using Affine = std::array<double, 3>;

  static constexpr Chart triangle() { return Chart(false); }
  static constexpr Chart square() { return Chart(true); }

  constexpr bool is_square() const { return square_; }
  constexpr int corners() const { return square_ ? 4 : 3; }
  /// The corners where a side begins and ends.
  constexpr int first(int side) const { return square_ ? side : (side + 1) % 3; }
  constexpr int last(int side) const { return square_ ? (side + 1) % 4 : (side + 2) % 3; }
  /// The side that begins at a corner.
  constexpr int side_from(int corner) const { return square_ ? corner : (corner + 2) % 3; }

  static constexpr Affine at(double u, double v) { return {1 - u - v, u, v}; }
  constexpr Affine corner(int k) const {
    if (square_) return at(k == 1 || k == 2 ? 1 : 0, k >= 2 ? 1 : 0);
    Affine l{};
    l[k] = 1;
    return l;
  }
  constexpr Affine centre() const { return square_ ? Affine{0, .5, .5} : Affine{1. / 3, 1. / 3, 1. / 3}; }
  /// The step along a side, from its first corner to its last.
  constexpr Affine along(int side) const {
    const Affine a = corner(first(side)), b = corner(last(side));
    return {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  }
  /// The determinant of three points is twice their area over that of the triangle (0, 0), (1, 0), (0, 1),
  /// half of which is the unit; so much has the whole.
  constexpr double area() const { return square_ ? 2 : 1; }

  /// A point seen from a corner: its coordinates towards the next corner and towards the one before.
  ///   whole   1 of a point, 0 of a step
  constexpr std::array<double, 2> from_corner(int k, const Affine& l, double whole) const {
    if (!square_) return {l[(k + 1) % 3], l[(k + 2) % 3]};
    if (k == 0) return {l[1], l[2]};
    if (k == 1) return {l[2], whole - l[1]};
    if (k == 2) return {whole - l[1], whole - l[2]};
    return {whole - l[2], l[1]};
  }
  /// How far a point lies from a side, the far corner or side being at 1; 0 exactly means on it.
  constexpr double height(int side, const Affine& l) const {
    return square_ ? from_corner(side, l, 1)[1] : l[side];
  }
  /// The height gained by a step.
  constexpr double slope(int side, const Affine& step) const {
    return square_ ? from_corner(side, step, 0)[1] : step[side];
  }
  /// The corner in which a point lies exactly, or -1.
  constexpr int corner_at(const Affine& l) const {
    for (int k = 0; k < corners(); ++k)
      if (from_corner(k, l, 1) == std::array{0., 0.}) return k;
    return -1;
  }
  /// Within a tenth of a corner.
  constexpr bool is_near(int corner, const Affine& l) const {
    return square_ ? height(corner, l) <= .1 && height((corner + 3) % 4, l) <= .1 : l[corner] >= .9;
  }

  /// The point with what rounding has put outside moved back.
  Affine clamp(const Affine& l) const {
    return square_ ? at(std::clamp(l[1], 0.0, 1.0), std::clamp(l[2], 0.0, 1.0)) : clamped(l);
  }
  /// The point with its height over a side set to 0, which it is but for rounding.
  constexpr Affine put_on(int side, Affine l) const {
    if (square_) {
      l[side % 2 == 0 ? 2 : 1] = side == 1 || side == 2 ? 1 : 0;
      return at(l[1], l[2]);
    }
    l[side] = 0;
    return l;
  }
  /// The point moved straight onto a side.
  Affine dropped(int side, Affine l) const {
    if (!square_) {
      l[(side + 1) % 3] += l[side] / 2;
      l[(side + 2) % 3] += l[side] / 2;
    }
    return clamp(put_on(side, l));
  }

  friend constexpr bool operator==(Chart, Chart) = default;

 private:
  constexpr explicit Chart(bool square) : square_(square) {}
  bool square_;
};

/// The determinant of three points, or of three others with as many coordinates.
inline double determinant(const Chart::Affine& a, const Chart::Affine& b, const Chart::Affine& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// A point of the domain: a face, and affine coordinates as Chart has them.
struct FacePoint {
  std::int32_t face = -1;
  Chart::Affine l{};
};

/// Two faces unfold into a plane as two triangles, or two squares, of a regular lattice, in which the limit
/// surface is C2 across their edge. So a straight walk goes on in the next face. Across an edge that stays
/// sharp the surface is continuous and no more: it is cut there, as the surface is at its boundary.
class Domain {
 public:
  /// All faces of the mesh are triangles, of Loop's scheme, or all are quads, of Catmull-Clark's. It is valid
  /// (data/validate.h) and outlives this. `tags`: those of its sharp edges.
  Domain(const data::ControlMesh& mesh, const reference::SharpTags& tags = {});

  Chart chart() const {
    return lattice_.scheme() == data::Scheme::kLoop ? Chart::triangle() : Chart::square();
  }
  std::size_t face_count() const { return static_cast<std::size_t>(lattice_.face_count()); }
  /// The vertex at corner k.
  std::int32_t vertex(std::int32_t face, int k) const { return lattice_.vertex(face, k); }

  /// The face across side k, or -1 on the boundary.
  std::int32_t across(std::int32_t face, int k) const;
  /// Whether side k lies on an edge that stays sharp, inside of the mesh.
  bool is_cut(std::int32_t face, int k) const {
    return !cut_.empty() && cut_[lattice_.corner_number(face, chart().first(k))];
  }
  /// Whether the surface goes on smoothly across side k.
  bool goes_on(std::int32_t face, int k) const { return across(face, k) >= 0 && !is_cut(face, k); }
  /// Whether a point lies on an edge that stays sharp.
  bool on_cut(const FacePoint& at) const;
  /// The side of the face across that is side k of this one, which is not on the boundary.
  int side_across(std::int32_t face, int k) const;

  /// All faces at a vertex.
  std::span<const std::int32_t> faces_at(std::int32_t vertex) const { return around_.of(vertex); }

  /// The same point in another face, if it lies in that one too: on a common edge, or at a common corner;
  /// coordinates are compared with 0 exactly. False otherwise.
  bool express(const FacePoint& point, std::int32_t face, FacePoint& result) const;

  /// A point, inside of the face or not, in the coordinates of the face across side k.
  Chart::Affine unfolded(std::int32_t face, int k, const Chart::Affine& l) const;

  /// Goes from `from` by `step`, across interior edges, up to its end, to the boundary, or to an edge that
  /// stays sharp.
  FacePoint walk(FacePoint from, Chart::Affine step) const;

 private:
  Chart::Affine turned(std::int32_t face, int k, const Chart::Affine& l, double whole) const;

  Lattice lattice_;
  FacesAround around_;
  std::vector<bool> cut_;  // of each corner, the side that begins there; empty if no edge stays sharp
};

}  // namespace limitcheck::verify
