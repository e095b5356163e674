// SPDX-License-Identifier: MIT
// `limitcheck audit`: the options for how much is checked, what is waived, and where the results go besides
// the table.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include "verify/audit/audit.h"

namespace limitcheck::cli {

struct OutputArguments {
  std::string level = "standard", junit, html, waivers, baseline, explain, witnesses;
  std::vector<std::string> required;
  bool require_coverage = false;
  double shrink_seconds = 0;  // 0: no shrinking
};

/// --require, --junit, --waivers and --baseline: what can be done with a report alone.
void add_report_options(CLI::App& command, OutputArguments& arguments);
/// These and the others.
void add_output_options(CLI::App& command, OutputArguments& arguments);
verify::Level level(const OutputArguments& arguments);

/// Prints what --explain asks for; false if it does not.
/// Throws data::ArgumentError: there is no such check.
bool explained(const OutputArguments& arguments);

/// Applies --waivers to the report. Throws data::ArgumentError: the file cannot be read or understood.
void waive(const OutputArguments& arguments, verify::Report& report);

/// Compares the report with --baseline. Throws data::ArgumentError: the file cannot be read or understood.
void compare(const OutputArguments& arguments, verify::Report& report);

/// Writes each finding of the report as files (verify/report/witness_files.h), if --witnesses or --shrink says
/// so; with --shrink one for each subject and check, on a smaller mesh. Says so on standard error. `subjects`
/// in the order of report.subjects. Throws std::runtime_error, data::InputError: a file cannot be written.
void write_witnesses(const OutputArguments& arguments, const std::vector<verify::AuditSubject>& subjects,
                     const std::vector<verify::AuditMesh>& meshes, const verify::Report& report, int threads);

/// Writes the report as a page, with the tessellation of each cause's example made anew.
void write_html(const std::string& file, const std::vector<verify::AuditSubject>& subjects,
                const std::vector<verify::AuditMesh>& meshes, const verify::Report& report,
                const std::string& level, int threads);

/// Whether each subject was judged by all checks that --require names; report.incomplete names the others.
bool judged_as_required(const OutputArguments& arguments, verify::Report& report);

/// Why a report in which nothing was looked at is incomplete.
std::string nothing_looked_at(bool polygons);

/// Of an audit that came to its end.
int exit_code_of(const verify::Report& report, bool judged);

/// Outputs as pairs of option and file name, "-" or "" for none. Throws data::ArgumentError: two of them
/// are one and the same file.
void refuse_one_file_for_two(const std::vector<std::pair<std::string, std::string>>& outputs);

/// Writes --junit, if it was given.
void write_junit(const OutputArguments& arguments, const verify::Report& report);

}  // namespace limitcheck::cli
