// SPDX-License-Identifier: MIT
// Mutation tests of the checks: faulty tessellators behind the plug-in interface, each meant for one check,
// and the table of the checks that found them.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace limitcheck::verify {

struct Mutant {
  std::string name, description;
  std::string subject, options;  // as `limitcheck audit SUBJECT:OPTIONS` takes them
  std::string check;             // the row meant for it
  std::string claim;             // of the paper, where the mutant is the paper taken literally; else empty
  bool sharp;                    // only meshes with sharp edges or vertices bring it out
};

/// Faults planted in what a correct subject delivers, and a correct subject with one rule changed.
const std::vector<Mutant>& mutants();

struct Kill {
  const Mutant* mutant;
  std::set<std::string> killed_by;  // rows that were red, up to the case in which its check was
  std::string on;                   // that case: "octahedron (depth 1)"
  bool by_its_check() const { return killed_by.contains(mutant->check); }
};

struct KillTable {
  std::vector<Kill> kills;
  std::vector<std::string> idle;            // rows of the audit that kill no mutant that is meant for them
  std::vector<std::string> red_on_correct;  // "subject / mesh / row": findings on subjects that are right
  bool held() const;
};

/// Audits right subjects in all cases of the default plan (audit/default_plan.h), and each mutant in its
/// cases, the cheap ones first, until the check meant for it is red.
///   on_step  called with what is being done, how much is done, of how much
KillTable run_mutants(const std::function<void(const std::string&, std::size_t, std::size_t)>& on_step = {});

}  // namespace limitcheck::verify
