// SPDX-License-Identifier: MIT
// What an audit says: one row for each subject, mesh and check.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "data/scheme.h"
#include "reference/loop/masks.h"
#include "verify/subject/receipt.h"
#include "verify/subject/subject.h"

namespace limitcheck::verify {

enum class Status {
  kHeld,            // looked at, and nothing is wrong
  kFinding,         // looked at, and something is wrong: `bad` > 0
  kQualityWarning,  // within its bound, but not as good as it could be: worth a look, no fault
  kWaived,          // a finding that a waiver covers, within the waiver's own bound
  kUnexpectedPass,  // a waiver covers it, but there is nothing to waive: time to remove the waiver
  kNotSupported,    // the subject does not offer what this check looks at; not a fault
  kNotRun,          // could not be looked at, because something before it failed; never a confirmation
  kCrash,           // the subject's process was killed, ended, or took too much memory
  kTimeout,         // the subject did not answer in time
  kError            // subject or check broke down otherwise
};

/// Whose doing it is that a row crashed, timed out, broke down or was not judged.
enum class Origin : std::uint8_t {
  kSubject,
  kLimit,  // the subject took longer, or more memory or processes, than it was allowed
  kHost    // this program or its system lacks something: no fault of the subject, which is not judged
};

/// "subject", "limit", "host": stable.
std::string_view word(Origin origin);

/// "held", "finding", "quality-warning", "waived", "unexpected-pass", "not-supported", "not-run", "crash",
/// "timeout", "error": stable.
std::string_view word(Status status);

/// What kind of place of a control mesh a point lies at, as far as the rules of subdivision tell places apart,
/// from the most ordinary to the most special. A point on an edge counts to the more special of its faces.
enum class PlaceKind : std::uint8_t {
  kRegularFace,          // inside a face (or on its edges) none of whose vertices is any of those below
  kBoundaryFace,         // .. that touches the boundary
  kIrregularFace,        // .. at an extraordinary vertex, or no quad of Catmull-Clark's scheme
  kSharpFace,            // .. at a sharp edge or vertex
  kSharpEdge,            // on a sharp edge
  kRegularVertex,        // a control vertex inside the mesh, of valence 6 (Loop) or 4
  kExtraordinaryVertex,  // of any other valence
  kPolygonVertex,        // Catmull-Clark: inside the mesh, at a face that is no quad
  kBoundaryVertex,       // on the boundary
  kDart,                 // where one sharp edge ends
  kCrease,               // between two sharp edges
  kCorner                // three and more sharp edges, or a sharp vertex
};

/// How many of the points at one kind of place were wrong, of how many looked at.
///   faces   around the vertex, for kExtraordinaryVertex and kBoundaryVertex; otherwise -1
struct PlaceCount {
  PlaceKind kind = PlaceKind::kRegularFace;
  std::int32_t faces = -1;
  std::int64_t bad = 0, of = 0;
};

inline bool is_vertex(PlaceKind kind) {
  return kind >= PlaceKind::kRegularVertex;
}

/// "boundary-vertex": stable, for the report's JSON.
std::string_view word(PlaceKind kind);

/// Adds counts of one list to another; both are ascending by kind and faces.
void add(std::vector<PlaceCount>& to, const std::vector<PlaceCount>& counts);

/// Whether something is wrong inside regular faces.
bool is_everywhere(const std::vector<PlaceCount>& counts);

/// The places with something wrong, in words that follow "only": "at boundary vertices of 4 or more faces", and
/// that nothing regular was looked at, if so; empty if nothing is wrong. Where is_everywhere(): "everywhere, in
/// regular faces, too".
std::string where_wrong(const std::vector<PlaceCount>& counts);

/// Where to look. Whatever does not apply is -1 or empty.
struct Witness {
  std::int64_t face = -1;      // control face, from 0 in file order
  std::string l1, l2;          // exact fractions: "3/32"; of Catmull-Clark's scheme u and v
  std::int64_t vertex = -1;    // of the tessellation
  std::int64_t triangle = -1;  // of the tessellation
  std::vector<double> expected, got;
  std::vector<std::string> expected_digits;  // of findings in positions and normals: 40 digits
  int corner = -1;  // of a face that is cut into quads, the one whose quad l1 and l2 are of
  std::string channel = {},
              rule = {};  // of the control mesh, whose values are shown; its rule, "none" .. "all"

  /// What should have come, and what came.
  void show(const std::array<double, 3>& what, const std::array<double, 3>& instead) {
    expected.assign(what.begin(), what.end());
    got.assign(instead.begin(), instead.end());
  }
  /// "FACE" or, of a face that is cut into quads, "FACE:CORNER": as `limitcheck eval` takes it.
  std::string where() const {
    return std::to_string(face) + (corner < 0 ? "" : ":" + std::to_string(corner));
  }
};

/// The points of a row that have a bound of their own, because the surface's tangents there are so short or
/// so nearly parallel that rounding alone may turn the normal farther than elsewhere.
struct IllConditioned {
  std::int64_t count = 0;
  double bound = 0, worst = 0;  // the largest of their bounds and of their errors, in the row's unit
};

/// What the points of a row are, by majority, in place of what was expected (verify/recognise).
struct Recognised {
  std::string what;    // "the vertices of the control mesh refined by Loop's rule (3 steps)"
  std::string scheme;  // "loop", "warren", "linear", "catmull-clark"
  int steps = 0;
  bool limit = false;  // moved to that scheme's limit surface
  bool tags = true;    // with the sharp edges and vertices of the control mesh
};

/// One row. `worst` and `bound` are in `unit`; so are rms
/// and p99, which run over everything that was compared.
struct Result {
  std::string subject, mesh, check;
  int depth = 0;               // of the deepest face
  std::string depths, sample;  // how the depths were chosen, and "FACES:SEED": as --depths, --sample take it
  lc_precision precision = LC_FLOAT64;  // of the subject: expected values are those of the mesh rounded to it
  data::Scheme scheme = data::Scheme::kLoop;
  std::string
      triangulated;  // how larger faces of the mesh were cut, as --triangulate takes it; empty: they were not
  reference::Weights weights = reference::Weights::kLoop;  // the family that the subject declares
  Status status = Status::kNotRun;
  std::int64_t bad = 0, of = 0;  // how many wrong of how many looked at
  std::optional<double> worst, bound, rms, p99;
  std::string unit;
  std::optional<double> worst_absolute;  // positions: in the mesh's own unit ...
  std::optional<double> worst_ulps;      // ... and in units in the last place of the subject's precision
  std::optional<IllConditioned> ill_conditioned;  // normals: if there are any
  std::optional<Witness> witness;
  std::string message;  // sentences for who reads it; nothing looks for words in them. May be empty
  std::vector<std::string> accepted;  // of broken meshes: what was wrong with those that it took
  std::int64_t not_finite = 0;        // points left out for it; of relations, that are finite in the original
  std::string file_options;           // of finished files: what was asked besides, for the command line
  std::string waiver;                 // what became of it by a waiver: "waived until 2027-01-31: known"
  /// Of findings in positions and normals: where on the control mesh they are, ascending by kind and faces.
  std::vector<PlaceCount> places;
  /// Positions and normals: how many errors there are of each power of ten (statistics.h).
  std::vector<std::int64_t> decades;
  double seconds = 0;                    // that it took to look
  std::optional<Recognised> recognised;  // positions, and the row of what is not that
  std::optional<Origin> origin;          // of breakdowns, and of what the host could not judge
};

/// A finding, or a breakdown.
inline bool is_bad(const Result& r) {
  return r.status == Status::kFinding || r.status == Status::kCrash || r.status == Status::kTimeout ||
         r.status == Status::kError;
}
inline bool looked_at(const Result& r) {
  return r.status != Status::kNotSupported && r.status != Status::kNotRun;
}

/// What a row looks at: a mesh at its depths.
using Case = std::tuple<std::string, int, std::string, std::string>;
inline Case case_of(const Result& r) {
  return {r.mesh, r.depth, r.depths, r.sample};
}

/// Adds a sentence, if there is one, to what a row says.
void say(Result& row, const std::string& sentence);

/// The status that the numbers of a row give, whatever status it says: for rows that were stored, to be held
/// against that. Deterministic, of this row alone.
///   kFinding   something is wrong: `bad` > 0, or `worst` is no number within `bound` (where both are there);
///              also of a row that says that it was not run, though it counted something wrong
///   kHeld      nothing is wrong; also of a finding without anything wrong, and of a row that says that it was
///              not run, though it looked at something (`of` > 0)
/// Numbers do not tell why a row is a quality warning, not supported, waived, a crash, a timeout or an error:
/// these stay, but for a warning or an unexpected pass beyond its bound, which are findings.
Status verdict_of(const Result& row);

/// How many kinds of neighbourhood (verify/evidence/cells.h) of one scheme a subject was judged at.
struct Coverage {
  std::string subject;
  data::Scheme scheme = data::Scheme::kLoop;
  std::int64_t looked = 0;         // at so many ..
  std::vector<std::string> never;  // .. and never at these, which it declares to do
  std::int64_t not_declared = 0;
  std::int64_t declared() const { return looked + static_cast<std::int64_t>(never.size()); }
};

/// The kinds of neighbourhood that a case looks at: element k, whether cells(scheme)[k] (evidence/cells.h).
struct CaseCells {
  Case at;
  data::Scheme scheme = data::Scheme::kLoop;
  std::vector<bool> cells;
};

/// What the audit was run on and with: the header of table and JSON.
struct Report {
  struct Mesh {
    std::string name;
    std::int64_t vertices = 0, faces = 0;
    data::Scheme scheme = data::Scheme::kLoop;
    std::string triangulated;  // as in Result
    double diagonal = 0;       // of the bounding box
  };
  std::string version;
  int depth = 0;                   // the largest
  std::string depths = "uniform";  // how they were chosen (evidence/audit_case.h); "plan": one way after the
                                   // other (default_plan.h); "file": unknown
  std::optional<std::uint64_t> seed;  // of random
  std::string sample;                 // "FACES:SEED" if only a part of each mesh was looked at
  std::vector<std::string> left_out;  // checks, by --checks
  std::string rerun;                  // the report whose findings alone are looked at again; empty: all are
  std::vector<Mesh> meshes;
  std::vector<std::string> subjects;
  std::map<std::string, std::string> descriptions;  // of subjects, by their label: "OpenSubdiv 3.5 Far: ..."
  std::vector<Result> results;
  std::vector<Coverage> coverage;  // of audits of subjects ...
  std::vector<CaseCells> cases;    // ... and what it is made of
  double seconds = 0;
  std::string containment;        // how the processes of isolated subjects were held; empty: there were none
  std::vector<Receipt> receipts;  // and what they took
  std::map<std::string, std::string>
      devices;             // what subjects compute on besides the processor (subject/devices.h)
  std::string printed;     // by the subjects, on standard output and standard error
  std::string incomplete;  // "interrupted by SIGINT": not all was looked at; empty: all was

  /// Against an earlier report (report/known.h), in rows.
  struct Changes {
    std::string baseline;  // its file
    std::int64_t appeared = 0, worse = 0, gone = 0, same = 0;
    std::int64_t before = 0;         // findings that it had, of a report
    std::vector<std::string> named;  // each that is new, worse or gone, in that order
  };
  std::optional<Changes> changes;  // with a baseline: only what is new or worse is not held, unless `rerun`

  /// Whether anything was looked at: if nothing asked for is supported, nothing was.
  bool looked() const { return std::ranges::any_of(results, looked_at); }
  /// Whether nothing was left out for what this program or its system lacked.
  bool host_sufficed() const {
    return std::ranges::none_of(results, [](const Result& r) { return r.origin == Origin::kHost; });
  }
  bool held() const {
    if (!incomplete.empty() || !host_sufficed()) return false;
    if (changes && rerun.empty()) return changes->appeared + changes->worse == 0;
    return std::ranges::none_of(results, is_bad);
  }
};

}  // namespace limitcheck::verify
