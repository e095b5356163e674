// SPDX-License-Identifier: MIT
// What limitcheck and the programs that it hands commands over to have in common.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace limitcheck::cli {

/// The whole of main(): parses, which runs the command, and says what is wrong. Returns the exit code, which the
/// command has stored in `exit_code`.
int run_program(CLI::App& app, int argc, char** argv, const int& exit_code);

/// Becomes limitcheck-NAME (find_program), with these arguments, or those of this program. Returns, with an exit code,
/// only if that fails, and says why.
int hand_over(const std::string& name, const std::vector<std::string>& arguments);
int hand_over(const std::string& name);

}  // namespace limitcheck::cli
