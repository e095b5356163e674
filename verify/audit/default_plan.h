// SPDX-License-Identifier: MIT
// The meshes and depths of `limitcheck audit SUBJECT` when the command line names neither.
#pragma once

#include <vector>

#include "verify/audit/audit.h"

namespace limitcheck::verify {

/// The cases, those of the same mesh one after the other:
///   at depth 4, with the relations   the worst cases known (data/worst_cases.h; not at kQuick), bumpy:800,
///                                    and the stock shapes (data/generators/named_mesh.h)
///   at depths 0 and 1                the stock shapes
///   at depths 2, 3, 5, 6 and 7       small meshes, those of data/generators/awkward_meshes.h among them
///   at unequal depths                random ones with culled faces, a view, face 0 culled, all faces culled
///   meshes with sharp edges          of quads and mixed ones
///   meshes of many tetrahedra        whose indices need more than 16 bits: one at depth 0, a part of another
/// Throws data::InputError as worst_case_meshes() does.
std::vector<AuditMesh> default_plan(Level level);

/// The cases of a scheme and of sharp edges that some of the subjects does; all without sharp edges if a
/// subject does not say.
std::vector<AuditMesh> default_plan(Level level, const std::vector<AuditSubject>& subjects);

}  // namespace limitcheck::verify
