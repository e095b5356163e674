// SPDX-License-Identifier: MIT
// Words for the cases of a report in which meshes are asked for in more than one way (default_plan.h).
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

}  // namespace limitcheck::verify
