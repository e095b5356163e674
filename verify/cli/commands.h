// SPDX-License-Identifier: MIT
// The commands of the program. Each adds itself to the parser and stores what it returned in `exit_code`.
#pragma once

#include <CLI/CLI.hpp>

namespace limitcheck::cli {

/// The exit codes of every command: stable, scripts rely on them.
enum ExitCode : int {
  kHeld = 0,
  kFindings = 1,
  kBadInput = 2,    // and anything else that stops the program: no memory, no room on the disk
  kSignalled = 128  // plus the signal's number: an audit ended early, with a partial report
};

void add_check(CLI::App& app, int& exit_code);
void add_claims(CLI::App& app, int& exit_code);
void add_generate(CLI::App& app, int& exit_code);
void add_eval(CLI::App& app, int& exit_code);
void add_audit(CLI::App& app, int& exit_code);
void add_hunt(CLI::App& app, int& exit_code);
void add_merge(CLI::App& app, int& exit_code);
void add_prove(CLI::App& app, int& exit_code);
void add_mutants(CLI::App& app, int& exit_code);
void add_repair(CLI::App& app, int& exit_code);
void add_tessellate(CLI::App& app, int& exit_code);
void add_external(CLI::App& app, int& exit_code);
void add_manual(CLI::App& app, int& exit_code);  // hidden: what the build makes the manual page of
void add_worker(CLI::App& app, int& exit_code);  // hidden: the process that isolated subjects run in

}  // namespace limitcheck::cli
