// SPDX-License-Identifier: MIT
// The two-sided Hausdorff distance between a tessellation and the limit surface, between proved bounds: the triangles are
// laid over the domain, and a piece of the surface and what lies over it are no farther from one another than a bound.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "verify/files/checks/file_evidence.h"
#include "verify/projection/box_tree.h"
#include "verify/projection/surface_lattice.h"

namespace limitcheck::verify {

/// A distance that lies between two numbers, in the mesh's unit.
struct Bracket {
  double at_least = 0, at_most = 0;
  FacePoint where;  // on the surface, where at_least was found
};

struct Hausdorff {
  Bracket from_triangles;       // max over the triangles of the distance to the surface, holes included
  Bracket from_surface;         // max over the surface, but for holes, of the distance to the triangles
  std::int64_t loose = 0;       // triangles that reach over several control faces, or cover none
  double one_polygon_each = 0;  // at most so far is the surface from one polygon per control face
};

/// By how much of the largest distance found an upper bound may lie above it.
inline constexpr double kTightness = .02;
/// The triangles are laid over the domain by their placed corners and cut along the pieces of the surface
/// lattice. On a part that lies in one triangle T and one flat piece P, the distance from the part of P to T
/// is largest at one of its corners, because the distance to a convex set is a convex function; likewise from
/// the part of T to P; and the surface deviates from P by no more than piece_bounds.h proves. Parts of the
/// surface that no triangle covers are bounded by the distance at their middle and their size (of a triangle
/// taken out of a plane the bracket is 0.996 to 1.075 times the radius of its inscribed circle, which is the
/// distance). The lower bounds are exact distances at the most promising corners; pieces whose upper bound is
/// beyond the largest of them by more than kTightness are split, at most five times, or fourteen towards an
/// extraordinary vertex. There the upper bound stays too large: a triangle laid over the domain is shifted
/// along the surface against the piece it is compared with. Triangles over several faces are bounded by the
/// distances of their corners and their size, split three times.
///   tick   called now and then from this thread; may throw to end it
///   error  rounding, 1e-15 of the mesh, is not accounted for
Hausdorff hausdorff(
    const FileEvidence& evidence, const std::function<void()>& tick = [] {});

/// The row `file-hausdorff`; `bound` in diagonals, negative: one polygon per control face (Loop's scheme:
/// one triangle), and the tolerance of positions.
std::vector<Result> check_file_hausdorff(const FileEvidence& evidence, double bound,
                                         const std::function<void()>& tick);

/// Of triangles barycentric; in the domain affine, as Chart has them.
using Barycentric = std::array<double, 3>;

/// A triangle of the tessellation over one face, its corners in the coordinates of that face, perhaps beyond
/// its edges.
struct Over {
  std::int32_t triangle;
  std::array<Barycentric, 3> l;
};

inline Vector mix(const std::array<Vector, 3>& corner, const Barycentric& weight) {
  return weight[0] * corner[0] + weight[1] * corner[1] + weight[2] * corner[2];
}

/// Triangles, of which the nearest is found by their boxes.
class TriangleTree {
 public:
  explicit TriangleTree(std::vector<std::array<Vector, 3>> triangles);
  /// Of a point from the nearest; infinite without triangles.
  double distance(const Vector& p) const;
  const std::array<Vector, 3>& operator[](std::size_t k) const { return triangles_[k]; }

 private:
  std::vector<std::array<Vector, 3>> triangles_;
  BoxTree tree_;
};

/// Upper bounds of the distances between one piece of the surface and the triangles over it, in the mesh's unit.
struct Bound {
  double from_triangles = 0, from_surface = 0;
  FacePoint at_triangles, at_surface;  // where they are taken
  std::int32_t triangle = -1;          // from which, at at_triangles ...
  Barycentric weight{};                // ... with these coordinates
  bool bare = false;                   // some of the piece has no triangle over it
};

/// Any number of threads may ask at once.
class Overlay {
 public:
  /// The points of the evidence are placed. Keeps a reference to it.
  explicit Overlay(const FileEvidence& evidence);

  /// The triangles over a face.
  const std::vector<Over>& over(std::int32_t face) const { return over_[face]; }
  /// Those of `all` that are over the piece, judged by their extents.
  static std::vector<Over> near(const Piece& piece, const std::vector<Over>& all);
  /// Both bounds, each with the place where it is taken. Of the surface over holes nobody expects triangles.
  Bound look(const Piece& piece, const std::vector<Over>& over) const;

  /// The corners of a triangle, which are finite.
  const std::array<Vector, 3>& corners(std::int32_t triangle) const { return (*finite_)[number_[triangle]]; }
  /// Triangles not wholly over one face, or over no part of it.
  const std::vector<std::int32_t>& loose() const { return loose_; }
  /// From a point to the nearest triangle, wherever it is; infinite without triangles.
  double distance_to_triangles(const Vector& p) const { return finite_->distance(p); }
  bool is_hole(std::int32_t face) const { return e_.surface.surface().is_hole(face); }

 private:
  void lay(std::int32_t triangle, const PlacedTriangle& placed);

  const FileEvidence& e_;
  std::vector<std::vector<Over>> over_;  // of each face
  std::vector<std::int32_t> number_;     // of each triangle in finite_, if it is there
  std::optional<TriangleTree> finite_;   // those with finite corners
  std::vector<std::int32_t> loose_;
};

}  // namespace limitcheck::verify
