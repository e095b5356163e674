// SPDX-License-Identifier: MIT
// What a hunt found, and what lies about the place of a finding, as far as it tells faults apart.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "verify/evidence/audit_case.h"
#include "verify/row/result.h"
#include "verify/shard/shard.h"

namespace limitcheck::verify {

/// The likely cause near the place of a finding: of the corners of its face that are not regular, and of its
/// middle if it is cut into quads, the nearest; or of several equally near the least regular.
struct LikelyCause {
  /// "regular", "inner vertex", "boundary vertex", "crease", "dart", "corner", "face"; or empty: the finding
  /// names no face, or is of a relation.
  std::string kind;
  std::string valence;  // class of its faces (of a face, corners): "1" to "7", "8 to 40", "more than 40"
  int rank = 0;         // how far it is from the regular one, 0 to 3
  bool beside = false;  // there is another extraordinary corner
  int difference = 0;   // between the depths of the face and of those at its corners, at most 4

  /// "inner vertex of 7 faces, beside another extraordinary one; depths differ by 3"
  std::string words() const;
  /// A fault there would show in `other`, too, which has all that this has and more.
  bool covers(const LikelyCause& other) const;
  /// Less than that of any other that it covers.
  int level() const { return (kind == "regular" ? 0 : 1 + rank) + (beside ? 1 : 0) + difference; }

  friend bool operator==(const LikelyCause&, const LikelyCause&) = default;
};

LikelyCause likely_cause(const Result& finding, const AuditMesh& mesh);

/// By which findings are one: scheme, check, status, and the neighbourhood. Stable.
std::string signature(const Result& finding, const LikelyCause& where);

/// Findings of one signature, by the first of them.
struct HuntFinding {
  std::string signature, check, status;  // status: "finding", "crash", ...
  std::string scheme;
  LikelyCause where;
  std::int64_t cases = 0;         // in which it was seen
  std::uint64_t first = 0;        // the first of them
  std::string found_on;           // a command that shows it on the mesh where it was found
  std::int64_t faces_before = 0;  // of that mesh
  int depth_before = 0;
  std::optional<double> worst, bound;  // there
  std::string unit, message;
  std::int64_t faces = 0;  // of the small mesh; 0: there is none
  int depth = 0;           // there
  std::string witness;     // the folder with it; may be empty
  std::string command;     // shows it there; empty as `witness` is

  /// The same check, and its neighbourhood covers that of the other.
  bool covers(const HuntFinding& other) const;
  /// "high": a breakdown, or a thousand times its bound or more; "medium": ten times; "low".
  std::string severity() const;
};

struct HuntReport {
  std::string version, subject;
  std::uint64_t seed = 0, asked = 0;            // cases of the whole plan; 0: as many as there was time for
  std::vector<std::string> schemes, varied;     // varied: --vary
  Shard shard;                                  // of blocks of cases
  std::uint64_t cases = 0;                      // that were looked at
  std::uint64_t next = 0;                       // all cases of the shard before this one were
  std::int64_t judged = 0;                      // of them, those of which anything was looked at
  std::set<std::uint64_t> kinds;                // of edges (hunt.h)
  std::map<std::string, HuntFinding> findings;  // by signature
  double seconds = 0;
  std::string incomplete;             // "interrupted by SIGINT"; empty: all that was asked for
  nlohmann::json attested = nullptr;  // digests of the program, the plan and the subject

  /// The gravest first, then by signature.
  std::vector<const HuntFinding*> by_severity() const;
  /// Those that no other covers: what there is to look at.
  std::vector<const HuntFinding*> uncovered() const;
  /// Which of these get small meshes: of each scheme, check, status and kind of neighbourhood the first of
  /// the least level. What is one of a whole hunt is one of its shard.
  std::vector<HuntFinding*> to_shrink();

  /// Adds what a case has given. Returns it for a journal: without kinds of edges that were there before, and of
  /// findings that were there only the signatures.
  nlohmann::json add(const HuntReport& of_case);
  /// The findings that have small meshes, for a journal.
  nlohmann::json small_meshes() const;
  /// Adds what a journal has of either, in the order in which it was written. Throws data::ArgumentError.
  void add_again(const nlohmann::json& added);
};

/// As JSON. Keys: program, version, subject, seed, asked, schemes, varied, shard, cases, next, judged, edge_kinds
/// (a list in a shard, else their number), findings, seconds, incomplete.
std::string to_json(const HuntReport& report);
/// Throws data::ArgumentError: the text is no report of a hunt.
HuntReport read_hunt_report(const std::string& text);

/// Reports of one hunt as one; incomplete if one is.
HuntReport combined(const std::vector<HuntReport>& parts);
/// The same of the reports of all shards. Throws data::ArgumentError: they are of different hunts, or a shard
/// is missing, there twice, or incomplete.
HuntReport merged(const std::vector<HuntReport>& parts);

/// Those of uncovered() that an earlier report has not, nor covers; nullptr: there is none.
std::vector<const HuntFinding*> new_findings(const HuntReport& report, const HuntReport* earlier);

/// One line for each new finding and what to type, below a summary.
std::string to_text(const HuntReport& report, const HuntReport* earlier = nullptr);
std::string to_junit(const HuntReport& report, const HuntReport* earlier = nullptr);

}  // namespace limitcheck::verify
