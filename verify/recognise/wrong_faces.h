// SPDX-License-Identifier: MIT
// Some of the faces where a tessellation is wrong: to put a guess off that is wrong there, before what it
// makes of the whole mesh is computed.
#pragma once

#include <cstdint>
#include <vector>

#include "data/control_mesh.h"
#include "verify/evidence/evidence.h"
#include "verify/recognise/schemes.h"

namespace limitcheck::verify {

/// As parts of a mesh with all that their surface depends on.
class WrongFaces {
 public:
  /// So many of the faces with vertices farther than `tolerance` from the truth, from the worst to the least.
  WrongFaces(const Evidence& e, double tolerance, std::size_t most);

  /// Whether the mesh has so many more faces that looking at these first is worth it.
  bool worthwhile() const;
  /// What a scheme makes of these faces, with places on the whole mesh; nothing but what is right there.
  ///   tags, lattice   as placed_scheme_points() wants them
  SchemePoints points(bool tags, Scheme scheme, int steps, bool limit, data::Scheme lattice) const;

 private:
  const data::ControlMesh& whole_;
  std::vector<std::int32_t> faces_;  // of the part: the wrong ones first, then what their surface depends on
  std::size_t wrong_ = 0;            // how many of those
  data::ControlMesh part_;
};

}  // namespace limitcheck::verify
