// SPDX-License-Identifier: MIT
// The meshes and depths of `limitcheck audit SUBJECT` when the command line names neither.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "verify/audit/audit.h"
#include "verify/evidence/cells.h"

namespace limitcheck::verify {

/// The cases, those of the same mesh one after the other: the worst cases known (data/worst_cases.h; not at
/// kQuick), the stock shapes (data/generators/named_mesh.h), deep levels, unequal depths, awkward topology and
/// geometry, what the relations need, the stars that look at all other kinds of neighbourhood
/// (data/generators/star_meshes.h), and parts of meshes whose indices need more than 16 bits.
/// Throws data::InputError as worst_case_meshes() does.
std::vector<AuditMesh> default_plan(Level level);

constexpr std::size_t kMostFacesUnderOptions = 1000;

/// Whether a subject looks at a mesh of the plan where all subjects are audited. One on a device looks at five small ones:
/// a driver without a graphics card takes minutes for what a processor does in seconds. One under options, which is there
/// without them, too, looks at none of more than kMostFacesUnderOptions faces: they would take half of the time.
bool is_looked_at_beside_all(const AuditSubject& subject, bool on_a_device, const AuditMesh& mesh);

/// The cases of a scheme and of sharp edges that some of the subjects does; all without sharp edges if a
/// subject does not say.
std::vector<AuditMesh> default_plan(Level level, const std::vector<AuditSubject>& subjects);

// How the plan comes about: meshes that cover kinds of neighbourhood (make_plan.cpp).

/// A case of the plan: a mesh by its name, a depth, and how the depths of faces are chosen.
struct PlannedCase {
  std::string mesh;
  int depth = 0;
  std::string depths = "uniform";
  bool relations = false;
  bool asked_again = true;  // AuditMesh::asked_again
};
/// Of meshes of more vertices than 15 bits number, a sample.
AuditMesh made(const PlannedCase& planned);

/// What a case looks at, and what it asks of a subject (Feature::needs).
struct Looked {
  std::int32_t needs;
  CellSet cells;
};
Looked look_at(const AuditMesh& mesh);

/// What subjects do, from nothing beyond smooth surfaces to all: whatever a subject does, there are cases for
/// it that ask for no more.
const std::vector<std::int32_t>& steps_of_ability();

/// The cells that need no more than a subject does, and whether cases that need no more look at them.
struct Covered {
  CellSet wanted, looked;
};
Covered covered_by(const std::vector<Looked>& known, data::Scheme scheme, std::int32_t ability);

}  // namespace limitcheck::verify
