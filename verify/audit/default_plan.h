// SPDX-License-Identifier: MIT
// The meshes and depths of `limitcheck audit SUBJECT` when the command line names neither.
#pragma once

#include <vector>

#include "verify/audit/audit.h"
#include "verify/audit/cover.h"

namespace limitcheck::verify {

/// The cases, those of the same mesh one after the other: the worst cases known (data/worst_cases.h; not at
/// kQuick), the stock shapes (data/generators/named_mesh.h), deep levels, unequal depths, awkward topology and
/// geometry, what the relations need, the stars that look at all other kinds of neighbourhood (cover.h,
/// data/generators/star_meshes.h), and parts of meshes whose indices need more than 16 bits.
/// Throws data::InputError as worst_case_meshes() does.
std::vector<AuditMesh> default_plan(Level level);

/// The cases of a scheme and of sharp edges that some of the subjects does; all without sharp edges if a
/// subject does not say.
std::vector<AuditMesh> default_plan(Level level, const std::vector<AuditSubject>& subjects);

}  // namespace limitcheck::verify
