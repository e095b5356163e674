// SPDX-License-Identifier: MIT
// The register of the paper's claims, and what becomes of each when its tests are run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace limitcheck::verify {

/// A row of papers/mueller-havemann-2000/claims.json.
struct Claim {
  std::string id, place, statement, verdict, note, finding, why;
  std::vector<std::string> check;  // "Suite.Name"; empty: not checkable, and `why`
};

/// The register that was built in.
const std::vector<Claim>& claim_register();

enum class ClaimOutcome {
  kHeld,         // every test bound to it ran and passed
  kNotHeld,      // one of them failed
  kNotRun,       // one of them is not here, or its program broke down; never a confirmation
  kNotCheckable  // no test could decide it
};

/// "held", "not held", "not run", "not checkable": stable. They are verdicts of our tests: a claim that says
/// that something is a misprint holds if it is one.
std::string_view word(ClaimOutcome outcome);

struct ClaimResult {
  const Claim* claim;
  ClaimOutcome outcome = ClaimOutcome::kNotRun;
  std::string message;                                       // of the first failure, or why it was not run
  std::vector<std::pair<std::string, std::string>> figures;  // what the tests recorded: name, value
  std::string finding;  // the claim's, with its figures; empty unless its tests were run
};

/// How many claims there are of each verdict, in the register's order of verdicts: what we conclude about the
/// paper, whatever our tests say today.
std::vector<std::pair<std::string, std::int64_t>> count_verdicts(const std::vector<const Claim*>& claims);

/// The test programs that stand beside this executable or in `folder`, as its claims_programs.txt lists them;
/// those that are not built are left out. Empty where there is no such list: in an installation.
std::vector<std::filesystem::path> claim_programs(const std::filesystem::path& folder = {});

/// Runs the tests of these claims, each program once, and judges. Never throws for a program that fails.
///   on_program  called before each: its name, how many are done, of how many
std::vector<ClaimResult> run_claims(
    const std::vector<const Claim*>& claims, const std::vector<std::filesystem::path>& programs,
    const std::function<void(const std::string&, std::size_t, std::size_t)>& on_program = {});

/// The errata as Markdown: what is wrong as printed, with the correction, and what had to be decided.
std::string errata();

}  // namespace limitcheck::verify
