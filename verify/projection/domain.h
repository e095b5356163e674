// SPDX-License-Identifier: MIT
// The parameter domain of a whole control mesh: its faces as unit triangles, joined at the edges.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "verify/audit/faces_around.h"
#include "verify/audit/lattice.h"

namespace limitcheck::verify {

/// A point of the domain: barycentric coordinates in one face, >= 0, sum 1.
struct FacePoint {
  std::int32_t face = -1;
  std::array<double, 3> l{};
};

/// Two faces unfold into a plane as two triangles of a regular lattice, in which the limit surface is C2
/// across their edge. So a straight walk goes on in the next face.
class Domain {
 public:
  /// `mesh` is valid (data/validate.h) and outlives this.
  explicit Domain(const data::ControlMesh& mesh)
      : lattice_(mesh, 0), around_(mesh.faces, mesh.positions.size()) {}

  data::Triangles triangles() const { return triangles_of(lattice_.mesh()); }

  /// The face across the edge opposite corner k, or -1 on the boundary.
  std::int32_t across(std::int32_t face, int k) const;

  /// All faces at a control vertex.
  std::span<const std::int32_t> faces_at(std::int32_t vertex) const { return around_.of(vertex); }

  /// The same point in another face, if it lies in that one too: on a common edge, or at a common corner;
  /// coordinates are compared with 0 exactly. False otherwise.
  bool express(const FacePoint& point, std::int32_t face, FacePoint& result) const;

  /// Goes from `from` by `step` (the sum of which is 0), across interior edges, up to its end or to the
  /// boundary.
  FacePoint walk(FacePoint from, std::array<double, 3> step) const;

 private:
  Lattice lattice_;
  FacesAround around_;
};

/// Coordinates >= 0 with sum 1 from ones that are so up to rounding.
std::array<double, 3> clamped(std::array<double, 3> l);

}  // namespace limitcheck::verify
