// SPDX-License-Identifier: MIT
// Rows of an audit as JSON that loses nothing, to go on with and to merge. (What programs read: json.h.)
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "verify/row/result.h"

namespace limitcheck::verify {

nlohmann::json rows_json(const std::vector<Result>& rows);
std::vector<Result> rows_of(const nlohmann::json& json);

/// What a report says before its first row: version, depths, meshes, subjects.
nlohmann::json header_json(const Report& report);
Report header_of(const nlohmann::json& json);

}  // namespace limitcheck::verify
