// SPDX-License-Identifier: MIT
// The faces where a tessellation is farthest from the truth: a guess that is right is right there, too.
#pragma once

#include <cstdint>
#include <vector>

#include "data/control_mesh.h"
#include "verify/evidence/evidence.h"
#include "verify/recognise/schemes.h"

namespace limitcheck::verify {

/// Some of these faces, as parts of a mesh with all that their surface depends on.
class WorstFaces {
 public:
  /// So many faces, or fewer if those have a tenth of all squares.
  WorstFaces(const Evidence& e, std::size_t most);

  /// The sum of the squares of all vertices' distances to the truth.
  double squares() const { return squares_; }
  /// Whether the mesh has so many more faces that looking at these first is worth it.
  bool worthwhile() const;
  /// What a scheme makes of these faces, with places on the whole mesh; nothing but what is right there.
  ///   tags, lattice   as placed_scheme_points() wants them
  SchemePoints points(bool tags, Scheme scheme, int steps, bool limit, data::Scheme lattice) const;

 private:
  const data::ControlMesh& whole_;
  double squares_ = 0;
  std::vector<std::int32_t> faces_;  // of the part: the worst first, then what their surface depends on
  std::size_t worst_ = 0;            // how many
  data::ControlMesh part_;
};

}  // namespace limitcheck::verify
