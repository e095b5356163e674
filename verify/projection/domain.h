// SPDX-License-Identifier: MIT
// The parameter domain of a mesh of triangles or of quads: its faces as unit triangles or unit squares,
// joined at the edges.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "reference/mesh/sharp_tags.h"
#include "verify/evidence/faces_around.h"
#include "verify/evidence/lattice.h"
#include "verify/projection/chart.h"

namespace limitcheck::verify {

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
