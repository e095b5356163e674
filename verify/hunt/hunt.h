// SPDX-License-Identifier: MIT
// A search for anything wrong, case by case: meshes without end, each with a name that can be typed again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "data/scheme.h"
#include "verify/audit/audit.h"
#include "verify/evidence/audit_case.h"
#include "verify/hunt/hunt_report.h"

namespace limitcheck::verify {

/// What a subject does of one scheme.
struct Does {
  data::Scheme scheme = data::Scheme::kLoop;
  std::int32_t sharp = 0;  // lc_capabilities::sharp
};

/// What the subject says that it does, of these schemes. A subject that breaks down when it is asked does
/// both, without sharp edges: the audit will say why.
std::vector<Does> schemes_of(const AuditSubject& subject, const std::vector<data::Scheme>& schemes);

/// Options that a case may be asked with, and what the subject does under them.
struct Way {
  std::string options;
  std::vector<Does> does;
};

/// The ways that these keys of the subject's options text give ("key=one|two", numbers for "key=N"; "all":
/// every key there), each alone and two by two, beside the options that it has anyway; only those that it
/// takes. Throws data::ArgumentError: the text has no such key.
std::vector<Way> ways_of(const AuditSubject& subject, const std::vector<data::Scheme>& schemes,
                         const std::vector<std::string>& keys);

/// One case: the mesh at its depths, and whether the relations are looked at, too.
struct HuntCase {
  std::uint64_t number = 0;
  AuditMesh mesh;
  std::string options{};  // of the subject in place of its own; empty: its own
};

/// The edges of a mesh told apart by what lies about them: valences and boundary at both ends, corners of the
/// faces, sharpness, and how much the depths of its faces differ. One number for each kind.
std::set<std::uint64_t> kinds_of_edges(const AuditMesh& mesh);

/// Case n is decided by the seed, n and what the subject does. Families of meshes, sizes, stretching and the
/// ways of choosing depths take turns; of four meshes drawn for a case the one with most kinds of edges that
/// its block of cases has not had yet is taken. Where there are other ways, every second case takes one.
class HuntPlan {
 public:
  static constexpr std::uint64_t kBlock = 16;  // cases: shards have whole blocks

  ///   tagged   most meshes have any sharp edges, vertices and options in place of their own
  /// Throws data::ArgumentError: the subject does none of the schemes.
  HuntPlan(std::uint64_t seed, std::vector<Does> does, std::vector<Way> ways = {}, bool tagged = false);

  /// Fast for the case after the last one; for any other the block is begun anew.
  HuntCase at(std::uint64_t number);

 private:
  HuntCase next();

  std::uint64_t seed_, number_ = 0;  // of the case that next() makes
  std::vector<Does> does_;
  std::vector<Way> ways_;
  bool tagged_;
  std::set<std::uint64_t> seen_;  // in this block
};

struct HuntOptions {
  int attempts = 2000;              // to shrink a finding; 0: it is not shrunk
  std::filesystem::path witnesses;  // folder for the small meshes; empty: none is written
};

/// Audits cases of a plan. What follows from another row of the case (verify/causes/causes.h) is no finding; of findings
/// with one signature in a case the first counts.
class Hunt {
 public:
  Hunt(AuditSubject subject, HuntPlan plan, HuntOptions options);

  /// What the case adds to a report; none if it was interrupted, and does not count.
  std::optional<HuntReport> look(std::uint64_t number);
  /// Makes small meshes for the findings that are to have them (HuntReport::to_shrink) and have none; ends
  /// early if it is interrupted.
  void shrink_findings(HuntReport& report);

 private:
  Report audit(const HuntCase& at);
  void shrink_finding(HuntFinding& finding);

  // With the options of the case.
  AuditSubject subject(const HuntCase& at) const;

  AuditSubject subject_;
  HuntPlan plan_;
  HuntOptions options_;
  Auditor quick_, thorough_;
};

}  // namespace limitcheck::verify
