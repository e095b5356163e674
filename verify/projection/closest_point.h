// SPDX-License-Identifier: MIT
// The closest point of the true limit surface.
#pragma once

#include <cstddef>
#include <optional>

#include "data/control_mesh.h"
#include "data/scheme.h"
#include "verify/projection/box_tree.h"
#include "verify/projection/limit_surface.h"
#include "verify/projection/surface_lattice.h"

namespace limitcheck::verify {

/// Where a point projects to.
struct Foot {
  FacePoint at;            // on a common edge or corner: any of the faces
  Vector position{};       // exact evaluation there
  Vector normal{};         // unit limit normal there ...
  bool has_normal = true;  // ... which the surface has (D5, D12)
  double distance = 0;     // |p - position|
  double at_least = 0;     // proved: no point of the surface is nearer than this
  bool stationary =
      true;  // the tangential part of p - position is rounding, or the foot is on a boundary or corner
};

/// The limit surface of a control mesh with a search structure. Any number of threads may ask at once.
class ClosestPoint {
 public:
  static constexpr std::size_t kPieces = std::size_t{1} << 18;

  /// `mesh` is valid for the scheme and outlives this. `pieces`: the search structure has about so many flat
  /// triangles (and at least 16 for each triangle of the domain, 32 for each quad).
  ClosestPoint(const data::ControlMesh& mesh, data::Scheme scheme, std::size_t pieces = kPieces);
  /// Of the scheme that the mesh is meant for.
  explicit ClosestPoint(const data::ControlMesh& mesh, std::size_t pieces = kPieces)
      : ClosestPoint(mesh, data::natural_scheme(mesh), pieces) {}

  /// The closest point of the surface to p, which must be finite.
  ///   method   all pieces whose proved bound lets them hold a nearer point, by rising distance; from each,
  ///            Newton's iteration on the exact evaluator over the whole domain (across face borders, along
  ///            boundaries) with line searches, and a pattern search where that does not descend
  ///   error    foot and distance as the evaluator's, that is about 2e-16 of the mesh, for points nearer than
  ///            the smallest radius of curvature; the test has measurements
  /// Where several points are nearest, it is one of them.
  ///   enough   a point no farther than this will do, whether or not it is the closest; at_least is 0 then
  Foot closest(const Vector& p, double enough = 0) const;

  /// A point of the surface no farther from p than `within`, found by one descent from the nearest of the flat
  /// triangles: as good as `closest` where p lies on the surface but for rounding and the surface does not
  /// come near itself there; at_least is 0. Nothing if that ends elsewhere, or not in a minimum.
  std::optional<Foot> on_surface(const Vector& p, double within) const;

  /// The distance of one point of the surface near p, often the nearest: at least that from the surface, and
  /// found some thousand times as fast where much of it is equally near.
  double at_most(const Vector& p) const;

  /// The surface at a point of the domain: `distance` and the rest as if p projected there.
  Foot at(const FacePoint& where, const Vector& p) const;

  const LimitSurface& surface() const { return surface_; }
  const Domain& domain() const { return surface_.domain(); }
  const SurfaceLattice& lattice() const { return lattice_; }
  /// Length of the diagonal of the control mesh's bounding box.
  double diagonal() const { return diagonal_; }

 private:
  Piece nearest_flat(const Vector& p, OnTriangle& flat) const;

  LimitSurface surface_;
  SurfaceLattice lattice_;
  BoxTree tree_;
  double diagonal_;
};

}  // namespace limitcheck::verify
