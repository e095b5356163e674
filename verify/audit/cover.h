// SPDX-License-Identifier: MIT
// Meshes that cover kinds of neighbourhood: how the plan of an audit without meshes comes about.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "data/generators/star_meshes.h"
#include "verify/evidence/cells.h"

namespace limitcheck::verify {

/// A case of the plan: a mesh by its name, a depth, and how the depths of faces are chosen.
struct PlannedCase {
  std::string mesh;
  int depth = 0;
  std::string depths = "uniform";
  bool relations = false;
};
AuditMesh made(const PlannedCase& planned);

/// Stars (data/generators/star_meshes.h) and their depths.
struct CoveringStars {
  data::Stars stars;
  int depth = 0;
  std::string depths = "uniform";
};
/// Those that look at the cells of a scheme which are not in
/// `covered`, as far as they are found: greedily those that look at most for their time. The same for the
/// same seed. `covered` has all of them added.                                         O(minutes)
std::vector<CoveringStars> cover(data::Scheme scheme, CellSet& covered, std::uint64_t seed);

}  // namespace limitcheck::verify
