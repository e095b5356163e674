// SPDX-License-Identifier: MIT
// `limitcheck audit`: how much is looked at, what is waived, and where the results go besides the table.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "verify/audit/audit.h"

namespace limitcheck::cli {

struct OutputArguments {
  std::string level = "standard", junit, waivers, explain;
};

void add_output_options(CLI::App& command, OutputArguments& arguments);
verify::Level level(const OutputArguments& arguments);

/// Prints what --explain asks for; false if it does not. Throws std::invalid_argument: there is no such
/// check.
bool explained(const OutputArguments& arguments);

/// Applies --waivers to the report. Throws std::invalid_argument: the file cannot be read or understood.
void waive(const OutputArguments& arguments, const std::vector<verify::AuditSubject>& subjects,
           verify::Report& report);

/// Writes --junit, if it was given.
void write_junit(const OutputArguments& arguments, const verify::Report& report);

}  // namespace limitcheck::cli
