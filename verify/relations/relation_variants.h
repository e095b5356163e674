// SPDX-License-Identifier: MIT
// Variants of a request for one surface, and the maps back to the original.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "verify/evidence/evidence.h"
#include "verify/evidence/vector.h"
#include "verify/relations/rewriting.h"

namespace limitcheck::verify {

/// A control mesh that describes the surface of the evidence, written differently or moved, and how its
/// points and faces belong to those of the original.
struct Variant : Rewriting {
  std::string name;  // "mirrored", "times 2^10", ...
  std::vector<std::int32_t> face_depth;
  std::function<Vector(const Vector&)> position, normal;  // back to the original
  double magnitude = 0;                                   // largest coordinate
  bool normals = true;                                    // to be compared
  bool same_numbers = false;                              // a difference in bits is worth a warning
};

/// The request as it was.
Variant identity(const Evidence& e);

/// One row of the audit and the variants it compares.
struct Relation {
  std::string_view row;
  std::vector<Variant> (*variants)(const Evidence&);
  /// Whether there is anything to compare; nullptr: always.
  bool (*applies)(const data::ControlMesh&, const Lattice&) = nullptr;
};

/// From face-order to translation, in the order of the table (relations.h says what each is).
const std::vector<Relation>& variant_relations();

}  // namespace limitcheck::verify
