// SPDX-License-Identifier: MIT
// The triangles of a tessellation laid over the domain, and how far a piece of the surface and what lies over it
// are from one another at most.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "verify/files/checks/file_evidence.h"
#include "verify/projection/box_tree.h"
#include "verify/projection/surface_lattice.h"

namespace limitcheck::verify {

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

  /// The corners of a triangle.
  const std::array<Vector, 3>& corners(std::int32_t triangle) const { return corners_[triangle]; }
  /// Triangles not wholly over one face, or over no part of it.
  const std::vector<std::int32_t>& loose() const { return loose_; }
  /// From a point to the nearest triangle, wherever it is; infinite without triangles.
  double distance_to_triangles(const Vector& p) const;
  bool is_hole(std::int32_t face) const { return e_.surface.surface().is_hole(face); }

 private:
  void lay(std::int32_t triangle, const PlacedTriangle& placed);

  const FileEvidence& e_;
  std::vector<std::vector<Over>> over_;         // of each face
  std::vector<std::array<Vector, 3>> corners_;  // of each triangle
  std::vector<std::int32_t> boxed_;             // triangles with finite corners
  std::unique_ptr<BoxTree> tree_;               // of those
  std::vector<std::int32_t> loose_;
};

}  // namespace limitcheck::verify
