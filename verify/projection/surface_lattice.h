// SPDX-License-Identifier: MIT
// The limit surface as flat triangles with their corners on it, each with a proved bound on what it leaves
// out.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "data/control_mesh.h"
#include "verify/projection/limit_surface.h"
#include "verify/projection/piece_bounds.h"

namespace limitcheck::verify {

/// A piece of the surface over a small triangle of the domain.
struct Piece {
  Chart chart = Chart::triangle();
  std::int32_t face = -1;
  std::array<Chart::Affine, 3> at;  // coordinates of the corners
  std::array<Vector, 3> corner;     // limit points
  double deviation = 0;             // |surface - flat triangle| at equal parameters is at most this
  std::int32_t irregular = -1;      // index of the extraordinary vertex at a corner, or -1
  bool rough = false;               // semi-sharp edges are near: the deviation is also that of its pieces
  int steps = 0;                    // taken towards that vertex from the lattice

  Vector flat(const std::array<double, 3>& weight) const {
    return weight[0] * corner[0] + weight[1] * corner[1] + weight[2] * corner[2];
  }
  FacePoint parameter(const std::array<double, 3>& weight) const;
};

/// All faces of a domain subdivided uniformly. Quads of the lattice are cut along the diagonal that runs
/// towards the nearest corner of their face.
///
/// With sharp edges the refined mesh is cut along those that stay sharp, and has the same surface then:
/// pieces at the cut are boundary pieces. A piece near an edge whose sharpness has not run out at this depth
/// has no polynomial yet, and its bound is the size of the convex hull of the control points that it depends
/// on: it lies in the hull, because the sharp rules make convex combinations, too.
class SurfaceLattice {
 public:
  /// depth >= 2. All faces are triangles, or all are quads; the mesh is valid (data/validate.h).
  SurfaceLattice(const data::ControlMesh& mesh, int depth, const reference::SharpTags& tags = {});

  /// The depth of at most so many pieces, 2 to 7; with semi-sharp tags as deep as the largest of them, of up
  /// to four times as many pieces.
  static int depth_for(const data::ControlMesh& mesh, std::size_t pieces,
                       const reference::SharpTags& tags = {});

  int depth() const { return depth_; }
  std::size_t size() const { return triangles_.size(); }
  Piece piece(std::size_t index) const;
  std::array<Vector, 3> corners(std::size_t index) const;
  double deviation(std::size_t index) const { return deviation_[index]; }

  /// The four sub-pieces: at the corners, in order, then the
  /// middle. Their corners come from the exact evaluator.
  std::array<Piece, 4> split(const Piece& piece, const LimitSurface& surface) const;

 private:
  template <class Corners, class Refined, class Cell>
  void subdivide(const data::ControlMesh& mesh, Refined& refined, const reference::SharpTags& tags,
                 Cell cell);

  int depth_;
  Chart chart_;
  std::vector<std::array<std::int32_t, 3>> triangles_;  // of a face 4^depth, or twice as many
  std::vector<Vector> limits_;
  std::vector<double> deviation_;
  std::vector<std::int32_t> irregular_;  // of each triangle
  std::vector<char> rough_;              // of each triangle; empty if none is
  std::vector<CornerBounds> bounds_;     // of each control vertex; empty where regular
};

}  // namespace limitcheck::verify
