// SPDX-License-Identifier: MIT
// The sides of edges that stay sharp: what a point is seen from, where its faces have different normals.
#pragma once

#include <cstdint>
#include <vector>

#include "verify/evidence/lattice.h"

namespace limitcheck::verify {

/// On an edge that stays sharp (data/sharpness.h) the surface has one position and a normal for each side; at
/// a vertex, one for each of the sectors into which two and more such edges and the boundary part its faces.
/// A side has an id: that of the point where there is one side, and for the side of the face by which the
/// lattice names the point; the others get the ids from the lattice's size on.
class Sides {
 public:
  using Id = Lattice::Id;

  /// `lattice` outlives this.                                            O(faces) if an edge stays sharp
  explicit Sides(const Lattice& lattice);

  Id size() const { return lattice_.size() + static_cast<Id>(others_.size()); }
  /// Whether all points have one side.
  bool none() const { return others_.empty(); }

  bool several(Lattice::Id point) const { return first_other(point) >= 0; }
  /// The side of a face that touches the point.
  Id of(Lattice::Id point, std::int32_t face) const;
  /// Where a side lies, as one of its faces names it.
  Place place(Id side) const;
  Lattice::Id point(Id side) const {
    return side < lattice_.size() ? side : others_[side - lattice_.size()].point;
  }
  /// All sides of a point.
  template <class Visit>
  void for_each(Lattice::Id point, Visit visit) const {
    visit(point);
    const Id first = first_other(point);
    for (Id side = first; first >= 0 && side < size() && this->point(side) == point; ++side) visit(side);
  }

 private:
  struct Other {
    Lattice::Id point;
    std::int32_t face;
  };

  // The first of the other sides of a point, or -1.
  Id first_other(Lattice::Id point) const;

  const Lattice& lattice_;
  std::vector<Other> others_;
  std::vector<std::int32_t> sector_;     // of each corner of a face, at its vertex: 0, 1 ..
  std::vector<Id> of_vertex_, of_edge_;  // the first other side of a vertex, of the first point on an edge
};

}  // namespace limitcheck::verify
