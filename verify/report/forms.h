// SPDX-License-Identifier: MIT
// The forms that the report of an audit is written in, but for JSON (json.h): tables, overview, JUnit, page, witnesses.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "verify/causes/causes.h"
#include "verify/evidence/audit_case.h"
#include "verify/report/columns.h"
#include "verify/row/result.h"
#include "verify/row/statistics.h"

namespace limitcheck::verify {

/// The report for a terminal: for each subject a line per check over all meshes (the worst mesh is shown),
/// then the findings, each with its witness and the command that recomputes the expected value.
std::string to_table(const Report& report, const Screen& screen);

/// The part of it that is about one subject; of checks that nothing was looked at for only why.
std::string check_lines(const Report& report, const std::string& subject, const Screen& screen);

// The report on one screen, and what it does not say: checks that looked at nothing.

/// The checks that share a column of the overview.
struct CheckGroup {
  std::string_view title;
  std::vector<std::string_view> checks;
};
/// As the table of rows has them (row/rows.h): of finished files, or of subjects.
const std::vector<CheckGroup>& check_groups(const Report& report);

/// How the rows of one subject in one group came out.
struct GroupVerdict {
  std::int64_t bad = 0, looked_at = 0;  // cases
  bool waived = false, stale = false;
  bool asked = false, supported = false;  // whether there are rows, and any that the subject supports

  /// "held", "3/126", "waived", "stale"; where nothing was looked at "not asked", "unsupported" or "not run".
  std::string text() const;
};
GroupVerdict verdict_of(const Report& report, const std::string& subject, const CheckGroup& group);

/// What the report is about, in one line: version, depths, meshes.
std::string header(const Report& report);
/// Waivers that were used, are stale, expired or cover nothing: a line each.
std::string waiver_lines(const Report& report);
/// What changed since the baseline, if there is one: counts, and the first of what is new, worse and gone.
std::string changes_line(const Report& report);
/// "38 held, 2 findings, ...": the last line of a report, with what was never judged or is incomplete.
std::string summary(const Report& report);
/// What the words of the tables mean.
std::string legend(const Report& report);

/// Header, subjects x groups of checks (of one subject: its checks), root causes, summary. At most
/// kScreen lines as long as there are no more than 25 causes; the commands are left out where they would make
/// it longer.
///   scheme_line   as the commands say which scheme was taken
///   level         of the audit, for the commands
///   full          where the rest is, in one sentence
inline constexpr int kScreen = 50;
std::string to_overview(const Report& report, const std::vector<Cause>& causes, const Screen& screen,
                        const std::string& scheme_line, const std::string& level, const std::string& full);

/// The causes in full: title, where to look, how often, what follows from it, the command.
std::string causes_in_full(const Report& report, const std::vector<Cause>& causes, const std::string& level);

struct Unjudged {
  std::string subject, check;
  std::string reason;      // the first that a row gives; may be empty
  bool not_asked = false;  // the row of the reason says that the subject is not asked

  /// "normals of cgal were never judged: it delivers none".
  std::string text() const;
};

/// For each subject those of `checks` that looked at nothing on any mesh.
std::vector<Unjudged> unjudged(const Report& report, const std::vector<std::string>& checks);

/// The same for positions (of the limit surface or of the refined mesh) and normals, of subjects that have
/// rows of these names, and for broken meshes, of subjects that are not asked because they do not validate;
/// rows of tessellation files have other names.
std::vector<Unjudged> unjudged(const Report& report);

/// The report as JUnit XML: a suite for each subject, a case for each mesh and check. Findings are failures,
/// breakdowns errors; what is not supported, not run or waived is skipped; warnings pass and say so.
std::string to_junit(const Report& report);

/// The root causes for what shows them beside the code, texts of others as visible text: a log of SARIF 2.1.0, a result
/// for each cause with its subjects as artifacts; and a page of Markdown.
std::string to_sarif(const Report& report, const std::vector<Cause>& causes, const std::string& level);
std::string to_markdown(const Report& report, const std::vector<Cause>& causes, const std::string& level);

/// Visible text (verify/row/visible_text.h) for XML 1.0; new lines and tabs are spaces.
std::string xml_text(const std::string& text);

// The report as one page that opens from the disk, with everything inside it.

/// A tessellation, or the part of it round a witness, with the error of each vertex.
struct ErrorShape {
  std::vector<float> control;        // both ends of each edge of the control mesh; nothing if it has too many
  std::vector<float> positions;      // three for each vertex
  std::vector<std::uint8_t> values;  // of each vertex: 0 within the bound, 1 .. beyond it, one for each
                                     // power of ten; 255 not finite
  std::vector<std::uint32_t> triangles;  // three vertices each
  std::array<float, 3> witness{};
  std::string note;  // what the values are of
};

/// The tessellation that a row is about, at most kMostTriangles of it, those nearest to the witness. Nothing
/// if the row names no point, or the subject fails.
inline constexpr std::size_t kMostTriangles = 3000;
std::optional<ErrorShape> error_shape(const AuditSubject& subject, const AuditMesh& mesh, const Result& row,
                                      int threads);
/// The same of a finished file.
std::optional<ErrorShape> error_shape(const VertexErrors& file, const data::ControlMesh& control,
                                      const Result& row);

/// The page: overview, causes with their shapes (one for each cause, or none), histogram of errors.
std::string to_html(const Report& report, const std::vector<Cause>& causes,
                    const std::vector<std::optional<ErrorShape>>& shapes, const std::string& level);

/// html/page.html, with %DATA% where the report goes.
extern const char* const kHtmlPage;

// A finding as files that anyone can pick up: the control mesh, and what to see on it.

/// Makes the folder `folder`/SUBJECT-CHECK-MESH with
///   control.obj    the control mesh, bit for bit as the audit had it
///   depths.txt     the depth of each face, if they had depths of their own
///   witness.json   subject, check, face and parameter; expected and got as in the report;
///                  `limit_position` and `limit_normal` there to 40 digits, for the mesh rounded to the
///                  subject's precision; and two commands that repeat the expected value and the finding
/// The commands name control.obj as `folder` does, so they run where the audit ran. Each file appears whole
/// or not at all. `report` is the one the result is of, `level` how much was looked at. Returns the folder
/// made. Throws std::runtime_error, data::InputError: a file cannot be written.
std::filesystem::path write_witness(const std::filesystem::path& folder, const Report& report,
                                    const Result& result, const AuditMesh& mesh, const std::string& level);

}  // namespace limitcheck::verify
