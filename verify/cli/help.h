// SPDX-License-Identifier: MIT
// What --help and the manual page show besides the options: examples.
#pragma once

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <string_view>
#include <vector>

namespace limitcheck::cli {

/// A command line, and what it is for.
struct Example {
  std::string_view line, purpose;
};
/// Of a command, the most usual first. Each runs as it stands in an empty folder, but for those that name a file or a
/// library of the user's.
std::vector<Example> examples_of(std::string_view command);

/// --help of this program and of all commands that are added from now on: description, examples, options.
void show_examples(CLI::App& app);

/// Puts options of a command together, under a title.
void group(CLI::App& command, const char* title, std::initializer_list<const char*> options);

}  // namespace limitcheck::cli
