// SPDX-License-Identifier: MIT
// Mutation tests of the checks: faulty tessellators behind the plug-in interface, each meant for one check,
// and the table of the checks that found them.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "data/scheme.h"
#include "verify/shard/shard.h"

namespace limitcheck::verify {

struct Mutant {
  std::string name, description;
  std::string subject, options;  // as `limitcheck audit SUBJECT:OPTIONS` takes them
  std::string check;             // the row meant for it
  std::string claim;             // of the paper, where the mutant is the paper taken literally; else empty
  bool sharp;                    // only meshes with sharp edges or vertices bring it out
  data::Scheme scheme = data::Scheme::kLoop;
  /// Whether a mesh can bring it out at a depth; empty: each can.
  std::function<bool(const data::ControlMesh&, int)> shows = {};
};

/// Faults planted in what a correct subject delivers, and a correct subject with one rule changed.
const std::vector<Mutant>& mutants();

struct Kill {
  const Mutant* mutant;
  std::set<std::string> killed_by;  // rows that were red, up to the case in which its check was
  std::string on;                   // that case: "octahedron (depth 1)"
  /// The same of the mutant stripped of its provenance, if that was asked for; -1 cases: it was not. It is asked in the
  /// cases of one depth for all faces up to the one in which its check finds it with provenance, and in 20 more.
  std::set<std::string> bare_killed_by = {};
  int bare_cases = -1;
  bool by_its_check() const { return killed_by.contains(mutant->check); }
};

struct KillTable {
  std::vector<Kill> kills;
  std::vector<std::string> idle;            // rows of the audit that kill no mutant that is meant for them
  std::vector<std::string> red_on_correct;  // "subject / mesh / row": findings on subjects that are right
  bool held() const;
};

/// All there is to audit. Right subjects in each case of the default plan (audit/default_plan.h) are a unit,
/// the first ones; then each mutant is one: it is audited in its cases, the cheap ones first, until the check
/// meant for it is red.
///   version             of the program
///   without_provenance  mutants are audited a second time as a tessellator that does not say where its points lie
Plan mutants_plan(const std::string& version, bool without_provenance = false);

/// Audits the units of the journal's shard that it does not know yet.
///   on_step  called with what is being done, how much is done, of how much
///   stop     asked between two audits: true ends it before all is done
void run_mutants(Journal& journal,
                 const std::function<void(const std::string&, std::size_t, std::size_t)>& on_step = {},
                 const std::function<bool()>& stop = {});

/// Of the results of all units.
KillTable kill_table(const std::map<std::size_t, nlohmann::json>& results);

}  // namespace limitcheck::verify
