// SPDX-License-Identifier: MIT
// What to type to see a result again.
#pragma once

#include <string>

#include "verify/row/result.h"

namespace limitcheck::verify {

/// What to type to see the exact surface at a result's witness; "" if it names no point, or is not about the
/// exact surface.
std::string eval_command(const Result& result);

/// What to type to see what the subject delivers there beside what it should have delivered; "" if the row is
/// not about the points of one tessellation.
std::string difference_command(const Result& result);

/// What to type to see a result again: its subject and mesh at its depths.
///   level   of the audit: quick, standard, thorough
std::string audit_command(const Result& result, const std::string& level);

}  // namespace limitcheck::verify
