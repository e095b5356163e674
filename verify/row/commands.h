// SPDX-License-Identifier: MIT
// What a result is called in a report, and what to type to see it again.
#pragma once

#include <span>
#include <string>

#include "verify/row/result.h"

namespace limitcheck::verify {

/// The mesh of a result; in a report with a plan also how it was asked for: "octahedron (depth 1)",
/// "bumpy:60 (random:1)", "crowd:18000 (depth 2, sample 100:1)".
std::string case_name(const Report& report, const Result& result);

/// The depths of these results, without those that looked at nothing: "0-5 7"; with a * behind it if some
/// looked at unequal depths or culled faces.
std::string depths_in_short(std::span<const Result* const> results);

/// The same of a subject's whole report, in full: "0 1 2 7; *: random:1, view".
std::string depths_in_full(const Report& report, const std::string& subject);

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
