// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "verify/audit/result.h"

namespace limitcheck::verify {

/// The report for a terminal: for each subject a line per check over all meshes (the worst mesh is shown),
/// then the findings, each with its witness and the command that recomputes the expected value.
///   colour  whether to use ANSI colours
///   all     a line for each mesh instead of the worst one only
std::string to_table(const Report& report, bool colour, bool all = false);

/// What to type to see the expected value of a result's witness, or "" if it names no point.
std::string eval_command(const Result& result);

/// What to type to see a result again: its subject and mesh at its depths.
///   level   of the audit: quick, standard, thorough
std::string audit_command(const Result& result, const std::string& level);

}  // namespace limitcheck::verify
