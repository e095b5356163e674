// SPDX-License-Identifier: MIT
// The parts of `limitcheck audit`: which meshes it looks at, where the results go besides the table, and the audit of
// finished files.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/io/read.h"
#include "verify/audit/audit.h"
#include "verify/cli/mesh_options.h"
#include "verify/cli/screen.h"
#include "verify/cli/subject_loader.h"
#include "verify/cli/units.h"
#include "verify/files/audit_files.h"
#include "verify/report/columns.h"
#include "verify/report/coverage.h"
#include "verify/report/forms.h"

namespace limitcheck::cli {

/// --require, --require-coverage, --all-rows, --color, --junit, --sarif, --markdown, --waivers, --baseline and --save-baseline: what can be done with a report alone.
struct ReportOptions {
  std::string junit, sarif, markdown, waivers, baseline, save_baseline, colour = "auto";
  std::vector<std::string> required;
  bool require_coverage = false, all_rows = false;
};
void add_report_options(CLI::App& command, ReportOptions& options);

/// Applies --waivers and compares with --baseline. Returns whether each subject was judged by all that --require and
/// --require-coverage name; report.incomplete names the others. Throws data::ArgumentError: a file cannot be read
/// or understood.
bool settle(const ReportOptions& options, verify::Report& report);

/// Of an audit that came to its end.
int exit_code_of(const verify::Report& report, bool judged);
/// Why a report in which nothing was looked at is incomplete.
std::string nothing_looked_at(bool polygons);
/// Prints a report as wide as the screen is, in colour as --color says: `auto` is yes if standard output is a terminal
/// and NO_COLOR is not set.
void say_report(const ReportOptions& options, const verify::Report& report,
                const std::function<std::string(const verify::Report&, const verify::Screen&)>& text);
/// Outputs, besides those of `options`, as pairs of option and file name, "-" or "" for none. Throws data::ArgumentError: two of them are one and
/// the same file.
void refuse_one_file_for_two(std::vector<std::pair<std::string, std::string>> outputs,
                             const ReportOptions& options = {});
/// What --junit, --sarif and --markdown ask for.
void write_forms(const ReportOptions& options, const verify::Report& report, const std::string& level);

/// How much is checked, and more outputs.
struct OutputArguments : ReportOptions {
  std::string level = "standard", html, explain, witnesses;
  double shrink_seconds = 0;  // 0: no shrinking
};
void add_output_options(CLI::App& command, OutputArguments& arguments);

/// --sample: "FACES" or "FACES:SEED".
struct Sampling {
  std::size_t faces = 0;
  std::uint64_t seed = 1;
};
/// Nothing for an empty text.
std::optional<Sampling> parse_sample(const std::string& text);

struct AuditArguments {
  std::string subject;
  std::vector<std::string> meshes, options;
  data::ReadOptions mesh;
  int depth = 4;
  std::string depths = "uniform", sample;
  std::string checks, rerun;  // --checks as it is written; the report of --rerun
  bool plan = true;           // what is to be looked at is not said: neither meshes nor depths
  int exhaustive = 0;         // every neighbourhood of so many faces; 0: it is not asked for
  int threads = 0;
  ShardArguments shard;  // with the file of the report
  std::string report;    // folder of the report in all its forms; empty: none
  bool details = false, must_refuse = false;
  OutputArguments output;
  SubjectArguments from;
};

/// The file of --report in this form; empty: there is none.
std::string report_file(const AuditArguments& arguments, const char* form);
/// Writes the files of a finished audit, then prints its report, or `json` where that goes to standard output. The files come
/// first, because a reader of the table may close the pipe; and the table is printed even if a file cannot be written.
///   about   what stands above the table
void deliver(const AuditArguments& arguments, const verify::Report& report, const std::string& json,
             const std::string& about, const std::function<void()>& write_files);

/// The checks of subjects that --checks leaves out: all but those that it names, or those behind a minus. Throws
/// data::ArgumentError: there is no such check.
std::vector<std::string> left_out_by(const std::string& checks);

/// What --rerun looks at again: the findings and breakdowns of an earlier report, and whose they are.
struct Rerun {
  std::vector<verify::Result> findings;
  std::vector<std::string> subjects;
  /// Whether a check of a subject on a mesh is among them; `tessellates` where any is.
  bool has(const std::string& subject, const verify::AuditMesh& mesh, std::string_view check) const;
};
/// Throws data::ArgumentError: the file is no report of an audit of subjects.
Rerun findings_of(const std::string& file);

/// The arguments as checked and completed before the first subject is called.
struct Job : AuditArguments {
  verify::Depths chosen;  // by --depths
  std::optional<Sampling> sampling;
  std::vector<std::string> left_out;  // by --checks
  Rerun again;
  verify::Level level() const;
};

/// What is looked at, and the line that says for which scheme.
struct AuditedMeshes {
  std::vector<verify::AuditMesh> list;
  std::string scheme_line;
};
/// Those that are named, every neighbourhood (data/generators/every_neighbourhood.h) at depths 0, 1 and 2, or the
/// default plan (verify/audit/default_plan.h): of both schemes what the subjects do or, with --scheme, of one. Throws data::ArgumentError and data::InputError.
AuditedMeshes meshes_of(const Job& job, const std::vector<verify::AuditSubject>& audited, Progress& progress);

/// One that is named, with a depth and as --depths and --sample say; and what was chosen for it.
std::pair<verify::AuditMesh, MeshScheme> open_audit_mesh(const std::string& name,
                                                         const data::ReadOptions& options, int depth,
                                                         const std::string& depths,
                                                         const std::optional<Sampling>& sampling);
/// Those of an earlier report's findings.
AuditedMeshes meshes_again(const Rerun& again);
/// With finished files, --rerun, --must-refuse and --shard what has no effect there is refused, whatever options there
/// will be: nobody is to think that it was done. Throws data::ArgumentError.
void refuse_what_has_no_effect(const CLI::App& command, const AuditArguments& arguments, bool files);

/// Throws data::ArgumentError if the points that the audit looks at take more memory than the machine has: hours of
/// swapping would end without a report.
///   mesh  with a depth of its own
void refuse_too_many_points(const verify::AuditMesh& mesh);

/// The plan of an audit: Auditor::run says which unit is what. Its text differs for other subjects, meshes, options
/// and versions; the header of the report is in it, and which rows each unit has. The subjects of a mesh go together.
verify::Plan audit_plan(const verify::Auditor& auditor, const std::vector<verify::AuditSubject>& subjects,
                        const std::vector<verify::AuditMesh>& meshes, const verify::Report& report,
                        const verify::CoverageQuestion& coverage, const std::string& level);

/// Throws data::ArgumentError unless each of these units has the rows that the plan names, each once, of its subject and
/// mesh and depth, and each says what its numbers say.
void require_units(const nlohmann::json& plan, const std::map<std::size_t, nlohmann::json>& results);
/// Of the library or the program that a subject is; of a command the first word is the program. If that is no file, the
/// subject's description.
std::string subject_digest(const lc_subject& subject);

/// Prints what --explain asks for; false if it does not. Throws data::ArgumentError: there is no such check.
bool explained(const OutputArguments& arguments);

/// A report and what it is about; `subjects` in the order of report.subjects.
struct Audited {
  const std::vector<verify::AuditSubject>& subjects;
  const std::vector<verify::AuditMesh>& meshes;
  const verify::Report& report;
  int threads;
};
/// The tessellation that a row is about, made anew.
std::optional<verify::ErrorShape> shape_of(const Audited& audited, const verify::Result& row);
/// Writes the JSON of a whole report, as --json says, and what the other options ask for; of each cause the page shows
/// what `shape` returns for its example.
void write_report(const AuditArguments& arguments, const Audited& audited, const std::string& json,
                  const std::function<std::optional<verify::ErrorShape>(const verify::Result& row)>& shape);

/// `limitcheck audit --control cage.obj --tessellation out.ply`: the part of the audit that needs no program.
struct FilesArguments {
  std::string control, provenance, per_vertex;
  std::vector<std::string> tessellations;  // files, and folders of them
  verify::FilesOptions options;
  std::optional<data::ChannelRule> channel_rule;
};
/// Adds the options to the audit command, in a group of their own.
void add_files_options(CLI::App& audit, FilesArguments& files);
/// The group of these options in --help.
inline constexpr const char* kFilesGroup = "A finished tessellation (instead of SUBJECT)";
/// Runs it with what the audit command was given besides: meshes, --json, --threads, --details and the outputs, each
/// file a subject of the report. Returns the exit code.
int audit_files(const FilesArguments& files, const AuditArguments& arguments);

}  // namespace limitcheck::cli
